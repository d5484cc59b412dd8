// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Values that are held may come from a thinned frame: the engine does not know that returns were left out, and holds
// what it measured. Here is kept from what cloud each would be. A value that has become invalid may be held again: the
// engine still knows the good one that an unconfirmed jump stood beside.

#pragma once

#include <cstdint>

#include "pose_wall.h"

namespace pose_wall::runtime {

class HeldThinning {
 public:
  // After each result, by the states that the engine gave. Returns the largest thinning behind what is held in it; 1:
  // none. thinning: of the frame; 1 for silence.
  std::uint32_t note(const pose_wall_result& result, std::uint32_t thinning) {
    std::uint32_t held = 1;
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      const std::uint32_t state = result.quantity[q].state;
      std::uint32_t& past = past_[q];
      if (state == POSE_WALL_HELD && past > held) held = past;
      if (state == POSE_WALL_VALID) past = thinning;
      // What is degraded replaces no good value: either may be held later.
      if (state == POSE_WALL_DEGRADED && past < thinning) past = thinning;
    }
    return held;
  }

  void forget() { *this = HeldThinning(); }
  // Of a past that nobody knows: at worst.
  void assume(std::uint32_t thinning) {
    for (std::uint32_t& past : past_) past = thinning;
  }

 private:
  std::uint32_t past_[POSE_WALL_QUANTITIES] = {1, 1, 1, 1, 1, 1, 1};
};

}  // namespace pose_wall::runtime
