// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/frames/point_position.hpp"

#include "io/frames/field_value.hpp"

namespace pose_wall::tools {

Eigen::Vector3d point_position(const pose_wall_cloud& cloud, std::uint32_t row, std::uint32_t column) {
  return {field_value(cloud, row, column, cloud.x), field_value(cloud, row, column, cloud.y),
          field_value(cloud, row, column, cloud.z)};
}

}  // namespace pose_wall::tools
