// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Hands out parts of the caller's block, front to back; without a block it only measures.

#pragma once

#include <cstdint>

#include "pose_wall.h"

namespace pose_wall::runtime {

class BlockWalk {
 public:
  explicit BlockWalk(void* block) : block_(static_cast<unsigned char*>(block)) {}

  // Aligned to POSE_WALL_BLOCK_ALIGNMENT, holds garbage. NULL when measuring.
  unsigned char* take(std::uint64_t bytes) {
    constexpr std::uint64_t kMask = POSE_WALL_BLOCK_ALIGNMENT - 1;  // a part ends where the next may begin
    unsigned char* const place = block_ != nullptr ? block_ + used_ : nullptr;
    used_ += (bytes + kMask) & ~kMask;
    return place;
  }

  std::uint64_t bytes() const { return used_; }

 private:
  unsigned char* block_;
  std::uint64_t used_ = 0;
};

}  // namespace pose_wall::runtime
