// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/output/standing_surfaces.hpp"

#include <Eigen/Geometry>

#include "base/math/elementary.hpp"
#include "base/math/rotation.hpp"
#include "engine/output/measurements.hpp"
#include "pose_wall.h"

namespace pose_wall {
namespace {

double turn_about(const Eigen::Vector3d& up, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from - up * up.dot(from), b = to - up * up.dot(to);
  return arc_tangent2(up.dot(a.cross(b)), a.dot(b));
}

}  // namespace

Eigen::Vector3d sample_base(std::uint32_t quantity, const Settings& s, const Axes& axes) {
  const bool front = quantity == POSE_WALL_D_LF || quantity == POSE_WALL_D_RF;
  const double aside_m = side_of(quantity) == 0 ? s.lateral_offset_left : s.lateral_offset_right;
  return (front ? s.s_front : s.s_back) * axes.forward_base + aside_m * axes.left_base;
}

double change_between(std::uint32_t quantity, const Place& from, const Place& to, const Eigen::Vector3d& up,
                      const Eigen::Vector3d& wall_normal, const Settings& s, const Axes& axes) {
  if (quantity == POSE_WALL_YAW) {  // turned left: smaller
    return -turn_about(up, from.R * axes.forward_base, to.R * axes.forward_base);
  }
  if (quantity < POSE_WALL_YAW) {
    const RollPitch before = roll_pitch_of_up(from.R.transpose() * up);
    const RollPitch after = roll_pitch_of_up(to.R.transpose() * up);
    return quantity == POSE_WALL_ROLL ? after.roll_rad - before.roll_rad : after.pitch_rad - before.pitch_rad;
  }
  const Eigen::Vector3d moved_m = to.position_m - from.position_m + (to.R - from.R) * sample_base(quantity, s, axes);
  return wall_normal.dot(moved_m);
}

}  // namespace pose_wall
