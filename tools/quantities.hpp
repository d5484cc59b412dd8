// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the seven quantities are measured in.

#pragma once

#include <cstddef>

#include "pose_wall.h"

namespace pose_wall::tools {

// In rad; the others are distances, in m.
inline bool is_angle(std::size_t quantity) {
  return quantity <= POSE_WALL_YAW;
}

}  // namespace pose_wall::tools
