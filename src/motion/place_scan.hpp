// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The third step of a frame: the scan's place in the map. The two steps of the registration, the match along the road,
// and what became of them.

#pragma once

#include "motion/along_match.hpp"
#include "motion/expect.hpp"
#include "motion/look.hpp"
#include "motion/start_counts.hpp"

namespace pose_wall::motion {

struct Placed {
  std::uint32_t state = POSE_WALL_ALONG_MEASURED, reasons = 0;
  bool wide = false;  // it took a wide start
  Alignment alignment;
  Curve curve;
  double halves_m = -1.0;         // negative: not measured
  double rock_variance_m2 = 0.0;  // of the way along, pooled with that of the frames before
  bool is_guessed = false;        // the way along is a guess that is better than the last speed

  bool is(std::uint32_t along_state) const { return state == along_state; }
};

struct PlaceScratch {
  void lay_out(Arena& arena);
  StepScratch steps;
  CurveScratch curve;
  StartScratch starts;  // in the place of the two before it, which are used later
};

// What a scan is placed by, all of it of the frames before.
struct Road {
  const ReliefMap& map;
  const Course& course;
  const MotionSettings& settings;
  Eigen::Vector3d sensor_base_m;
};

// Faces the observations for the attitude that it finds.
Placed place_scan(const Road& road, const Frame& frame, const Pose& expected, const Seen& seen, PlaceScratch* scratch,
                  Work* work);

}  // namespace pose_wall::motion
