// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/track_path.hpp"

#include <cmath>

#include "planar/route/footprint.hpp"

namespace pose_wall::planar::route {
namespace {

constexpr std::uint32_t kStretchesMost = 64;  // searched in one step
constexpr double kBeyond_m = 1.0;             // no machine comes further in one step

}  // namespace

Leg TrackPath::leg_from(std::uint32_t first) const {
  Leg leg{first, first, 0};
  if (first + 1 >= poses_.size()) return leg;
  leg.drive = poses_[first + 1].drive;
  leg.last = first + 1;
  while (leg.last + 1 < poses_.size() && poses_[leg.last + 1].drive == leg.drive) {
    const bool is_stop = leg.drive != 0 && (poses_[leg.last].flags & POSE_WALL_PLANAR_PATH_STOP) != 0;
    if (is_stop) break;
    ++leg.last;
  }
  return leg;
}

// On the stretch from pose k to the next, an arc: two steps along the tangent find the foot to micrometres.
OnPath TrackPath::on_stretch(std::uint32_t k, const Pose2& pose, double* distance_squared) const {
  const pose_wall_planar_path_pose &a = poses_[k], &b = poses_[k + 1];
  const double length_m = b.along_m - a.along_m, sign = b.drive < 0 ? -1.0 : 1.0;
  const Pose2 from = pose_of(a.pose);
  Pose2 foot = from;
  double s = 0.0;
  Eigen::Vector2d off = Eigen::Vector2d::Zero();
  for (std::uint32_t step = 0; step < 3; ++step) {
    off = Turn2(foot.yaw_rad).back(pose.place() - foot.place());
    s += sign * off.x();
    if (!(s > 0.0)) s = 0.0;
    if (!(s < length_m)) s = length_m;
    foot = along_arc(from, sign * s, sign * s * b.curvature_1_m);
  }
  off = Turn2(foot.yaw_rad).back(pose.place() - foot.place());
  *distance_squared = off.squaredNorm();
  return {k, a.along_m + s, foot.yaw_rad, b.curvature_1_m, off.y(), wrapped(pose.yaw_rad - foot.yaw_rad)};
}

OnPath TrackPath::nearest(const Leg& leg, std::uint32_t from, const Pose2& pose) const {
  std::uint32_t k = from > leg.first ? from : leg.first;
  if (k >= leg.last) k = leg.last - 1;
  const double begin_m = poses_[k].along_m;
  double best_squared = 0.0;
  OnPath best = on_stretch(k, pose, &best_squared);
  for (std::uint32_t count = 0; count < kStretchesMost; ++count) {
    if (++k >= leg.last || poses_[k].along_m > begin_m + kBeyond_m) break;
    double squared = 0.0;
    const OnPath at = on_stretch(k, pose, &squared);
    if (squared < best_squared) {
      best_squared = squared;
      best = at;
    }
  }
  // Beyond the end of the leg the way goes on straight.
  if (best.along_m >= end_m(leg) && leg.drive != 0) {
    const Eigen::Vector2d off = Turn2(best.yaw_rad).back(pose.place() - pose_of(poses_[leg.last].pose).place());
    best.along_m += leg.drive * off.x() > 0.0 ? leg.drive * off.x() : 0.0;
  }
  return best;
}

double TrackPath::left_to_turn(const Leg& leg, double yaw_rad) const {
  const bool is_left = (poses_[leg.last].flags & POSE_WALL_PLANAR_PATH_TURN_LEFT) != 0;
  double left_rad = wrapped(poses_[leg.last].pose.yaw_rad - yaw_rad);
  // A long turn must not be taken for the short one the other way round; a small excess is no whole turn.
  constexpr double kExcess_rad = 1.0;
  if (is_left && left_rad < -kExcess_rad) left_rad += 2.0 * kPi;
  if (!is_left && left_rad > kExcess_rad) left_rad -= 2.0 * kPi;
  return left_rad;
}

double TrackPath::sharpest_1_m(const Leg& leg, const OnPath& at, double ahead_m) const {
  double sharpest = std::abs(at.curvature_1_m);
  for (std::uint32_t k = at.index + 1, count = 0; k < leg.last && count < kStretchesMost; ++k, ++count) {
    if (poses_[k].along_m > at.along_m + ahead_m) break;
    const double curvature = std::abs(poses_[k + 1].curvature_1_m);
    if (curvature > sharpest) sharpest = curvature;
  }
  return sharpest;
}

}  // namespace pose_wall::planar::route
