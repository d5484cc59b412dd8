// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Where the config puts a point of the sensor, and whether the engine leaves it out.

#pragma once

#include <Eigen/Core>
#include <array>

#include "pose_wall.hpp"

namespace pose_wall::tools {

class SensorMount {
 public:
  explicit SensorMount(const api::Config& config);

  const Eigen::Matrix3d& R_base_lidar() const { return R_base_lidar_; }
  const Eigen::Vector3d& position_base_m() const { return position_base_m_; }
  Eigen::Vector3d to_base(const Eigen::Vector3d& p_lidar_m) const {
    return R_base_lidar_ * p_lidar_m + position_base_m_;
  }

  // Finite, within the range limits and outside the body boxes.
  bool is_used(double range_m, const Eigen::Vector3d& p_base_m) const;

 private:
  Eigen::Matrix3d R_base_lidar_;
  Eigen::Vector3d position_base_m_;
  double range_min_m_, range_max_m_;
  std::array<std::array<double, 6>, 4> body_boxes_m_{};
};

}  // namespace pose_wall::tools
