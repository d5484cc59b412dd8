// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/config_file/sensor_mount.hpp"

#include <Eigen/Geometry>
#include <string>

namespace pose_wall::tools {

SensorMount::SensorMount(const api::Config& config)
    : R_base_lidar_((Eigen::AngleAxisd(config.number("extrinsic_yaw"), Eigen::Vector3d::UnitZ()) *
                     Eigen::AngleAxisd(config.number("extrinsic_pitch"), Eigen::Vector3d::UnitY()) *
                     Eigen::AngleAxisd(config.number("extrinsic_roll"), Eigen::Vector3d::UnitX()))
                        .toRotationMatrix()),
      position_base_m_(config.number("extrinsic_x"), config.number("extrinsic_y"), config.number("extrinsic_z")),
      range_min_m_(config.number("range_min")),
      range_max_m_(config.number("range_max")) {
  for (std::size_t i = 0; i < body_boxes_m_.size(); ++i) {
    pose_wall_config_get_box(config.get(), ("body_box_" + std::to_string(i + 1)).c_str(), body_boxes_m_[i].data());
  }
}

bool SensorMount::is_used(double range_m, const Eigen::Vector3d& p_base_m) const {
  if (!(range_m >= range_min_m_ && range_m <= range_max_m_)) return false;
  for (const auto& box : body_boxes_m_) {
    const bool has_volume = box[1] > box[0] && box[3] > box[2] && box[5] > box[4];
    const bool inside = p_base_m.x() >= box[0] && p_base_m.x() <= box[1] && p_base_m.y() >= box[2] &&
                        p_base_m.y() <= box[3] && p_base_m.z() >= box[4] && p_base_m.z() <= box[5];
    if (has_volume && inside) return false;
  }
  return true;
}

}  // namespace pose_wall::tools
