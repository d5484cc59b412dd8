// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A frame's place in the block, and the short lists by which places change hands.

#pragma once

#include <cstdint>

#include "pose_wall_runtime.h"

namespace pose_wall::runtime {

// Input and result of one frame or one silence. Belongs to one thread at a time: push, the worker, the recorder.
struct FrameSlot {
  unsigned char* points = nullptr;  // packed, as described by `cloud`
  unsigned char* memento = nullptr;
  pose_wall_cloud cloud{};
  pose_wall_inputs inputs{};  // where `cloud` points to them
  std::uint32_t left_out_not_finite = 0;
  std::uint32_t left_out_zero = 0;
  std::uint32_t kind = 0;      // pose_wall_box_kind
  std::uint64_t sequence = 0;  // of the event
  pose_wall_publication publication{};
};

// The most of queue_frames and of box_backlog (pose_wall_runtime.h), one that is filled and one in work.
constexpr std::uint32_t kSlotsMax = 64 + 2 + 64;

// First in, first out.
class SlotList {
 public:
  bool empty() const { return count_ == 0; }
  std::uint32_t count() const { return count_; }

  const FrameSlot* front() const { return slot_[first_]; }

  void push(FrameSlot* slot) {
    slot_[(first_ + count_) % kSlotsMax] = slot;
    ++count_;
  }

  FrameSlot* pop() {
    FrameSlot* const slot = slot_[first_];
    first_ = (first_ + 1) % kSlotsMax;
    --count_;
    return slot;
  }

 private:
  FrameSlot* slot_[kSlotsMax] = {};
  std::uint32_t first_ = 0, count_ = 0;
};

}  // namespace pose_wall::runtime
