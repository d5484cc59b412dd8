// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/sample/at_sample.hpp"

#include <cmath>

#include "base/estimation/near_plane.hpp"
#include "base/math/finite.hpp"
#include "engine/walls/sample/distances.hpp"
#include "engine/walls/sample/step_profile.hpp"

namespace pose_wall {
namespace {

// These distances come from few points of surfaces that were not fitted.
double with_margin(double other_m) {
  return other_m > 0.0 ? 1.25 * other_m + 0.05 : 0.0;
}

// The deepest part of an opening is in its shadow; swept: half 18 moved, twice 18 moved.
constexpr double kBackMargin = 2.5;

constexpr double kOff_m = 0.1;  // two thresholds; such a point is not on the plane; swept: half 11 moved, twice 1 won

// Points of the band before the plane or behind it.
struct Around {
  Distances nearer;     // points nearer to the sampling point than the plane, where the plane is not seen
  StepProfile profile;  // of steps that are shorter than a column of the grid

  // A thing may hide the wall from top to bottom near a sampling point. It may be the wall itself, standing out.
  // Returns how much nearer to the sampling point it is than the plane, or 0.
  double stands_out_m(double to_machine_m) const {
    return nearer.count() >= StepProfile::kPointsMin ? to_machine_m - nearer.at_rank(StepProfile::kPointsMin) : 0.0;
  }
};

// across: plane through the sampling point, which lies to_machine_m before the wall.
Around look_around(const WallScene& scene, const WallSurface& surface, const WallGrid& grid, const Plane& wall,
                   const Plane& across, double to_machine_m) {
  constexpr double kWindow_m = 2.0;  // things so far beside may be nearer than the plane
  constexpr double kStep_m = 0.05;   // a smaller step is the rock's; a narrow road was valid and 12 cm off (seed 513)
  constexpr double kPerRoughness = 3.0;  // standard deviations of the rock: less is no step
  const double on_plane_m = kStep_m + kPerRoughness * surface.patch.tau_m;
  // Nearer points are the machine's. If the machine touches the wall, points of the wall are not.
  const double nearest_m = larger(to_machine_m - kOff_m, on_plane_m);
  const Eigen::Vector3d up_level = scene.R_level_base * scene.extrinsic.R_base_lidar.col(2);  // the sensor's own
  Around around{{}, StepProfile(on_plane_m)};
  const Slab beside(across, kWindow_m), this_side(wall, kAnyDepth_m, nearest_m);
  for_each_in_both(scene.band_level, beside, this_side, [&](std::uint32_t i) {
    const Eigen::Vector3d p = scene.band_level.at(i);
    const double r = wall.signed_distance(p), beside_m = across.signed_distance(p);
    if (r >= kOff_m && r <= to_machine_m - kOff_m) {
      const double lateral_m = to_machine_m - r;
      const double away_m = std::sqrt(lateral_m * lateral_m + beside_m * beside_m);
      if (away_m < to_machine_m && !grid.is_solid_at(beside_m - across.d)) around.nearer.add(away_m);
    }
    if (surface.heights.contain(p.z()) && std::fabs(beside_m) <= StepProfile::kHalf_m) {
      const Eigen::Vector3d ray = p - scene.sensor_level_m;
      const double up = up_level.dot(ray);
      around.profile.add(beside_m, r, up / std::sqrt(ray.squaredNorm() - up * up));
    }
  });
  return around;
}

// Depth behind the plane, where it is open at a sampling point, at which the rays that pass it there end: the wall
// steps back, or a road branches off. 0 where it is not open. The edge of an opening shadows the place behind it, so
// the rays show more than the points beside the sampling point do.
double steps_back_at(const WallScene& scene, const Plane& wall, const Plane& across) {
  constexpr double kWindow_m = 0.5;      // a column of the grid to either side
  constexpr double kShadowFactor = 2.5;  // the depth of a shadow is unknown; swept: half 6 moved, twice 6 moved
  const double inside_m = wall.signed_distance(scene.sensor_level_m),
               sensor_m = across.signed_distance(scene.sensor_level_m);
  Distances passing, beside;
  for (std::uint32_t i = 0; i < scene.band_level.count && inside_m > 0.0; ++i) {
    const Eigen::Vector3d p = scene.band_level.at(i);
    const double r = wall.signed_distance(p), beside_m = across.signed_distance(p);
    if (!(r < -kOff_m)) continue;
    if (std::fabs(on_the_way(sensor_m, beside_m, way_to_plane(inside_m, r))) <= kWindow_m) passing.add(-r);
    if (std::fabs(beside_m) <= kWindow_m) beside.add(-r);
  }
  const bool in_shadow = beside.count() < StepProfile::kPointsMin;
  const double passing_m = passing.count() >= StepProfile::kPointsMin ? passing.at_share(Distances::kNearlyAll) : 0.0;
  const double beside_m = in_shadow ? kShadowFactor * passing_m : beside.at_share(0.5);
  return larger(passing_m, beside_m);
}

// True if the plane is solid at the sampling point and on both sides. A column is half a metre wide and may hold the
// wall's last points in its nearer part only.
bool solid_around(const WallGrid& grid, double along_m) {
  for (const double beside_m : {-0.75, -0.3, 0.3, 0.75}) {
    if (!grid.is_solid_at(along_m + beside_m)) return false;
  }
  return true;
}

}  // namespace

AtSample look_at_sample(const WallScene& scene, const WallSurface& surface, const WallGrid& grid,
                        const FittedWall& wall, const Eigen::Vector3d& sample_level_m) {
  const double along_m = wall.along_level.dot(sample_level_m);
  const Plane& plane = wall.fit.plane;
  const Plane across{wall.along_level, -along_m};
  const double to_machine_m = plane.signed_distance(sample_level_m);
  const Around around = look_around(scene, surface, grid, plane, across, to_machine_m);
  // A step may share its columns with the wall beside it.
  const double out_m = larger(around.stands_out_m(to_machine_m), around.profile.before_m());
  const double back_m =
      larger(solid_around(grid, along_m) ? 0.0 : steps_back_at(scene, plane, across), around.profile.behind_m());
  AtSample seen;
  seen.hole_m = around.profile.hole_m();
  seen.bound_m = with_margin(out_m) + kBackMargin * back_m;
  return seen;
}

}  // namespace pose_wall
