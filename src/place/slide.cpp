// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "place/slide.hpp"

namespace pose_wall::planar {

Eigen::Vector2d weakest_direction(const Eigen::Matrix3d& information) {
  const Eigen::Matrix3d& H = information;
  const double yaw = H(2, 2) > 0.0 ? H(2, 2) : 1.0;
  return PrincipalAxes(H(0, 0) - H(0, 2) * H(0, 2) / yaw, H(0, 1) - H(0, 2) * H(1, 2) / yaw,
                       H(1, 1) - H(1, 2) * H(1, 2) / yaw)
      .least();
}

Prior held_at(const Fit& fit, const Eigen::Vector2d& direction, double shift_m) {
  constexpr double kHeld = 1e8;  // of information along the direction: 0.1 mm
  const Eigen::Vector2d place = fit.pose.place() + shift_m * direction;
  const Eigen::Vector3d along(direction.x(), direction.y(), 0.0);
  return {{place.x(), place.y(), fit.pose.yaw_rad}, kHeld * along * along.transpose()};
}

Eigen::Matrix3d told_by(const Fit& fit, const Slide& slide) {
  Eigen::Matrix3d told = fit.information / kAlike;
  if (slide.reach_m == 0.0) return told;
  return less_along(told, slide.direction, 1.0 / (slide.reach_m * slide.reach_m));
}

}  // namespace pose_wall::planar
