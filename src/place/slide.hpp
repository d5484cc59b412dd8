// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// How far a fit could slide along the direction that holds least. Evidence is what patches agree on: normals of noise
// make any wall look as if it held its scan (planar/match/README.md).

#pragma once

#include "place/patches.hpp"

namespace pose_wall::planar {

// From the longest to the shortest, halved each time. What slides by the longest may slide on.
constexpr double kSlideMost_m = 3.2, kSlideLeast_m = 0.1;

struct Slide {
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  // unit, in the map
  double reach_m = 0.0;  // the largest shift that the patches do not exclude, to either side
};

// Where the place holds least, if yaw is free.
Eigen::Vector2d weakest_direction(const Eigen::Matrix3d& information);

// A fit of the rest with base held at a shift: a direction that is a degree off would leave the wall.
FitRule held_rule(const Fit& fit, const Eigen::Vector2d& direction, double shift_m, double sigma_m);

// A shift is excluded if the mean patch fits worse by so many standard errors.
template <typename Map>
Slide slide_of(const Map& map, const PatchedPoints& view, const Fit& fit, double excluded) {
  Slide out;
  out.direction = weakest_direction(fit.information);
  PatchCosts here, there;
  judge_patches(map, view, fit.pose, &here);
  const auto is_excluded = [&](double shift_m) {
    const FitRule rule = held_rule(fit, out.direction, shift_m, view.sigma_m);
    judge_patches(map, view, fit_pose(map, view.points, rule.prior.pose, rule).pose, &there);
    return worse_by(view, here, there) > excluded;
  };
  for (double shift_m = kSlideMost_m; shift_m >= kSlideLeast_m; shift_m *= 0.5) {
    if (is_excluded(shift_m) && is_excluded(-shift_m)) continue;
    out.reach_m = shift_m;
    break;
  }
  return out;
}

// What a fit tells about x, y and yaw in the map: without what the slide leaves open, and since points of one surface
// err alike, much less than so many independent points would tell.
Eigen::Matrix3d told_by(const Fit& fit, const Slide& slide);

}  // namespace pose_wall::planar
