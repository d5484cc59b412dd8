// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/region.hpp"

#include <cmath>

#include "base/estimation/protection.hpp"
#include "engine/gates/gate.hpp"
#include "engine/walls/doubts/edges.hpp"
#include "engine/walls/doubts/sight.hpp"
#include "engine/walls/fit/groove_profile.hpp"

namespace pose_wall {
namespace {

constexpr double kAlong_m = 2.5;    // of the definition
constexpr double kNearest_m = 0.3;  // from the machine's middle: what is nearer is the machine
// A share that is seen through counts so often: a cell with a prop in it is seen, and sparse rays miss most of the gaps
// beside it. Rows of props before nothing of which a VLP-16 and a Mid-360 saw 0.16 to 0.18 open were told as walls with
// 2. Of 285 walls of a real gallery, 98 % of them open for less than 0.14, none changes between 2 and 4 (2026-12-01).
constexpr double kOpenCounts = 4.0;
// Half the second derivative: the roof arch of a road of 4 m, where it comes down into the band.
constexpr double kBend_per_m = 0.1;

// The cells hold a window of depth about the wall, as far as one is known.
double nearest_of(const Region& region, const JudgedWall& endless) {
  constexpr double kBefore_m = 3.0;  // half of the window and less: what stands nearer is no wall's
  if (!endless.fit.found) return kNearest_m;
  const Plane& plane = endless.fit.plane;
  const double out = -plane.n.dot(region.h), skew = std::fabs(plane.n.dot(region.u)) * region.u_to_m;
  return larger(kNearest_m, (plane.d - skew) / out - kBefore_m);
}

Region region_of(const WallScene& scene, int side, const JudgedWall& endless) {
  Region region;
  region.u = scene.forward_level;
  region.v = Eigen::Vector3d::UnitZ();
  region.h = side == 0 ? scene.left_level : Eigen::Vector3d(-scene.left_level);
  region.u_from_m = 0.0;
  region.u_to_m = kAlong_m;
  region.v_min_m = scene.z_min_level_m;
  region.v_max_m = scene.z_max_level_m;
  region.sensor_m = scene.sensor_level_m;
  region.bend_per_m.fill(kBend_per_m);
  region.goes_on = {true, false};  // further along as little is seen above and below
  region.h_min_m = nearest_of(region, endless);
  return region;
}

// Pipes one above the other, all along the region. Further along an uncertain direction takes its plane off the wall:
// there the endless wall tells.
bool is_grooved(const WallScene& scene, const Plane& plane, const Eigen::Vector3d& along_level) {
  constexpr float kNear_m = 0.3F;  // twice the formula's width
  GrooveProfile profile(scene.z_min_level_m, scene.z_max_level_m, 0.0);
  const Eigen::Vector3f n = plane.n.cast<float>(), along = along_level.cast<float>();
  const auto d = static_cast<float>(plane.d);
  for_each_four_points(
      scene.band_level, [&](std::uint32_t, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
        const FourFloats off = n.x() * x + n.y() * y + n.z() * z + d, u = along.x() * x + along.y() * y;
        const FourTruths inside = magnitude_of(u) < all_four(static_cast<float>(kAlong_m));
        profile.add(u, z, off, counts & inside & (magnitude_of(off) < all_four(kNear_m)));
      });
  return profile.is_grooved();
}

// A thing that hides the wall is none. The gates are those of an endless plane, but for rays through gaps: an opening
// is no wall and weighs little in the region's plane. A row of props has gaps that show nothing, so what is seen
// through lowers the region's weight.
bool is_wall(const WallScene& scene, const JudgedWall& wall, const JudgedWall& endless, WallsScratch* scratch,
             RegionPlane* region) {
  POSE_WALL_NOTE(const trace::Silence silence);  // a plane that fails is not taken, and its gates stop nothing else
  const Settings& s = scene.settings;
  Verdict verdict;
  demand<gate::WALL_INLIERS>(&verdict, region->points, s);
  demand<gate::WALL_LENGTH>(&verdict, region->length_m, s);
  demand<gate::WALL_LEAN>(&verdict, std::fabs(wall.lean_rad), s);
  demand<gate::WALL_YAW>(&verdict, std::fabs(wall.yaw_rad), s);
  if (verdict.refused) return false;
  const Plane& plane = wall.fit.plane;
  demand<gate::WALL_GROOVES>(&verdict, !endless.grooved && !is_grooved(scene, plane, wall.along_level));
  scratch->fit.work.add(steps::kWallLookedAt);
  scratch->fit.work.add(scene.band_level.count, steps::kPointLookedAt);
  const WallSight sight = look_at(scene, plane, wall.along_level, kWellBehind_m, &scratch->sight);
  const WallEdges edges = look_past(scene, plane, wall.along_level, on_wall_m(s), &scratch->edges);
  demand<gate::WALL_BRIGHT>(&verdict, !sight.dim);
  demand<gate::WALL_SILENT>(&verdict, sight.silent, s);
  demand<gate::WALL_ISLAND>(&verdict, !edges.island);
  demand<gate::WALL_LOW>(&verdict, !edges.low);
  demand<gate::WALL_TOP_SEEN>(&verdict, !edges.top_unseen);
  region->near *= larger(1.0 - kOpenCounts * sight.open, 0.0);
  return verdict.reasons == 0;
}

double level_of(const JudgedWall& wall, int end, const Settings& s) {
  const double factor = protection_factor(s.protection_sigmas, wall.distance_dof[end]);
  return factor * wall.distance_sigma_m[end] + wall.distance_bound_m[end].sum() + kLayerFactor * wall.layer_sigma_m;
}

double worse_of(const JudgedWall& wall, const Settings& s) {
  return larger(level_of(wall, 0, s), level_of(wall, 1, s));
}

// Either may be the wall.
void reach_to(const JudgedWall& region, const Settings& s, JudgedWall* endless) {
  for (int end = 0; end < 2; ++end) {
    endless->distance_bound_m[end][POSE_WALL_PART_RIVAL] +=
        std::fabs(endless->distance_m[end] - region.distance_m[end]) + level_of(region, end, s);
  }
}

// How distances and direction follow from h = at[0] + at[1] u + at[2] v. A distance is square to the plane, so it
// follows a lean as well.
Eigen::Vector3d of_distance(const WallScene& scene, const Region& region, const Eigen::Vector3d& at, int side,
                            int end) {
  const Eigen::Vector3d sample = region.coordinates(scene.sample_level_m[side][end]);
  const Eigen::Vector3d row(1.0, sample.x(), sample.y()), slopes(0.0, at[1], at[2]);
  const double length2 = 1.0 + slopes.squaredNorm();
  return (row - (at.dot(row) - sample.z()) / length2 * slopes) / std::sqrt(length2);
}

Eigen::Vector3d of_yaw(const Eigen::Vector3d& at) {
  return {0.0, 1.0 / (1.0 + at[1] * at[1]), 0.0};
}

JudgedWall wall_of(const WallScene& scene, const Region& region, const RegionPlane& found, int side,
                   const JudgedWall& before) {
  const Settings& s = scene.settings;
  JudgedWall wall;
  wall.fit.found = true;
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
  wall.yaw_sigma_rad = found.sigma(of_yaw(found.at));
  wall.yaw_bound_rad = found.bound(of_yaw(found.at), s);
  wall.yaw_dof = found.dof;
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d of = of_distance(scene, region, found.at, side, end);
    wall.distance_m[end] = distance_at(wall.fit.plane, scene.sample_level_m[side][end]);
    wall.distance_sigma_m[end] = found.sigma(of);
    wall.distance_bound_m[end] = found.bound(of, s);
    wall.distance_dof[end] = found.dof;
    // A distance has no sign: a point in the rock has that of one before it.
    const bool in_rock = wall.fit.plane.signed_distance(scene.sample_level_m[side][end]) < 0.0;
    wall.distance_bound_m[end][POSE_WALL_PART_EXTRAPOLATION] = in_rock ? 2.0 * wall.distance_m[end] : 0.0;
  }
  return wall;
}

// What all of the wall in view tells of its plane over the region: nothing if it was refused, or may be a thing.
UnevenFit known_of(const JudgedWall& endless, const Region& region) {
  UnevenFit errors;
  if (endless.fit.refused || endless.may_be_no_wall) return errors;
  errors.solved = true;
  const Eigen::Vector3d stretch(1.0, endless.yaw_per_slope, 1.0);
  errors.covariance = stretch.asDiagonal() * endless.covariance * stretch.asDiagonal();
  errors.bias_response = endless.bias_response;
  errors.dof = endless.yaw_dof;
  return over_region(region, endless.fit.plane, endless.frame, errors);
}

// What may be wrong with the endless wall at both ends moves what is predicted from it, as far as that follows it.
void reach_by_share(const WallScene& scene, const Region& region, const RegionPlane& predicted, int side,
                    const JudgedWall& endless, JudgedWall* wall) {
  const double lean = std::fabs(wall->fit.plane.n.z() - endless.fit.plane.n.z());  // by as much as the region tells
  const auto along = [&](int end) { return region.u.dot(scene.sample_level_m[side][end]); };
  const double apart_m = along(0) - along(1);
  const auto reach = [&](const Eigen::Vector3d& of, ProtectionParts* bound) {
    const Eigen::Vector3d share = predicted.share_of_endless(of);
    const double of_front = (share[1] - share[0] * along(1)) / apart_m;
    const double of_end[2] = {of_front, share[0] - of_front};
    ProtectionParts of_endless;
    for (int end = 0; end < 2; ++end) of_endless.add(endless.distance_bound_m[end], std::fabs(of_end[end]));
    of_endless[POSE_WALL_PART_RANGE_BIAS] = 0.0;  // its response is known, with its sign
    of_endless[POSE_WALL_PART_BEND] += std::fabs(share[2]) * lean;
    bound->add(of_endless);
  };
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d of = of_distance(scene, region, predicted.at, side, end);
    reach(of, &wall->distance_bound_m[end]);
    wall->layer_sigma_m =
        larger(wall->layer_sigma_m, std::fabs(predicted.share_of_endless(of)[0]) * endless.layer_sigma_m);
  }
  // Doubts that tell nothing of a distance.
  const double turns = std::fabs(predicted.share_of_endless(of_yaw(predicted.at))[1]);
  reach(of_yaw(predicted.at), &wall->yaw_bound_rad);
  wall->yaw_bound_rad[POSE_WALL_PART_RIVAL] += turns * endless.yaw_bound_rad[POSE_WALL_PART_RIVAL];
  wall->yaw_to_rival_rad = turns * endless.yaw_to_rival_rad;
}

