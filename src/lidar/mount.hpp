// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// How a sensor is mounted, and where the machine points: the numbers of a config that tell so. The engine has them in
// its settings.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "lidar/body_boxes.hpp"
#include "pose_wall.h"

namespace pose_wall {

// In base, by the choices of the key forward_axis in their order: +X, -X, +Y, -Y.
inline Eigen::Vector2d forward_of(std::int32_t choice) {
  const Eigen::Vector2d axis = choice < 2 ? Eigen::Vector2d::UnitX() : Eigen::Vector2d::UnitY();
  return (choice & 1) != 0 ? Eigen::Vector2d(-axis) : axis;
}

struct Mount {
  Eigen::Matrix3d R_base_lidar = Eigen::Matrix3d::Identity();
  Eigen::Vector3d sensor_base_m = Eigen::Vector3d::Zero();
  Eigen::Vector2d forward_base = Eigen::Vector2d::UnitX();  // where forward_axis points
  double range_min_m = 0.3, range_max_m = 30.0;
  Box body[BodyBoxes::kOfConfig] = {};  // the parts that move with the machine, in base
};

// Of a checked config.
Mount mount_of(const pose_wall_config& config);
double number_of(const pose_wall_config& config, const char* key);

}  // namespace pose_wall
