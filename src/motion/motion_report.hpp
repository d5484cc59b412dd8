// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A frame's findings in the form of the C ABI.

#pragma once

#include "motion/frame.hpp"
#include "motion/range_image.hpp"

namespace pose_wall::motion {

// A result without a pose: not a number, and levels without a bound.
void report_nothing(pose_wall_motion_result* out);

// start: base of the first frame in the map.
void report(const Frame& frame, const Pose& start, pose_wall_motion_result* out);

}  // namespace pose_wall::motion
