// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Points in the road: along it, across it, above the floor.

#pragma once

#include <Eigen/Core>
#include <cmath>

#include "io/config_file/sensor_mount.hpp"
#include "study/doctor/floor_seen.hpp"

namespace pose_wall::tools::doctor {

class RoadFrame {
 public:
  // `config` levels the floor; `azimuth_base_rad`: the road's direction in base, about +Z from +X.
  RoadFrame(const api::Config& config, const FloorSeen& floor, double azimuth_base_rad)
      : mount_(config),
        up_base_(mount_.R_base_lidar() * floor.up_lidar),
        floor_d_m_(floor.height_m - up_base_.dot(mount_.position_base_m())),
        range_used_m_(config.number("range_min")),
        along_base_(std::cos(azimuth_base_rad), std::sin(azimuth_base_rad), 0.0),
        left_base_(-std::sin(azimuth_base_rad), std::cos(azimuth_base_rad), 0.0) {}

  Eigen::Vector3d to_base(const Eigen::Vector3d& p_lidar_m) const { return mount_.to_base(p_lidar_m); }
  // Along the road and to its left from the base origin, and the height above the floor.
  Eigen::Vector3d of_base(const Eigen::Vector3d& p_base_m) const {
    return {along_base_.dot(p_base_m), left_base_.dot(p_base_m), up_base_.dot(p_base_m) + floor_d_m_};
  }
  Eigen::Vector3d of_lidar(const Eigen::Vector3d& p_lidar_m) const { return of_base(to_base(p_lidar_m)); }
  // Left out by a box of the config.
  bool is_in_told_box(const Eigen::Vector3d& p_base_m) const { return !mount_.is_used(range_used_m_, p_base_m); }
  const SensorMount& mount() const { return mount_; }

 private:
  SensorMount mount_;
  Eigen::Vector3d up_base_;
  double floor_d_m_;
  double range_used_m_;
  Eigen::Vector3d along_base_, left_base_;
};

}  // namespace pose_wall::tools::doctor
