// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Points of a cloud as numbers, for tools that look at them themselves.

#pragma once

#include <Eigen/Core>

#include "pose_wall.h"

namespace pose_wall::tools {

// x, y, z of a point as the cloud describes them; the cloud is one that the engine accepts.
Eigen::Vector3d point_position(const pose_wall_cloud& cloud, std::uint32_t row, std::uint32_t column);

}  // namespace pose_wall::tools
