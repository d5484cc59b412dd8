// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// How far a fit could slide along the direction that holds least. Evidence is what patches agree on: normals of noise
// make any wall look as if it held its scan (planar/match/README.md).

#pragma once

#include "place/patches.hpp"

namespace pose_wall::planar {

// Rounds of a new fit of all else at each shift: a direction that is a degree off would leave a smooth wall and exclude
// everything. Three rounds find no more: 1 of 19,084 tracked scans was wrong with them, and none with one.
constexpr std::uint32_t kRefit = 1;
// From the longest to the shortest, halved each time. What slides by the longest may slide on.
constexpr double kSlideMost_m = 3.2, kSlideLeast_m = 0.1;

struct Slide {
  Eigen::Vector2d direction = Eigen::Vector2d::UnitX();  // unit, in the map
  double reach_m = 0.0;  // the largest shift that the patches do not exclude, to either side
};

// Where the place holds least, if yaw is free.
Eigen::Vector2d weakest_direction(const Eigen::Matrix3d& information);

// Base held at a shift along the direction.
Prior held_at(const Fit& fit, const Eigen::Vector2d& direction, double shift_m);

// A shift is excluded if the mean patch fits worse by so many standard errors, with all else fitted anew.
template <typename Map>
Slide slide_of(const Map& map, const PatchedPoints& view, const Fit& fit, double excluded, std::uint32_t rounds) {
  Slide out;
  out.direction = weakest_direction(fit.information);
  PatchCosts here, there;
  judge_patches(map, view, fit.pose, &here);
  const auto is_excluded = [&](double shift_m) {
    const Prior held = held_at(fit, out.direction, shift_m);
    const FitRule rule{view.sigma_m, held, 1, rounds};
    const Pose2 shifted = rounds > 0 ? fit_pose(map, view.points, held.pose, rule).pose : held.pose;
    judge_patches(map, view, shifted, &there);
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
