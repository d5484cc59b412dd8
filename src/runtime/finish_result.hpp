// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// From the engine's result on its frame to the published result on the frame that came.

#pragma once

#include <cstdint>

#include "pose_wall.h"

namespace pose_wall::runtime {

inline void finish_result(std::uint32_t left_out_not_finite, std::uint32_t left_out_zero, std::uint32_t thinning,
                          pose_wall_result* result) {
  result->points_in += left_out_not_finite + left_out_zero;
  result->dropped_not_finite += left_out_not_finite;
  result->dropped_zero += left_out_zero;
  if (thinning <= 1) return;
  // The engine cannot know that returns were left out; a gap in a wall may have gone unnoticed.
  for (pose_wall_value& v : result->quantity) {
    if (v.state == POSE_WALL_VALID) v.state = POSE_WALL_DEGRADED;
    if (v.raw_state == POSE_WALL_VALID) v.raw_state = POSE_WALL_DEGRADED;
  }
}

}  // namespace pose_wall::runtime