// Whether the waves explain how far the two lie apart. The endless distances hold the waves already.
bool rides_on(const JudgedWall& endless, const JudgedWall& region) {
  const double yaw_sigma_rad = with_waves(endless.yaw_sigma_rad, region.yaw_waves_rad);
  bool all = may_be_waves(endless.yaw_rad - region.yaw_rad, yaw_sigma_rad, region.yaw_sigma_rad);
  for (int end = 0; end < 2; ++end) {
    all = all && may_be_waves(endless.distance_m[end] - region.distance_m[end], endless.distance_sigma_m[end],
                              region.distance_sigma_m[end]);
  }
  return all;
}

// The levels hold that wall as well.
void reach_within(const JudgedWall& other, const Settings& s, JudgedWall* wall) {
  for (int end = 0; end < 2; ++end) {
    const double apart_m = std::fabs(other.distance_m[end] - wall->distance_m[end]);
    wall->distance_bound_m[end][POSE_WALL_PART_RIVAL] += larger(apart_m - level_of(*wall, end, s), 0.0);
  }
  const double factor = protection_factor(s.protection_sigmas, wall->yaw_dof);
  const double known_rad = factor * wall->yaw_sigma_rad + wall->yaw_bound_rad.sum();
  const double apart_rad = std::fabs(other.yaw_rad - wall->yaw_rad);
  wall->yaw_bound_rad[POSE_WALL_PART_RIVAL] += larger(apart_rad - known_rad, 0.0);
}

