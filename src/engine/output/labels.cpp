// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/output/labels.hpp"

#include <cmath>

#include "base/math/rotation.hpp"
#include "pose_wall.h"

namespace pose_wall {

void label_points(const PointSet& cloud_base, const Surfaces& found, const Settings& settings,
                  Span<std::uint8_t> labels) {
  const Eigen::Matrix3d R_level_base = level_rotation(found.floor_base.n);
  for (std::uint32_t i = 0; i < cloud_base.count; ++i) {
    const Eigen::Vector3d p_base = cloud_base.at(i);
    const double height_m = found.floor_base.signed_distance(p_base);
    std::uint8_t label = POSE_WALL_LABEL_OTHER;
    if (found.has_floor && std::fabs(height_m) <= settings.ground_ransac_thresh) {
      label = POSE_WALL_LABEL_FLOOR;
    } else if (found.has_floor && height_m >= settings.wall_z_min && height_m <= settings.wall_z_max) {
      const Eigen::Vector3d p_level = R_level_base * p_base;
      for (std::uint8_t side = 0; side < 2; ++side) {
        const double away_m = std::fabs(found.wall_level[side].signed_distance(p_level));
        if (found.has_wall[side] && away_m <= settings.wall_ransac_thresh) label = POSE_WALL_LABEL_LEFT + side;
      }
    }
    labels[i] = label;
  }
}

}  // namespace pose_wall
