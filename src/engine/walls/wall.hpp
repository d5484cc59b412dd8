// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A wall on its way through the stage: WallCandidate (propose/) -> FittedWall -> JudgedWall.

#pragma once

#include <Eigen/Core>
#include <cmath>

#include "base/estimation/patch_fit.hpp"
#include "base/estimation/tangent_frame.hpp"
#include "base/math/finite.hpp"
#include "engine/config.hpp"
#include "engine/types.hpp"

namespace pose_wall {

constexpr double kLayerFactor = 2.0;  // ribs move a wall to one side, within bounds (walls/fit: What rock shows)

// The fit of one side's wall. u: metres along the road from the foot of the origin, v: metres up from the origin's
// level.
struct FittedWall {
  PlaneFit fit;
  Eigen::Vector3d along_level = Eigen::Vector3d::Zero();  // horizontal unit vector, towards the machine's front
  double lean_rad = 0.0;
  double yaw_rad = 0.0;  // by this wall alone
  double yaw_sigma_rad = 0.0;
  double yaw_bias_rad_per_m = 0.0;                          // signed response to a constant range error
  ProtectionParts yaw_bound_rad;                            // misfit
  Eigen::Vector3d pivot_level_m = Eigen::Vector3d::Zero();  // turning about here changes the fit least
  double distance_m[2] = {0.0, 0.0};                        // at s_front, s_back
  double distance_sigma_m[2] = {0.0, 0.0};
  ProtectionParts distance_bound_m[2];
  double layer_sigma_m = 0.0;  // how far ribs and cables may have moved the surface; part ratio of their standard
                               // deviations, with what strips and rock add
  bool extrapolated[2] = {false, false};
  double distance_dof[2] = {1.0, 1.0};  // independent pieces behind the distances' variances
  double yaw_dof = 1.0;                 // and behind the direction's
  // What set_sigmas() needs of the fit:
  double yaw_per_slope = 1.0;    // of the standard deviations
  TangentFrame frame;            // of the fit, levelled
  Eigen::Vector3d at_sample[2];  // of the plane's errors: 1, u, v
  // Errors of height and slopes in that frame. The covariance is set by set_sigmas(), where the wall is not refused.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  Eigen::Vector3d bias_response = Eigen::Vector3d::Zero();  // per metre of range bias
  double along_min_m = 0.0;
  double along_max_m = 0.0;
  // By which other rock beside the machine turns and shifts what is measured there: standard deviations. None without a
  // region's plane.
  double yaw_waves_rad = 0.0;
  double distance_waves_m = 0.0;
  double area_m2 = 0.0;
  bool straight = false;  // over its height, as far as it shows: its long waves are no bend
  bool grooved = false;   // its surface lies in two depths along its length, like pipes one above the other
};

// One argument against a wall. It widens the protection levels, or refuses the wall.
struct Doubt : Verdict {
  double off_m[2] = {0.0, 0.0};   // at s_front, s_back: how far the wall may be off
  double yaw_rad = 0.0;           // how far the direction may be off
  double yaw_to_rival_rad = 0.0;  // the same, if the direction is that of another wall
  bool may_be_no_wall = false;    // but a curtain, a vehicle or pipes: the direction is then that of a thing
};

// How a wall goes on along the road.
struct WallAhead {
  bool exists = false;  // else as it is itself
  Eigen::Vector3d normal_level = Eigen::Vector3d::UnitY(), along_level = Eigen::Vector3d::UnitX();
  double from_m = 0.0, to_m = 0.0;  // the stretch in which it was seen
  double slope_level = 0.0;         // of its direction
};

// The wall with all doubts in its bounds.
struct JudgedWall : FittedWall {
  WallAhead ahead;                // of a region's wall, as the endless one of the same surface
  double yaw_to_rival_rad = 0.0;  // if its rival is the wall, or the road bends before it
  bool may_be_no_wall = false;    // but a curtain, a vehicle or pipes

  JudgedWall() = default;
  explicit JudgedWall(const FittedWall& fitted) : FittedWall(fitted) {}

  void add(const Doubt& doubt) {
    fit.add(doubt);
    for (int end = 0; end < 2; ++end) distance_bound_m[end][POSE_WALL_PART_RIVAL] += doubt.off_m[end];
    yaw_bound_rad[POSE_WALL_PART_RIVAL] += doubt.yaw_rad;
    yaw_to_rival_rad = larger(yaw_to_rival_rad, doubt.yaw_to_rival_rad);
    may_be_no_wall = may_be_no_wall || doubt.may_be_no_wall;
  }
};

inline WallAhead ahead_of(const JudgedWall& wall, const Settings& s) {
  if (wall.ahead.exists) return wall.ahead;
  const double slope_level = wall.yaw_bound_rad.sum() + s.protection_sigmas * wall.yaw_sigma_rad +
                             s.range_bias_max * std::fabs(wall.yaw_bias_rad_per_m);
  return {true, wall.fit.plane.n, wall.along_level, wall.along_min_m, wall.along_max_m, slope_level};
}

// What the region beside the machine shows of a side (walls/region). Of a doubtful wall most or little less may be
// none.
struct RegionWall {
  enum class Kind { kUnknown, kNone, kDoubtful, kWall };
  Kind kind = Kind::kUnknown;
  bool may_be_endless = false;  // its cells show the endless wall as well
  JudgedWall wall;              // of a wall, and of a doubtful one

  bool is_known() const { return kind != Kind::kUnknown; }
  bool is_sure() const { return kind == Kind::kNone || kind == Kind::kWall; }
  bool has_plane() const { return kind == Kind::kDoubtful || kind == Kind::kWall; }
};

struct WallsResult {
  JudgedWall side[2];  // left, right: what the distances are of
  // Possible tilt error of the levelled frame, by the lean of both sides. Zero unless both are sure.
  Eigen::Vector3d tilt_level_rad = Eigen::Vector3d::Zero();
};

// With their regions, once these are measured. Yaw is of both sides, and needs both kinds of walls.
struct MeasuredWalls : WallsResult {
  bool has_regions = false;
  JudgedWall endless[2];
  RegionWall region[2];
};

}  // namespace pose_wall