// What the endless wall tells of the region's. Where waves lead from one to the other it predicts the region. Else each
// level holds the other, if the region's cells show both.
void use_endless(const WallScene& scene, const Region& region, const RegionPlane& by_endless, int side,
                 JudgedWall* endless, RegionWall* out) {
  const bool rides = rides_on(*endless, out->wall);
  if (out->may_be_endless && !rides) {
    // Either is a plane of the region's cells, and no waves lead from one to the other.
    const JudgedWall alone = out->wall;
    reach_within(*endless, scene.settings, &out->wall);
    reach_within(alone, scene.settings, endless);
  }
  if (by_endless.found && rides) {
    JudgedWall predicted = wall_of(scene, region, by_endless, side, *endless);
    reach_by_share(scene, region, by_endless, side, *endless, &predicted);
    predicted.yaw_waves_rad = out->wall.yaw_waves_rad;
    predicted.distance_waves_m = out->wall.distance_waves_m;
    if (worse_of(predicted, scene.settings) < worse_of(out->wall, scene.settings)) out->wall = predicted;
  }
}

// A side without an endless wall shows none in its region either, but it may be shown to have none. The endless
// distances are widened to stand for the region's.
RegionWall measure_region(const WallScene& scene, int side, JudgedWall* endless, WallsScratch* scratch) {
  using Kind = RegionWall::Kind;
  RegionWall out;
  const Region region = region_of(scene, side, *endless);
  RegionPlane by_endless;
  RegionPlane found = scratch->region.fit(scene.band_level, region, scene.settings, &scratch->fit.patches.waves(),
                                          &scratch->fit.work, known_of(*endless, region), &by_endless);
  if (!found.found) return out;
  if (found.is_none()) {
    out.kind = Kind::kNone;
    return out;
  }
  // The region's plane answers doubts about what lies elsewhere, and a plane that is looked past.
  if (!endless->fit.found || (endless->fit.refused && (endless->fit.reasons & ~kDoubts) != 0)) return out;
  out.wall = wall_of(scene, region, found, side, *endless);
  if (!is_wall(scene, out.wall, *endless, scratch, &found)) return out;
  out.kind = found.is_there() ? Kind::kWall : Kind::kDoubtful;
  out.may_be_endless = found.may_be_endless;
  endless->yaw_waves_rad = out.wall.yaw_waves_rad = found.sigma_about_endless(of_yaw(found.at));
  for (int end = 0; end < 2; ++end) {
    const double waves_m = found.sigma_about_endless(of_distance(scene, region, found.at, side, end));
    endless->distance_sigma_m[end] = with_waves(endless->distance_sigma_m[end], waves_m);
    out.wall.distance_waves_m = larger(out.wall.distance_waves_m, waves_m);
  }
  endless->distance_waves_m = out.wall.distance_waves_m;
  use_endless(scene, region, by_endless, side, endless, &out);
  for (int end = 0; end < 2; ++end) {
    const double step_m = scratch->region.step_at(region.u.dot(scene.sample_level_m[side][end]), found.at);
    out.wall.extrapolated[end] = step_m > 0.0;
    out.wall.distance_bound_m[end][POSE_WALL_PART_EXTRAPOLATION] += step_m;
  }
  return out;
}

