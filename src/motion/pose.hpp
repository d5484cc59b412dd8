// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Poses and turns: exponential and logarithm of rotations by the engine's own elementary functions.

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "base/math/elementary.hpp"

namespace pose_wall::motion {

constexpr float kTurn_rad = static_cast<float>(2.0 * kPi);  // once around a circle

// A point p of base lies at R p + t in the map.
struct Pose {
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  Eigen::Vector3d t = Eigen::Vector3d::Zero();
};

// How the machine moves, in base.
struct Twist {
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_rad_s = Eigen::Vector3d::Zero();
};

// Rodrigues' formula.
inline Eigen::Matrix3d turn_by(const Eigen::Vector3d& turn_rad) {
  const double angle = std::sqrt(turn_rad.squaredNorm());
  if (!(angle > 1e-12)) return Eigen::Matrix3d::Identity();
  const Eigen::Vector3d a = turn_rad / angle;
  Eigen::Matrix3d cross;
  cross << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return Eigen::Matrix3d::Identity() + sine(angle) * cross + (1.0 - cosine(angle)) * (cross * cross);
}

inline Eigen::Vector3d turn_of(const Eigen::Matrix3d& R) {
  const Eigen::Vector3d v(0.5 * (R(2, 1) - R(1, 2)), 0.5 * (R(0, 2) - R(2, 0)), 0.5 * (R(1, 0) - R(0, 1)));
  const double s = std::sqrt(v.squaredNorm());
  return s > 1e-12 ? Eigen::Vector3d(v * (arc_tangent2(s, 0.5 * (R.trace() - 1.0)) / s)) : v;
}

// Rounding never adds up: the nearest frame by Gram and Schmidt, x first.
inline Eigen::Matrix3d orthonormal(const Eigen::Matrix3d& R) {
  Eigen::Matrix3d out;
  out.col(0) = R.col(0) / std::sqrt(R.col(0).squaredNorm());
  const Eigen::Vector3d y = R.col(1) - out.col(0) * out.col(0).dot(R.col(1));
  out.col(1) = y / std::sqrt(y.squaredNorm());
  out.col(2) = out.col(0).cross(out.col(1));
  return out;
}

}  // namespace pose_wall::motion
