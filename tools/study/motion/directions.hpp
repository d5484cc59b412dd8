// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The six directions of a pose in words and units.

#pragma once

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <string>

#include "io/numbers/angles.hpp"
#include "pose_wall_motion.h"

namespace pose_wall::tools {

inline bool is_turn(std::size_t direction) {
  return direction >= POSE_WALL_MOTION_ROLL;
}

// "0.034 m", "0.12°", of m or rad.
inline std::string direction_amount(std::size_t direction, double value) {
  if (!std::isfinite(value)) return "-";
  return is_turn(direction) ? fmt::format("{:.4f}°", value * kDegPerRad) : fmt::format("{:.4f} m", value);
}

}  // namespace pose_wall::tools
