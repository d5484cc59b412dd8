// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "walls/region.hpp"

#include <cmath>

#include "base/estimation/protection.hpp"
#include "gates/gate.hpp"
#include "walls/doubts/edges.hpp"
#include "walls/doubts/sight.hpp"

namespace pose_wall {
namespace {

constexpr double kAlong_m = 2.5;    // of the definition
constexpr double kNearest_m = 0.3;  // from the machine's middle: what is nearer is the machine
// Half the second derivative: the roof arch of a road of 4 m, where it comes down into the band.
constexpr double kBend_per_m = 0.1;

Region region_of(const WallScene& scene, int side) {
  Region region;
  region.u = scene.forward_level;
  region.v = Eigen::Vector3d::UnitZ();
  region.h = side == 0 ? scene.left_level : Eigen::Vector3d(-scene.left_level);
  region.u_min_m = -kAlong_m;
  region.u_max_m = kAlong_m;
  region.v_min_m = scene.z_min_level_m;
  region.v_max_m = scene.z_max_level_m;
  region.h_min_m = kNearest_m;
  region.sensor_m = scene.sensor_level_m;
  region.bend_per_m = kBend_per_m;
  return region;
}

// A thing that hides the wall is none. The gates are those of an endless plane, but for rays through gaps: an opening
// is no wall and weighs little in the region's plane.
bool is_wall(const WallScene& scene, const RegionPlane& found, const JudgedWall& wall, WallsScratch* scratch) {
  const Settings& s = scene.settings;
  Verdict verdict;
  demand<gate::WALL_INLIERS>(&verdict, found.points, s);
  demand<gate::WALL_LENGTH>(&verdict, found.length_m, s);
  demand<gate::WALL_LEAN>(&verdict, std::fabs(wall.lean_rad), s);
  demand<gate::WALL_YAW>(&verdict, std::fabs(wall.yaw_rad), s);
  if (verdict.refused) return false;
  const Plane& plane = wall.fit.plane;
  scratch->fit.work.add(steps::kWallLookedAt);
  scratch->fit.work.add(scene.band_level.count, steps::kPointLookedAt);
  const WallSight sight = look_at(scene, plane, wall.along_level, kWellBehind_m, &scratch->sight);
  const WallEdges edges = look_past(scene, plane, wall.along_level, on_wall_m(s), &scratch->edges);
  demand<gate::WALL_BRIGHT>(&verdict, !sight.dim);
  demand<gate::WALL_SILENT>(&verdict, sight.silent, s);
  demand<gate::WALL_ISLAND>(&verdict, !edges.island);
  demand<gate::WALL_LOW>(&verdict, !edges.low);
  demand<gate::WALL_TOP_SEEN>(&verdict, !edges.top_unseen);
  return verdict.reasons == 0;
}

// The largest level of both distances: what a narrower one is compared by.
double level_of(const JudgedWall& wall, const Settings& s) {
  double most = 0.0;
  for (int end = 0; end < 2; ++end) {
    const double factor = protection_factor(s.protection_sigmas, wall.distance_dof[end]);
    most = larger(most, factor * wall.distance_sigma_m[end] + wall.distance_bound_m[end].sum());
  }
  return most;
}

JudgedWall wall_of(const WallScene& scene, const Region& region, const RegionPlane& found, int side,
                   const JudgedWall& before) {
  const Settings& s = scene.settings;
  JudgedWall wall;
  wall.fit.found = wall.of_region = true;
  wall.fit.reasons = before.fit.reasons & kDoubts;  // told, and answered by the level
  wall.fit.inliers = static_cast<std::uint32_t>(found.points);
  wall.fit.iterations = before.fit.iterations;
  wall.fit.rms_m = found.rough_m;
  wall.fit.plane = found.plane_in(region);
  wall.along_level = along_of(wall.fit.plane, scene.forward_level);
  wall.lean_rad = lean_of(wall.fit.plane);
  wall.area_m2 = found.area_m2;
  wall.along_min_m = -kAlong_m;
  wall.along_max_m = kAlong_m;
  wall.yaw_rad = yaw_of(wall.along_level, scene.forward_level);
  const Eigen::Vector3d of_yaw(0.0, 1.0 / (1.0 + found.at[1] * found.at[1]), 0.0);
  wall.yaw_sigma_rad = found.sigma(of_yaw);
  wall.yaw_bound_rad = found.bound(of_yaw, s.range_bias_max);
  wall.yaw_dof = found.dof;
  const double upright = std::sqrt(1.0 + found.at[1] * found.at[1] + found.at[2] * found.at[2]);
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d at = region.coordinates(scene.sample_level_m[side][end]);
    const Eigen::Vector3d of = Eigen::Vector3d(1.0, at.x(), at.y()) / upright;
    wall.distance_m[end] = distance_at(wall.fit.plane, scene.sample_level_m[side][end]);
    wall.distance_sigma_m[end] = found.sigma(of);
    wall.distance_bound_m[end] = found.bound(of, s.range_bias_max);
    wall.distance_dof[end] = found.dof;
    wall.extrapolated[end] = before.extrapolated[end];
    // A distance has no sign: a point in the rock has that of one before it.
    const bool in_rock = wall.fit.plane.signed_distance(scene.sample_level_m[side][end]) < 0.0;
    wall.distance_bound_m[end][POSE_WALL_PART_EXTRAPOLATION] = in_rock ? 2.0 * wall.distance_m[end] : 0.0;
  }
  return wall;
}

void measure_region(const WallScene& scene, int side, WallsScratch* scratch, JudgedWall* wall) {
  const Settings& s = scene.settings;
  // The region's plane answers doubts about what lies elsewhere, and a plane that is looked past. A side without a
  // wall, or with pipes one above the other, has none in its region either.
  if (!wall->fit.found || wall->grooved || (wall->fit.refused && (wall->fit.reasons & ~kDoubts) != 0)) return;
  const Region region = region_of(scene, side);
  const RegionPlane found =
      scratch->region.fit(scene.band_level, region, s, &scratch->fit.patches.waves(), &scratch->fit.work);
  wall->is_none = found.is_none();
  // By the definition the side may be none. Then the other one alone gives the road's direction.
  wall->may_be_no_wall = wall->may_be_no_wall || (found.found && !found.is_there() && !found.is_none());
  if (!found.is_there()) return;
  const JudgedWall taken = wall_of(scene, region, found, side, *wall);
  const bool is_narrower = wall->fit.refused || level_of(taken, s) < level_of(*wall, s);
  if (is_narrower && is_wall(scene, found, taken, scratch)) *wall = taken;
}

// By the definition the road's direction is of both walls. Where the other one is not known, and not known to be none,
// the endless wall's direction stays, which reaches to what is seen of the other side.
void keep_direction(const JudgedWall& before, JudgedWall* wall) {
  wall->yaw_rad = before.yaw_rad;
  wall->yaw_sigma_rad = before.yaw_sigma_rad;
  wall->yaw_bias_rad_per_m = before.yaw_bias_rad_per_m;
  wall->yaw_bound_rad = before.yaw_bound_rad;
  wall->yaw_dof = before.yaw_dof;
  wall->yaw_to_rival_rad = before.yaw_to_rival_rad;
  wall->may_be_no_wall = before.may_be_no_wall || before.fit.refused;
}

}  // namespace

void measure_wall_regions(const WallScene& scene, WallsScratch* scratch, JudgedWall (*walls)[2]) {
  Work& work = scratch->fit.work;
  const JudgedWall before[2] = {(*walls)[0], (*walls)[1]};
  for (int side = 0; side < 2; ++side) {
    POSE_WALL_NOTE(const trace::About about(trace::side_subject(side)));
    if (work.stops()) {
      demand_work_left(work, &(*walls)[side].fit);
      continue;
    }
    measure_region(scene, side, scratch, &(*walls)[side]);
  }
  for (int side = 0; side < 2; ++side) {
    const JudgedWall& other = (*walls)[1 - side];
    JudgedWall& wall = (*walls)[side];
    if (wall.of_region && other.fit.refused && !other.is_none) keep_direction(before[side], &wall);
  }
}

}  // namespace pose_wall