// By the definition the region's wall is right, and the endless one where that is known better.
void choose(const RegionWall& region, const Settings& s, JudgedWall* wall) {
  if (!region.has_plane()) return;
  if (region.kind == RegionWall::Kind::kDoubtful) {
    if (!wall->fit.refused) reach_to(region.wall, s, wall);
    return;
  }
  if (region.may_be_endless && worse_of(*wall, s) < worse_of(region.wall, s)) return;
  const WallAhead ahead = region.may_be_endless ? ahead_of(*wall, s) : WallAhead{};
  *wall = region.wall;
  wall->ahead = ahead;
  POSE_WALL_NOTE(trace::answered(POSE_WALL_TRACE_REFUSES));
}

// Endless walls tell the direction of the regions' as well as their waves allow, on an unknown side those of the other.
// By the definition a side that is none tells nothing where the other one is a wall.
void let_direct(const RegionWall& region, const RegionWall& other, JudgedWall* endless) {
  if (region.has_plane()) {
    endless->yaw_sigma_rad = with_waves(endless->yaw_sigma_rad, region.wall.yaw_waves_rad);
  } else if (other.has_plane()) {
    endless->yaw_sigma_rad = with_waves(endless->yaw_sigma_rad, other.wall.yaw_waves_rad);
    if (region.kind == RegionWall::Kind::kNone) endless->fit.refused = true;
  }
}

}  // namespace

void measure_wall_regions(const WallScene& scene, WallsScratch* scratch, MeasuredWalls* walls) {
  Work& work = scratch->fit.work;
  for (int side = 0; side < 2; ++side) {
    POSE_WALL_NOTE(const trace::About about(trace::side_subject(side)));
    JudgedWall& wall = walls->side[side];
    if (work.stops()) {
      demand_work_left(work, &wall.fit);
    } else {
      walls->region[side] = measure_region(scene, side, &wall, scratch);
    }
    walls->endless[side] = wall;
    choose(walls->region[side], scene.settings, &wall);
  }
  for (int side = 0; side < 2; ++side) let_direct(walls->region[side], walls->region[1 - side], &walls->endless[side]);
  walls->has_regions = true;
}

}  // namespace pose_wall
