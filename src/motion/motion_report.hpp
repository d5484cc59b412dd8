// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What each step of a frame gave, in the form of the C ABI.

#pragma once

#include "motion/conclude.hpp"

namespace pose_wall::motion {

// A result without a pose: not a number, and levels without a bound.
void report_nothing(pose_wall_motion_result* out);

// Each of the others goes on from there.
void report(const Seen& seen, pose_wall_motion_result* out);
void report(const Placed& placed, pose_wall_motion_result* out);
void report(const MotionStep& step, pose_wall_motion_result* out);
// start: base of the first frame in the map. is_start: this is that frame.
void report(const Course& course, const Bounds& whole, const Pose& start, bool is_start, pose_wall_motion_result* out);
// Where there is no pose the axis may still be known.
void report_axis(const RoadAxes& axes, const Pose& start, pose_wall_motion_result* out);

}  // namespace pose_wall::motion
