// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Where the machine stands, and how its axes lie, at a moment of the run.
#pragma once

#include <cstdint>

#include "lab/sim/centre_line.hpp"
#include "lab/sim/setup.hpp"

namespace pose_wall::tools::sim {

struct MachinePose {
  double along_m = 0.0;
  double lateral_m = 0.0;
  double base_height_m = 0.0;
  double turned_left_rad = 0.0;
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double time_s = 0.0;
};

// Point_road = R * point_base + origin.
struct Placement {
  Matrix R_road_base;
  Vector origin_road;
};

// Of one moment.
struct Moment {
  MachinePose pose;
  Placement at;
};

// To the left of the centre line, at the start.
double start_lateral_m(const Setup& setup);
// Frames before the scene begins, in which the machine drives in.
std::uint32_t drive_in_frames(const Setup& setup);
// Time of one of the sensor's frames. 0: the scene begins. Before, the machine drives in.
double frame_time_s(const Setup& setup, std::uint32_t sensor_frame);
MachinePose pose_at(const Setup& setup, double time_s);
Placement place(const Setup& setup, const MachinePose& pose);

Matrix rotation_x(double angle_rad);
Matrix rotation_y(double angle_rad);
Matrix rotation_z(double angle_rad);
// Ry(pitch) Rx(roll) takes the floor's normal in base to +Z.
Matrix R_level_base(double roll_rad, double pitch_rad);
Vector forward_axis(const Machine& machine);
Vector left_axis(const Machine& machine);
// Of the sensor as it really is mounted, errors included.
Matrix R_base_lidar(const Mount& mount);
Vector lidar_origin_base(const Mount& mount);

}  // namespace pose_wall::tools::sim
