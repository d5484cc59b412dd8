// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lidar/mount.hpp"

#include "base/math/rotation.hpp"

namespace pose_wall {
namespace {

std::int32_t forward_choice(const pose_wall_config& config) {
  char axis[POSE_WALL_TEXT_MAX] = {};
  (void)pose_wall_config_get_text(&config, "forward_axis", axis, sizeof(axis));
  return (axis[1] == 'Y' ? 2 : 0) + (axis[0] == '-' ? 1 : 0);
}

}  // namespace

double number_of(const pose_wall_config& config, const char* key) {
  double value = 0.0;
  (void)pose_wall_config_get_number(&config, key, &value);
  return value;
}

Mount mount_of(const pose_wall_config& config) {
  Mount mount;
  mount.R_base_lidar = rotation_zyx(number_of(config, "extrinsic_roll"), number_of(config, "extrinsic_pitch"),
                                    number_of(config, "extrinsic_yaw"));
  mount.sensor_base_m = {number_of(config, "extrinsic_x"), number_of(config, "extrinsic_y"),
                         number_of(config, "extrinsic_z")};
  mount.forward_base = forward_of(forward_choice(config));
  mount.range_min_m = number_of(config, "range_min");
  mount.range_max_m = number_of(config, "range_max");
  static constexpr const char* kBoxes[BodyBoxes::kOfConfig] = {"body_box_1", "body_box_2", "body_box_3", "body_box_4"};
  for (std::uint32_t k = 0; k < BodyBoxes::kOfConfig; ++k) {
    double edges_m[6] = {};
    (void)pose_wall_config_get_box(&config, kBoxes[k], edges_m);
    mount.body[k] = box_of(edges_m);
  }
  return mount;
}

}  // namespace pose_wall
