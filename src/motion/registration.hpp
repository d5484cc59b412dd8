// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The two steps of Levenberg-Marquardt on the observations (the document's section 3): roll, pitch and height by the
// ground, then the place across and yaw by the rest. The place along is optional.

#pragma once

#include "motion/road_axes.hpp"

namespace pose_wall::motion {

struct Alignment {
  Pose pose;
  RoadAxes axes;
  std::uint32_t matched = 0, ground = 0;  // observations that count
  bool ground_alone = false;              // the ground is seen well enough to do without the roof
  bool told = false;                      // both steps had enough for a covariance; else it is none
  // Covariance of along, across, up, and turns about these axes, by patches of rock, so that neighbours that err
  // together count once. The along row is zero if it was not requested.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

// The equations of a step, side by side: four are summed at once.
struct StepScratch {
  void lay_out(Arena& arena);
  Span<float> by_move[6];  // how the distance goes along, across, up, and with turns about these axes
  Span<float> distance, variance;
  Span<float> known;         // 1 where the map knows the relief
  Span<float> weight, pull;  // as last summed; pull is distance by weight
  Span<std::uint16_t> tile;
  Span<float> sum[9];  // by tile: of pulls, of weights
};

// From surfaces nearby, or with use_relief from those within a few deviations of the rock. with_along: the step across
// takes the way along, too, by rock that faces along; else that is left out.
struct StepOptions {
  bool use_relief = false;
  bool with_along = false;
  int rounds = 3;
  std::uint32_t every = 1;  // one of so many observations is used
};
// Step one, by ground and walls: roll, pitch and height. Step two, by walls and roof: the place across and yaw. Whether
// they went so far that others would follow.
bool take_steps(const Scan& scan, const StepOptions& options, StepScratch* scratch, Alignment* alignment);

}  // namespace pose_wall::motion
