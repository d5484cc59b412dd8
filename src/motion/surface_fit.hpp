// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// How one observation lies on the map: its distance from the rock, and what noise alone gives that. Of one pose, or of
// poses that are shifted along the road.

#pragma once

#include "motion/features.hpp"
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
// by_plane: by the tile's plane alone, also where its relief is known.
bool fit_observation(const Scan& scan, const LocalPose& pose, const Observation& o, Fit* fit, bool by_plane = false);
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

}  // namespace pose_wall::motion
