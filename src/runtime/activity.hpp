// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The worker's activity and its start, for readers that must never wait. One word holds both, so they are of the same
// moment.

#pragma once

#include <atomic>
#include <cstdint>

#include "pose_wall_runtime.h"

namespace pose_wall::runtime {

class Activity {
 public:
  struct Told {
    std::uint32_t activity;
    std::int64_t since_ns;  // rounded down to a multiple of 8 ns
  };

  // By the worker alone, or while there is none.
  void note(pose_wall_runtime_activity activity, std::int64_t since_ns) {
    const std::uint64_t since = static_cast<std::uint64_t>(since_ns) & ~kKinds;
    word_.store(since | static_cast<std::uint64_t>(activity), std::memory_order_release);
  }

  Told now() const {
    const std::uint64_t word = word_.load(std::memory_order_acquire);
    return {static_cast<std::uint32_t>(word & kKinds), static_cast<std::int64_t>(word & ~kKinds)};
  }

 private:
  static constexpr std::uint64_t kKinds = 7;  // a mask of three bits
  static_assert(POSE_WALL_RUNTIME_ACTIVITIES <= kKinds + 1, "they fit three bits");

  std::atomic<std::uint64_t> word_{POSE_WALL_RUNTIME_AT_NOTHING};
};

}  // namespace pose_wall::runtime
