// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The view on the walls, and the geometry of a plane read as a wall.

#pragma once

#include <Eigen/Core>

#include "base/containers/bounded_points.hpp"
#include "base/estimation/plane.hpp"
#include "engine/cloud/direction_grid.hpp"
#include "engine/cloud/result.hpp"
#include "engine/config.hpp"
#include "engine/floor/levelling.hpp"
#include "engine/types.hpp"
#include "lidar/crossing.hpp"

namespace pose_wall {

// A return this far behind a plane passed through it: hollows of rough rock are shallower.
constexpr double kWellBehind_m = 0.25;  // swept: half 6 lost, twice 5 moved
// An unseen part of a wall may lie this much further away: as deep as a niche.
constexpr double kMayStep_m = 2.0;  // swept: half 36 moved, twice 36 moved
// The search for the top of a wall reaches this far above the band, up to most roofs.
constexpr double kAboveBand_m = 1.0;  // swept: half 1 moved, twice nothing

// The points and returns in view.
struct WallView {
  const BoundedPoints& band_level;
  const BoundedPoints& beyond_level;  // above and below the band; weight: how many points each stands for
  const BoundedPoints& cloud_base;    // all points, before the band was cut
  const ReturnsByDirection& returns_lidar;
  const IngestCounts& counts;
};

// The view and the levelled machine.
struct WallScene : WallView {
  const Settings& settings;
  const Extrinsic& extrinsic;
  Eigen::Matrix3d R_level_base;
  Eigen::Vector3d forward_level;  // horizontal, unit
  Eigen::Vector3d left_level;     // Z x forward
  Eigen::Vector3d sensor_level_m;
  Eigen::Vector3d sample_level_m[2][2];  // [left, right][s_front, s_back]
  double z_min_level_m = 0.0;            // the wall band
  double z_max_level_m = 0.0;

  WallScene(const WallView& view, const Settings& s, const Extrinsic& of_sensor)
      : WallView(view), settings(s), extrinsic(of_sensor) {}
  bool in_band(double z_level_m) const { return z_level_m >= z_min_level_m && z_level_m <= z_max_level_m; }
};

WallScene wall_scene(const WallView& view, const Settings& settings, const Levelling& levelling, const Axes& axes,
                     const Extrinsic& extrinsic);

// Points this near to a wall's plane, on either side, belong to the wall.
inline double on_wall_m(const Settings& settings) {
  constexpr double kInThresholds = 3.0;  // 15 cm by default; swept: half 8 lost 3 won, twice 3 lost 1 won
  return kInThresholds * settings.wall_ransac_thresh;
}

// Horizontal direction of a wall, towards the machine's front.
Eigen::Vector3d along_of(const Plane& wall, const Eigen::Vector3d& forward_level);

// Signed angle about +Z from the machine's forward direction to a horizontal unit direction.
double yaw_of(const Eigen::Vector3d& along_level, const Eigen::Vector3d& forward_level);

// Tilt from the vertical, positive where the top leans away from the machine.
double lean_of(const Plane& wall);

// Distance of the plane at a sampling point (d = |n . P + d|).
double distance_at(const Plane& wall, const Eigen::Vector3d& sample_level_m);

// Angle between two walls seen from above, whatever their leans.
double angle_in_plan(const Plane& a, const Plane& b);

}  // namespace pose_wall
