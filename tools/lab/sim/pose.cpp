// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/pose.hpp"

#include <algorithm>
#include <cmath>

#include "lab/sim/section.hpp"

namespace pose_wall::tools::sim {

Matrix rotation_x(double a) {
  return Eigen::AngleAxisd(a, Vector::UnitX()).toRotationMatrix();
}
Matrix rotation_y(double a) {
  return Eigen::AngleAxisd(a, Vector::UnitY()).toRotationMatrix();
}
Matrix rotation_z(double a) {
  return Eigen::AngleAxisd(a, Vector::UnitZ()).toRotationMatrix();
}

Matrix R_level_base(double roll_rad, double pitch_rad) {
  return rotation_y(pitch_rad) * rotation_x(roll_rad);
}

Vector forward_axis(const Machine& machine) {
  switch (static_cast<int>(machine.forward_axis)) {
    case 0:
      return Vector::UnitX();
    case 1:
      return -Vector::UnitX();
    case 2:
      return Vector::UnitY();
    default:
      return -Vector::UnitY();
  }
}

Vector left_axis(const Machine& machine) {
  return Vector::UnitZ().cross(forward_axis(machine));
}

Matrix R_base_lidar(const Mount& m) {
  return rotation_z((m.mount_yaw_deg + m.mount_error_yaw_deg) * kRadPerDeg) *
         rotation_y((m.mount_pitch_deg + m.mount_error_pitch_deg) * kRadPerDeg) *
         rotation_x((m.mount_roll_deg + m.mount_error_roll_deg) * kRadPerDeg);
}

Vector lidar_origin_base(const Mount& m) {
  return {m.mount_x_m + m.mount_error_x_m, m.mount_y_m + m.mount_error_y_m, m.mount_z_m + m.mount_error_z_m};
}

double start_lateral_m(const Setup& setup) {
  const Machine& m = setup.machine;
  if (m.near_side == 0.0) return m.lateral_m;
  const double from_centre = 0.5 * setup.road.width_m - m.near_distance_m;
  return m.near_side == static_cast<double>(kSideLeft) ? from_centre : -from_centre;
}

std::uint32_t drive_in_frames(const Setup& setup) {
  const Machine& m = setup.machine;
  return static_cast<std::uint32_t>(std::ceil(m.drive_in_m / m.drive_in_mps * setup.sequence.rate_hz));
}

double frame_time_s(const Setup& setup, std::uint32_t sensor_frame) {
  return (static_cast<double>(sensor_frame) - drive_in_frames(setup)) / setup.sequence.rate_hz;
}

MachinePose pose_at(const Setup& setup, double time_s) {
  const Machine& m = setup.machine;
  const double phase = 2.0 * M_PI * time_s / m.sway_period_s;
  const double step_deg = time_s >= m.turn_step_at_s ? m.turn_step_deg : 0.0;
  const double begun_s = std::max(time_s, 0.0);  // it drives in as it stands at the start
  MachinePose pose;
  pose.time_s = time_s;
  const bool changed = m.speed_change_at_s > 0.0 && time_s > m.speed_change_at_s;
  pose.along_m = (time_s < 0.0 ? m.drive_in_mps : m.speed_mps) * time_s;
  if (changed) pose.along_m += (m.speed_after_mps - m.speed_mps) * (time_s - m.speed_change_at_s);
  pose.lateral_m = start_lateral_m(setup) + m.drift_mps * begun_s;
  pose.base_height_m = m.base_height_m;
  pose.turned_left_rad = (m.turned_left_deg + m.turn_rate_dps * begun_s + step_deg) * kRadPerDeg;
  pose.roll_rad = (m.roll_deg + m.sway_roll_deg * std::sin(phase)) * kRadPerDeg;
  pose.pitch_rad = (m.pitch_deg + m.sway_pitch_deg * std::cos(phase)) * kRadPerDeg;
  return pose;
}

// The turn about the floor's normal is chosen so that the levelled forward axis stands turned_left from the road.
Placement place(const Setup& setup, const MachinePose& pose) {
  const CentreLine line(setup.road.curve_radius_m);
  const Vector up = floor_plane(setup.road).n;
  Matrix R_road_floor;
  R_road_floor.col(2) = up;
  const Vector along = line.tangent(pose.along_m);
  R_road_floor.col(0) = (along - along.dot(up) * up).normalized();
  R_road_floor.col(1) = up.cross(R_road_floor.col(0));

  const Matrix level = R_level_base(pose.roll_rad, pose.pitch_rad);
  const Vector forward = level * forward_axis(setup.machine);
  const double turn = pose.turned_left_rad - std::atan2(forward.y(), forward.x());

  Vector foot = line.point(pose.along_m, pose.lateral_m, 0.0);
  foot.z() = floor_height_m(setup.road, foot);
  return {R_road_floor * rotation_z(turn) * level, foot + pose.base_height_m * up};
}

}  // namespace pose_wall::tools::sim
