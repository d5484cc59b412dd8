// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The road's centre line: straight, or a circle in the road frame's xy plane. Road coordinates: s along the line,
// lateral to its left.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace pose_wall::tools::sim {

using Vector = Eigen::Vector3d;
using Matrix = Eigen::Matrix3d;

class CentreLine {
 public:
  // Radius 0: straight; + bends left.
  explicit CentreLine(double radius_m) : radius_(radius_m) {}

  bool curved() const { return radius_ != 0.0; }
  double radius_m() const { return std::abs(radius_); }
  int bend() const { return radius_ > 0.0 ? 1 : -1; }
  double centre_y_m() const { return radius_; }

  double heading_rad(double s_m) const { return curved() ? s_m / radius_ : 0.0; }
  Vector tangent(double s_m) const { return {std::cos(heading_rad(s_m)), std::sin(heading_rad(s_m)), 0.0}; }
  Vector point(double s_m, double lateral_m, double z_m) const {
    if (!curved()) return {s_m, lateral_m, z_m};
    const double r = radius_ - lateral_m;
    return {r * std::sin(heading_rad(s_m)), radius_ - r * std::cos(heading_rad(s_m)), z_m};
  }
  double s_of(const Vector& p) const {
    if (!curved()) return p.x();
    return radius_ * std::atan2(bend() * p.x(), bend() * (radius_ - p.y()));
  }

 private:
  double radius_;
};

}  // namespace pose_wall::tools::sim
