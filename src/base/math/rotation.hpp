// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The one definition of the order and the signs of roll, pitch and yaw.

#pragma once

#include <Eigen/Core>

namespace pose_wall {

// R = Rz(yaw) Ry(pitch) Rx(roll).
Eigen::Matrix3d rotation_zyx(double roll_rad, double pitch_rad, double yaw_rad);

struct RollPitch {
  double roll_rad;
  double pitch_rad;
};

// roll = atan2(n_y, n_z), pitch = atan2(-n_x, sqrt(n_y^2 + n_z^2)) of the floor's upward normal.
RollPitch roll_pitch_of_up(const Eigen::Vector3d& up_base);

// The floor's upward normal by them.
Eigen::Vector3d up_of_roll_pitch(const RollPitch& angles);

// Angle between up and +Z, whichever way it leans.
double tilt_of_up(const Eigen::Vector3d& up_base);

// Ry(pitch) Rx(roll) of the above: takes up to +Z and has no turn about Z of its own.
Eigen::Matrix3d level_rotation(const Eigen::Vector3d& up_base);

// Gradients of roll and pitch by the floor's normal; see roll_pitch_of_up().
struct RollPitchGradients {
  Eigen::Vector3d roll, pitch;

  explicit RollPitchGradients(const Eigen::Vector3d& n);
};

}  // namespace pose_wall
