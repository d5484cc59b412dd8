// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The machine in its road: axes, mounting of the sensor, the pose of each frame, and the true seven values.
// base is the frame of all results; machine has the same origin and x ahead, y left; sensor is the cloud's frame.

#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "judge/road.hpp"
#include "pose_wall.h"

namespace pose_wall::judge {

// p_world = turn * p_base + position_m
struct Pose {
  Vector3d to_world(const Vector3d& p_base_m) const { return turn * p_base_m + position_m; }

  Matrix3d turn = Matrix3d::Identity();
  Vector3d position_m = Vector3d::Zero();
};

struct Mounting {
  Matrix3d turn() const;  // Rz(yaw) Ry(pitch) Rx(roll): sensor to base

  Vector3d position_base_m = Vector3d::Zero();
  double roll_rad = 0.0, pitch_rad = 0.0, yaw_rad = 0.0;
};

struct Machine {
  std::string forward_axis = "+X";
  Matrix3d base_from_machine = Matrix3d::Identity();
  Mounting mounting;
  double s_front_m = 2.0, s_back_m = -2.0, offset_left_m = 0.0, offset_right_m = 0.0;
  double base_height_m = 1.5;    // above the floor
  std::vector<Solid> body_base;  // what the sensor sees of it, and its boxes in the config's words
  std::vector<std::string> boxes;
};

// Specification: the machine is about 4.5 m long and 1.2 m wide.
constexpr double kHalfLength_m = 2.25, kHalfWidth_m = 0.6;
constexpr double kClear_m = 0.15;  // to walls and to what stands beside them

enum class Hung { kUpright, kUpsideDown, kAnyhow };

// Sizes, axes and mounting. A machine with a body hides a part of the floor.
Machine draw_machine(const Road& road, Hung hung, Draw* draw);

// Where it stands at first, clear of the walls, and after one more tenth of a second of creeping.
struct Stance {
  Pose pose(const Road& road, const Machine& machine) const;

  double x_m = 0.0, y_m = 0.0, turned_left_rad = 0.0, nose_down_rad = 0.0, right_down_rad = 0.0;
};
Stance draw_stance(const Road& road, bool quiet, Draw* draw);
void creep(Stance* stance, Draw* draw);

// A true value: yaw is an interval where the walls run apart, for their weights are the engine's to choose.
struct Truth {
  double error(int quantity, double value) const;  // signed distance to the interval

  std::array<double, POSE_WALL_QUANTITIES> low{}, high{};
};
Truth truth_of(const Road& road, const Machine& machine, const Pose& pose);

using Setting = std::pair<std::string, std::string>;
std::vector<Setting> settings_of(const Machine& machine);

}  // namespace pose_wall::judge
