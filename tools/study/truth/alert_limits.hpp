// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How far off a value may be before somebody has to be told.

#pragma once

#include <cstddef>

#include "io/numbers/angles.hpp"
#include "io/numbers/quantities.hpp"
#include "pose_wall.hpp"

namespace pose_wall::tools {

struct AlertLimits {
  double angle_rad = 0.0;
  double distance_m = 0.0;
};

inline AlertLimits alert_limits_of(const pose_wall_config& config) {
  AlertLimits limits;
  double angle_deg = 0.0;  // both keys are there: the calls cannot fail
  static_cast<void>(pose_wall_config_get_number(&config, "alert_limit_angle_deg", &angle_deg));
  static_cast<void>(pose_wall_config_get_number(&config, "alert_limit_distance", &limits.distance_m));
  limits.angle_rad = angle_deg * kRadPerDeg;
  return limits;
}

inline AlertLimits alert_limits_of(const api::Config& config) {
  return alert_limits_of(*config.get());
}

// In the quantity's own unit.
inline double limit_of(std::size_t quantity, const AlertLimits& limits) {
  return is_angle(quantity) ? limits.angle_rad : limits.distance_m;
}

}  // namespace pose_wall::tools
