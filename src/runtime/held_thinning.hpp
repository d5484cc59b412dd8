// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Held values may come from a thinned frame: the engine does not know that returns are missing, and holds its
// measurements. This keeps the thinning of the cloud behind each of them. A value that became invalid may be held
// again: the engine still has the good one beside an unconfirmed jump.

#pragma once

#include <cstdint>

#include "pose_wall.h"

namespace pose_wall::runtime {

class HeldThinning {
 public:
  // Call after each result, with the engine's states. Returns the largest thinning behind its held values; 1: none.
  // thinning: of the frame; 1 for silence.
  std::uint32_t note(const pose_wall_result& result, std::uint32_t thinning) {
    std::uint32_t held = 1;
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      const std::uint32_t state = result.quantity[q].state;
      std::uint32_t& past = past_[q];
      if (state == POSE_WALL_HELD && past > held) held = past;
      if (state == POSE_WALL_VALID) past = thinning;
      // A degraded value replaces no good one: either may be held later.
      if (state == POSE_WALL_DEGRADED && past < thinning) past = thinning;
    }
    return held;
  }

  void forget() { *this = HeldThinning(); }
  // For an unknown past, the worst.
  void assume(std::uint32_t thinning) {
    for (std::uint32_t& past : past_) past = thinning;
  }

 private:
  std::uint32_t past_[POSE_WALL_QUANTITIES] = {1, 1, 1, 1, 1, 1, 1};
};

}  // namespace pose_wall::runtime
