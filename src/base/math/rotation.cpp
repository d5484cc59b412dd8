// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/math/rotation.hpp"

#include <cmath>

#include "base/math/elementary.hpp"

namespace pose_wall {

Eigen::Matrix3d rotation_zyx(double roll_rad, double pitch_rad, double yaw_rad) {
  const double cr = cosine(roll_rad), sr = sine(roll_rad);
  const double cp = cosine(pitch_rad), sp = sine(pitch_rad);
  const double cy = cosine(yaw_rad), sy = sine(yaw_rad);
  Eigen::Matrix3d r;
  r << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,   //
      -sp, cp * sr, cp * cr;
  return r;
}

RollPitch roll_pitch_of_up(const Eigen::Vector3d& up_base) {
  const double in_yz = std::sqrt(up_base.y() * up_base.y() + up_base.z() * up_base.z());
  return {arc_tangent2(up_base.y(), up_base.z()), arc_tangent2(-up_base.x(), in_yz)};
}

Eigen::Vector3d up_of_roll_pitch(const RollPitch& angles) {
  const double cp = cosine(angles.pitch_rad);
  return {-sine(angles.pitch_rad), cp * sine(angles.roll_rad), cp * cosine(angles.roll_rad)};
}

double tilt_of_up(const Eigen::Vector3d& up_base) {
  return arc_tangent2(std::sqrt(up_base.x() * up_base.x() + up_base.y() * up_base.y()), up_base.z());
}

Eigen::Matrix3d level_rotation(const Eigen::Vector3d& up_base) {
  // The matrix straight from the normal: sin and cos of both angles are ratios of its components.
  const double in_yz = std::sqrt(up_base.y() * up_base.y() + up_base.z() * up_base.z());
  const double norm = std::sqrt(up_base.x() * up_base.x() + in_yz * in_yz);
  const double cr = up_base.z() / in_yz, sr = up_base.y() / in_yz;
  const double cp = in_yz / norm, sp = -up_base.x() / norm;
  Eigen::Matrix3d r;
  r << cp, sp * sr, sp * cr,  //
      0.0, cr, -sr,           //
      -sp, cp * sr, cp * cr;
  return r;
}

RollPitchGradients::RollPitchGradients(const Eigen::Vector3d& n) {
  const double s2 = n.y() * n.y() + n.z() * n.z();
  const double s = std::sqrt(s2);
  roll = Eigen::Vector3d(0.0, n.z(), -n.y()) / s2;
  pitch = Eigen::Vector3d(-s, n.x() * n.y() / s, n.x() * n.z() / s);
}

}  // namespace pose_wall
