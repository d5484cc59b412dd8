// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Poses in the plane. A point p of base lies at turn p + (x, y) in the frame that the pose belongs to.

#pragma once

#include <Eigen/Core>
#include <cmath>

#include "base/math/elementary.hpp"
#include "pose_wall_planar_types.h"

namespace pose_wall::planar {

// The same angle in (-pi, pi], of one up to POSE_WALL_PLANAR_TURNED_MOST_RAD: whole turns come off by a division.
inline double wrapped(double angle_rad) {
  const double turns = std::floor((angle_rad + kPi) / (2.0 * kPi));
  const double inside = angle_rad - turns * (2.0 * kPi);
  return inside > -kPi ? inside : inside + 2.0 * kPi;
}

struct Pose2 {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0;

  Eigen::Vector2d place() const { return {x_m, y_m}; }
};

inline bool is_within(double value, double least, double most) {
  return value >= least && value <= most;
}

// A caller's place or pose is one: NaN fails.
inline bool is_place(double x_m, double y_m) {
  constexpr double kFarthest_m = POSE_WALL_PLANAR_FARTHEST_M;  // by the interface
  return is_within(x_m, -kFarthest_m, kFarthest_m) && is_within(y_m, -kFarthest_m, kFarthest_m);
}
inline bool is_pose(const pose_wall_planar_pose& pose) {
  constexpr double kMost_rad = POSE_WALL_PLANAR_TURNED_MOST_RAD;  // by the interface
  return is_place(pose.x_m, pose.y_m) && is_within(pose.yaw_rad, -kMost_rad, kMost_rad);
}

inline Pose2 pose_of(const pose_wall_planar_pose& pose) {
  return {pose.x_m, pose.y_m, pose.yaw_rad};
}

inline pose_wall_planar_pose pose_for_caller(const Pose2& pose) {
  return {pose.x_m, pose.y_m, wrapped(pose.yaw_rad)};
}

// A turn with its sine and cosine at hand: many points by one pose.
struct Turn2 {
  double c = 1.0, s = 0.0;

  Turn2() = default;
  explicit Turn2(double yaw_rad) : c(cosine(yaw_rad)), s(sine(yaw_rad)) {}
  Eigen::Vector2d operator*(const Eigen::Vector2d& p) const { return {c * p.x() - s * p.y(), s * p.x() + c * p.y()}; }
  Eigen::Vector2d back(const Eigen::Vector2d& p) const { return {c * p.x() + s * p.y(), c * p.y() - s * p.x()}; }
};

// Where base stands, if it stands at `b` in the frame of `a`.
inline Pose2 compose(const Pose2& a, const Pose2& b) {
  const Eigen::Vector2d place = Turn2(a.yaw_rad) * b.place() + a.place();
  return {place.x(), place.y(), wrapped(a.yaw_rad + b.yaw_rad)};
}

// `b` in the frame of `a`: compose(a, between(a, b)) is b.
inline Pose2 between(const Pose2& a, const Pose2& b) {
  const Eigen::Vector2d place = Turn2(a.yaw_rad).back(b.place() - a.place());
  return {place.x(), place.y(), wrapped(b.yaw_rad - a.yaw_rad)};
}

// Information about x, y and yaw in the axes of map, in those of a pose.
inline Eigen::Matrix3d in_frame_of(const Pose2& pose, const Eigen::Matrix3d& information) {
  const Turn2 turn(pose.yaw_rad);
  Eigen::Matrix3d R;
  R << turn.c, turn.s, 0.0, -turn.s, turn.c, 0.0, 0.0, 0.0, 1.0;
  return R * information * R.transpose();
}

inline Pose2 inverse(const Pose2& a) {
  return between(a, Pose2());
}

}  // namespace pose_wall::planar
