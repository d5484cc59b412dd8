// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Settings of the stop: defaults, limits, and the config's part.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "lidar/box.hpp"
#include "pose_wall_planar_stop.h"

namespace pose_wall::planar {

using StopSettings = pose_wall_planar_stop_settings;

StopSettings default_stop_settings();
void set_rectangle(StopSettings* settings, double x_min_m, double x_max_m, double y_min_m, double y_max_m);

// POSE_WALL_OK, POSE_WALL_E_STRUCT_SIZE or POSE_WALL_E_VALUE_RANGE with its fault (may be NULL).
std::int32_t check_stop_settings(const StopSettings& settings, pose_wall_planar_fault* fault);

// How clouds become points of base.
struct Mount {
  Eigen::Matrix3d R_base_lidar = Eigen::Matrix3d::Identity();
  Eigen::Vector3d sensor_base_m = Eigen::Vector3d::Zero();
  Eigen::Vector2d forward_base = Eigen::Vector2d::UnitX();
  double range_min_m = 0.0, range_max_m = 0.0;
  Box body[4] = {};
};

Mount mount_of(const pose_wall_config& config);

// From the stamp to the first effect of the brakes.
inline double reaction_s(const StopSettings& s) {
  return s.scan_s + s.stale_s + s.delay_s + s.latency_s;
}

}  // namespace pose_wall::planar
