// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A frame's findings in the form of the C ABI.

#pragma once

#include "motion/conclude.hpp"

namespace pose_wall::motion {

// All that the steps of a frame gave. A frame that ends early has nothing of the later ones.
struct Findings {
  std::uint32_t state = POSE_WALL_ALONG_LOST, reasons = 0;
  Seen seen;
  Placed placed;
  Concluded concluded;

  bool has_pose() const { return state != POSE_WALL_ALONG_LOST; }
  bool has_stamp() const { return (reasons & POSE_WALL_MOTION_R_STAMP) == 0; }
};

// A result without a pose: not a number, and levels without a bound.
void report_nothing(pose_wall_motion_result* out);

// start: base of the first frame in the map.
void report(const Frame& frame, const Findings& found, const Pose& start, pose_wall_motion_result* out);

}  // namespace pose_wall::motion
