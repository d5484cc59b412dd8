// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/scene.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "base/math/elementary.hpp"

namespace pose_wall {

WallScene wall_scene(const WallView& view, const Settings& settings, const Levelling& levelling, const Axes& axes,
                     const Extrinsic& extrinsic) {
  WallScene scene(view, settings, extrinsic);
  const Eigen::Matrix3d& R = levelling.R_level_base;
  scene.R_level_base = R;
  scene.forward_level = R * axes.forward_base;
  scene.forward_level.z() = 0.0;
  scene.forward_level.normalize();
  scene.left_level = Eigen::Vector3d::UnitZ().cross(scene.forward_level);
  scene.sensor_level_m = R * extrinsic.sensor_base_m;
  const double offsets_m[2] = {settings.lateral_offset_left, settings.lateral_offset_right};
  const double along_m[2] = {settings.s_front, settings.s_back};
  for (int side = 0; side < 2; ++side) {
    for (int end = 0; end < 2; ++end) {
      scene.sample_level_m[side][end] = R * (along_m[end] * axes.forward_base + offsets_m[side] * axes.left_base);
    }
  }
  scene.z_min_level_m = levelling.floor_z_level_m + settings.wall_z_min;
  scene.z_max_level_m = levelling.floor_z_level_m + settings.wall_z_max;
  return scene;
}

Eigen::Vector3d along_of(const Plane& wall, const Eigen::Vector3d& forward_level) {
  const Eigen::Vector3d along = Eigen::Vector3d(-wall.n.y(), wall.n.x(), 0.0).normalized();
  return along.dot(forward_level) >= 0.0 ? along : Eigen::Vector3d(-along);
}

double yaw_of(const Eigen::Vector3d& along_level, const Eigen::Vector3d& forward_level) {
  const double cross = forward_level.x() * along_level.y() - forward_level.y() * along_level.x();
  return arc_tangent2(cross, forward_level.dot(along_level));
}

double lean_of(const Plane& wall) {
  return arc_tangent2(wall.n.z(), std::sqrt(wall.n.x() * wall.n.x() + wall.n.y() * wall.n.y()));
}

double distance_at(const Plane& wall, const Eigen::Vector3d& sample_level_m) {
  return std::fabs(wall.signed_distance(sample_level_m));
}

double angle_in_plan(const Plane& a, const Plane& b) {
  const double cross = a.n.x() * b.n.y() - a.n.y() * b.n.x(), dot = a.n.x() * b.n.x() + a.n.y() * b.n.y();
  return arc_tangent2(std::fabs(cross), std::fabs(dot));
}

}  // namespace pose_wall
