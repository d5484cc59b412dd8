// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The fourth step of a frame: what its place says of the course, the motion, and the levels of both.

#pragma once

#include "motion/place_scan.hpp"

namespace pose_wall::motion {

struct Concluded {
  Course course;  // as it goes on from here
  MotionStep step;
  Bounds whole;  // of the pose since the start
  std::uint32_t reasons = 0;
};

// Of a scan that has a place.
Concluded conclude(const Road& road, const Frame& frame, const MachinePrior& prior, const Placed& placed);

}  // namespace pose_wall::motion
