// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The machine's own data since the last frame (pose_wall_inputs), as one more measurement of motion.

#pragma once

#include "pose_wall.h"

namespace pose_wall::motion {

struct MachinePrior {
  // The way along forward_axis and the turn to the left, and their deviations; negative: not given.
  double way_m = 0.0, way_sigma_m = -1.0, turn_rad = 0.0, turn_sigma_rad = -1.0;
  bool sound = true;  // false: out of range, and nothing is given

  bool has_way() const { return way_sigma_m >= 0.0; }
  bool has_turn() const { return turn_sigma_rad >= 0.0; }
};

MachinePrior ask_machine(const pose_wall_inputs* inputs, double dt_s);

// Weighs the given way into the rock's. way_m is the rock's along its axis, and variance_m2 its variance; towards is
// the cosine between forward_axis and the axis. They contradict each other if they differ by more than factor
// deviations; then the rock's way stays as it is.
struct WeighedWay {
  double further_m = 0.0;  // than the rock's
  double variance_m2;
  bool agrees = false;
};
WeighedWay weigh_in(const MachinePrior& prior, double towards, double way_m, double variance_m2, double factor);

}  // namespace pose_wall::motion
