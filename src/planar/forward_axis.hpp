// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <Eigen/Core>

#include "pose_wall.h"

namespace pose_wall::planar {

// Where forward_axis of a checked config points in base.
inline Eigen::Vector2d forward_of(const pose_wall_config& config) {
  char axis[POSE_WALL_TEXT_MAX] = {};
  (void)pose_wall_config_get_text(&config, "forward_axis", axis, sizeof(axis));
  const Eigen::Vector2d positive = axis[1] == 'Y' ? Eigen::Vector2d::UnitY() : Eigen::Vector2d::UnitX();
  return axis[0] == '-' ? Eigen::Vector2d(-positive) : positive;
}

}  // namespace pose_wall::planar
