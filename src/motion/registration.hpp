// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The observations on the map, and the two steps of Levenberg-Marquardt on them (the document's section 3): roll, pitch
// and height by the ground, then the place across and yaw by the rest. The place along is optional.

#pragma once

#include "motion/features.hpp"
#include "motion/gates.hpp"
#include "motion/relief_map.hpp"

namespace pose_wall::motion {

// One scan against the map.
struct Scan {
  const ReliefMap* map;
  Span<const Observation> observation;
  Eigen::Vector3f sensor_base_m;
};

// How one observation lies.
struct Fit {
  Surface surface;
  Eigen::Vector3f p;       // in the map, from its corner
  Eigen::Vector3f normal;  // of the tile's plane
  float distance_m;        // of the point from the rock, along the normal; from the plane where has_relief is false
  float variance_m2;       // that noise alone gives the distance
  float incidence2;        // squared cosine between ray and normal
  bool has_relief;
};
bool fit_observation(const Scan& scan, const LocalPose& pose, const Observation& o, Fit* fit);
// The same for poses that are shifted by equal steps.
struct Shifts {
  Eigen::Vector3f axis;
  float first_m, step_m;
  std::uint32_t count;
};
// Misfits in deviations, `apart` numbers apart, of a fit that holds incidence and tile; NaN where the map does not know
// the rock, unless the plane will do. Gives at how many shifts the map knows it.
std::uint32_t fit_shifted(const Scan& scan, const Fit& fit, const Shifts& shifts, bool by_plane, std::uint32_t apart,
                          float* misfit);

bool faces_along(const Eigen::Vector3f& normal, const Eigen::Vector3f& along);

// The road's axes in the map: along is where the surfaces give least hold.
struct RoadAxes {
  Eigen::Vector3d along = Eigen::Vector3d::UnitX(), left = Eigen::Vector3d::UnitY(), up = Eigen::Vector3d::UnitZ();
  double hold = 0.0;  // information of the surfaces' normals along it, over that across; 1: a hall, 0: a smooth road
};

struct Alignment {
  Pose pose;
  RoadAxes axes;
  std::uint32_t matched = 0, ground = 0;  // observations that count
  bool ground_alone = false;              // the ground is seen well enough to do without the roof
  // Covariance of along, across, up, and turns about these axes, by patches of rock, so that neighbours that err
  // together count once. The along row is zero if it was not requested.
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

// The equations of a step, side by side: four are summed at once.
struct StepScratch {
  void lay_out(Arena& arena);
  Span<float> by_move[6];  // how the distance goes along, across, up, and with turns about these axes
  Span<float> distance, variance;
  Span<float> known;  // 1 where the map knows the relief
  Span<float> pull;   // distance by its weight, as last summed
  Span<std::uint16_t> tile;
  Span<float> sum[3];  // by tile
};

// From surfaces nearby, or with use_relief from those within a few deviations of the rock. with_along: the step across
// takes the way along, too.
struct StepOptions {
  bool use_relief = false;
  bool with_along = false;
  int rounds = 3;
  std::uint32_t every = 1;  // one of so many observations is used
};
void find_axes(const Scan& scan, const Eigen::Vector3d& forward_map, Alignment* alignment);
// Step one, by ground and walls: roll, pitch and height. Step two, by walls and roof: the place across and yaw. Whether
// they went so far that others would follow.
bool take_steps(const Scan& scan, const StepOptions& options, StepScratch* scratch, Alignment* alignment);

}  // namespace pose_wall::motion
