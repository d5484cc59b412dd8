// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/sample/sigmas.hpp"

#include <cmath>

namespace pose_wall {
namespace {

void set_sigmas_of_one(const PatchErrors& errors, double sigmas, FittedWall* wall) {
  const Spread slope = errors.spread_of(Eigen::Vector3d::UnitY(), sigmas);
  wall->yaw_sigma_rad = wall->yaw_per_slope * std::sqrt(slope.variance);
  wall->yaw_dof = slope.dof;
  for (int end = 0; end < 2; ++end) {
    const Spread at = errors.spread_of(wall->at_sample[end], sigmas);
    wall->distance_sigma_m[end] = std::sqrt(at.variance);
    wall->distance_dof[end] = at.dof;
  }
  // The place where offset and slope are uncorrelated.
  wall->pivot_level_m = wall->origin_level_m - wall->u_level * (errors.covariance()(0, 1) / slope.variance);
}

}  // namespace

void set_sigmas(const PatchErrors (&errors)[2], double sigmas, JudgedWall (*walls)[2]) {
  const bool both = !(*walls)[0].fit.refused && !(*walls)[1].fit.refused;
  for (int side = 0; side < 2; ++side) {
    JudgedWall& wall = (*walls)[side];
    if (!wall.fit.found) continue;
    PatchErrors own = errors[side];
    // A wall that may bend looks as if it had long waves, and other rock knows nothing of that. A thing that may be no
    // wall shows no rock.
    if (both && wall.straight && !(*walls)[1 - side].may_be_no_wall)
      own.layer[0].weigh(errors[1 - side].layer[0].evidence);
    set_sigmas_of_one(own, sigmas, &wall);
  }
}

}  // namespace pose_wall
