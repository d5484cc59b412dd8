// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Poses of the plane in tools: combined, and as rows of text.

#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

#include "pose_wall_planar_types.h"

namespace pose_wall::tools {

// `second` lies in the frame of `first`.
inline pose_wall_planar_pose combined(const pose_wall_planar_pose& first, const pose_wall_planar_pose& second) {
  const double c = std::cos(first.yaw_rad);
  const double s = std::sin(first.yaw_rad);
  const double yaw_rad = first.yaw_rad + second.yaw_rad;
  return {first.x_m + c * second.x_m - s * second.y_m, first.y_m + s * second.x_m + c * second.y_m,
          std::atan2(std::sin(yaw_rad), std::cos(yaw_rad))};
}

// `second` as it is seen from `first`.
inline pose_wall_planar_pose seen_from(const pose_wall_planar_pose& first, const pose_wall_planar_pose& second) {
  const double c = std::cos(first.yaw_rad);
  const double s = std::sin(first.yaw_rad);
  const double dx_m = second.x_m - first.x_m;
  const double dy_m = second.y_m - first.y_m;
  const double yaw_rad = second.yaw_rad - first.yaw_rad;
  return {c * dx_m + s * dy_m, c * dy_m - s * dx_m, std::atan2(std::sin(yaw_rad), std::cos(yaw_rad))};
}

inline double distance_m(const pose_wall_planar_pose& first, const pose_wall_planar_pose& second) {
  return std::hypot(second.x_m - first.x_m, second.y_m - first.y_m);
}

// `t x y z qx qy qz qw` of the tools for trajectories; s and m, t as it is given.
inline std::string tum_line(std::string_view time, const pose_wall_planar_pose& pose) {
  return fmt::format("{} {:.6f} {:.6f} 0 0 0 {:.9f} {:.9f}\n", time, pose.x_m, pose.y_m, std::sin(0.5 * pose.yaw_rad),
                     std::cos(0.5 * pose.yaw_rad));
}

// Of a position with this covariance in its worst direction; infinity where that is not known.
inline double larger_sigma_m(double xx_m2, double xy_m2, double yy_m2) {
  const double variance_m2 = 0.5 * (xx_m2 + yy_m2) + std::hypot(0.5 * (xx_m2 - yy_m2), xy_m2);
  return variance_m2 >= 0.0 ? std::sqrt(variance_m2) : std::numeric_limits<double>::infinity();
}

}  // namespace pose_wall::tools
