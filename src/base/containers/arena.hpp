// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <new>

#include "base/containers/span.hpp"
#include "pose_wall.h"

namespace pose_wall {

// Whether a part can be laid out in a caller's block.
inline bool is_aligned(const void* block) {
  return reinterpret_cast<std::uintptr_t>(block) % POSE_WALL_BLOCK_ALIGNMENT == 0;
}

// Hands out parts of one block, front to back. Without a block it only measures: the same walk gives the size and the
// places, so the two cannot drift apart. Parts are aligned to POSE_WALL_BLOCK_ALIGNMENT and hold garbage.
class Arena {
 public:
  explicit Arena(void* block) : block_(static_cast<unsigned char*>(block)) {}

  // NULL when measuring.
  void* take_bytes(std::uint64_t bytes) {
    constexpr std::uint64_t kMask = POSE_WALL_BLOCK_ALIGNMENT - 1;  // a part ends where the next may begin
    void* place = block_ != nullptr ? block_ + used_ : nullptr;
    used_ += (bytes + kMask) & ~kMask;
    return place;
  }

  template <typename T>
  Span<T> take(std::uint32_t count) {
    void* place = take_bytes(static_cast<std::uint64_t>(count) * sizeof(T));
    return Span<T>(static_cast<T*>(place), count);
  }

  template <typename T>
  T* take_one() {
    void* place = take_bytes(sizeof(T));
    return place != nullptr ? new (place) T : nullptr;
  }

  // Parts taken after go_back() lie on top of those taken since place(). Use it for parts that are not needed any more
  // when the others are written.
  std::uint64_t place() const { return used_; }
  void go_back(std::uint64_t place) {
    most_ = bytes();
    used_ = place;
  }

  // Parts taken after this lie behind all others.
  void go_behind_all() { used_ = bytes(); }

  // The most that was ever in use.
  std::uint64_t bytes() const { return used_ > most_ ? used_ : most_; }

 private:
  unsigned char* block_;
  std::uint64_t used_ = 0, most_ = 0;
};

}  // namespace pose_wall
