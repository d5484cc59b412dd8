// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/walls_at_sample.hpp"

#include <cmath>

#include "estimation/distances.hpp"
#include "estimation/near_plane.hpp"
#include "estimation/step_profile.hpp"
#include "math/larger.hpp"

namespace pose_wall {
namespace {

// These distances are read off few points of surfaces nobody fitted.
double with_margin(double other_m) {
  return other_m > 0.0 ? 1.25 * other_m + 0.05 : 0.0;
}

constexpr double kBackMargin = 2.5;  // the deepest part of an opening is in its shadow

constexpr std::uint32_t kOtherPointsMin = 10;
constexpr double kOff_m = 0.1;

// By so much more than asked for is looked at in floats; what counts is told in doubles.
constexpr double kFloats_m = 0.001;

// Where the wall is not seen near a sampling point because something stands before it from top to bottom, that may be
// the wall itself, standing out: by how much it is nearer to the sampling point than the plane. 0 where nothing is.
double stands_out_at(const WallScene& scene, const WallGrid& grid, const WallResult& wall,
                     const Eigen::Vector3d& sample_level_m, double distance_m) {
  constexpr double kWindow_m = 2.0;
  const double along_m = wall.along_level.dot(sample_level_m);
  const double to_machine_m = wall.fit.plane.signed_distance(sample_level_m);
  const Slab beside({wall.along_level, -along_m}, kWindow_m + kFloats_m);
  const Slab before(wall.fit.plane, kOff_m - kFloats_m, to_machine_m);
  Distances nearer;
  for_each_in_both(scene.band_level, beside, before, [&](std::uint32_t i) {
    const Eigen::Vector3d p = scene.band_level.at(i);
    const double r = wall.fit.plane.signed_distance(p), beside_m = wall.along_level.dot(p) - along_m;
    if (!(r >= kOff_m && r <= to_machine_m - kOff_m) || !(std::fabs(beside_m) <= kWindow_m)) return;
    const double lateral_m = to_machine_m - r;
    const double away_m = std::sqrt(lateral_m * lateral_m + beside_m * beside_m);
    if (away_m < distance_m && !grid.is_solid_at(along_m + beside_m)) nearer.add(away_m);
  });
  return nearer.count() >= kOtherPointsMin ? distance_m - nearer.at_rank(kOtherPointsMin) : 0.0;
}

// Where the plane is open at a sampling point, how far behind it the rays end that pass it there: the wall steps back,
// or a road branches off. 0 where it is not open. What lies right behind the opening's edge is in its shadow, so the
// rays tell more than the points beside the sampling point do.
double steps_back_at(const WallScene& scene, const WallResult& wall, const Eigen::Vector3d& sample_level_m) {
  constexpr double kWindow_m = 0.5;
  constexpr double kDeepShare = 0.95;
  constexpr double kShadowFactor = 2.5;  // nothing tells how deep a shadow is
  const Eigen::Vector3d& sensor = scene.sensor_level_m;
  const double along_m = wall.along_level.dot(sample_level_m), inside_m = wall.fit.plane.signed_distance(sensor);
  Distances passing, beside;
  for (std::uint32_t i = 0; i < scene.band_level.count && inside_m > 0.0; ++i) {
    const Eigen::Vector3d p = scene.band_level.at(i);
    const double r = wall.fit.plane.signed_distance(p);
    if (!(r < -kOff_m)) continue;
    const Eigen::Vector3d crossing = sensor + (p - sensor) * way_to_plane(inside_m, r);
    if (std::fabs(wall.along_level.dot(crossing) - along_m) <= kWindow_m) passing.add(-r);
    if (std::fabs(wall.along_level.dot(p) - along_m) <= kWindow_m) beside.add(-r);
  }
  const bool in_shadow = beside.count() < kOtherPointsMin;
  const double passing_m = passing.count() >= kOtherPointsMin ? passing.at_share(kDeepShare) : 0.0;
  const double beside_m = in_shadow ? kShadowFactor * passing_m : beside.at_share(0.5);
  return passing_m > beside_m ? passing_m : beside_m;
}

// Solid at the sampling point and to both sides of it. A column is half a metre wide and may hold the wall's last
// points in its nearer part only.
bool solid_around(const WallGrid& grid, double along_m) {
  for (const double beside_m : {0.3, 0.75}) {
    if (!grid.is_solid_at(along_m - beside_m) || !grid.is_solid_at(along_m + beside_m)) return false;
  }
  return true;
}

// What a column of the grid is too long to tell.
StepProfile profile_at(const WallScene& scene, const WallSurface& surface, const WallResult& wall,
                       const Eigen::Vector3d& sample_level_m) {
  constexpr double kStep_m = 0.05;
  constexpr double kPerRoughness = 3.0;
  const double along_m = wall.along_level.dot(sample_level_m);
  const double on_plane_m = kStep_m + kPerRoughness * surface.patch.tau_m;
  // What lies nearer is the machine's; of a machine that touches the wall, the wall is not.
  const double nearest_m = larger(wall.fit.plane.signed_distance(sample_level_m) - kOff_m, on_plane_m);
  StepProfile profile(on_plane_m);
  const Plane across{wall.along_level, -along_m};
  const Slab beside(across, StepProfile::kHalf_m + kFloats_m);
  const Slab this_side(wall.fit.plane, kAnyDepth_m, nearest_m + kFloats_m);
  for_each_in_both(scene.band_level, beside, this_side, [&](std::uint32_t i) {
    const Eigen::Vector3d p = scene.band_level.at(i);
    const double r = wall.fit.plane.signed_distance(p);
    if (r <= nearest_m && surface.heights.contain(p.z())) profile.add(across.signed_distance(p), r);
  });
  return profile;
}

}  // namespace

AtSample look_at_sample(const WallScene& scene, const WallSurface& surface, const WallGrid& grid,
                        const WallResult& wall, const Eigen::Vector3d& sample_level_m, double distance_m) {
  const double along_m = wall.along_level.dot(sample_level_m);
  double out_m = stands_out_at(scene, grid, wall, sample_level_m, distance_m);
  double back_m = solid_around(grid, along_m) ? 0.0 : steps_back_at(scene, wall, sample_level_m);
  // A step may share its columns with the wall beside it.
  const StepProfile profile = profile_at(scene, surface, wall, sample_level_m);
  out_m = larger(out_m, profile.before_m());
  back_m = larger(back_m, profile.behind_m());
  AtSample seen;
  seen.hole_m = profile.hole_m();
  seen.interrupted = out_m > 0.0 || back_m > 0.0;
  seen.bound_m = with_margin(out_m) + kBackMargin * back_m;
  return seen;
}

}  // namespace pose_wall
