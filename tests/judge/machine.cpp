// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/machine.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pose_wall::judge {
namespace {

using Eigen::AngleAxisd;

// Slower than the config lets a machine be in a frame of 0.1 s: hold_rate_angle 0.05 rad/s, hold_rate_distance 0.2 m/s.
constexpr double kCreep_m = 0.01, kCreep_rad = 0.002;

Matrix3d about(const Vector3d& axis, double angle_rad) {
  return AngleAxisd(angle_rad, axis).toRotationMatrix();
}

struct Axis {
  const char* name;
  double x, y;
};
constexpr std::array<Axis, 4> kAxes = {{{"+X", 1, 0}, {"-X", -1, 0}, {"+Y", 0, 1}, {"-Y", 0, -1}}};

void choose_axis(Machine* machine, int k) {
  const Axis& axis = kAxes.at(static_cast<std::size_t>(k));
  const Vector3d forward(axis.x, axis.y, 0.0), up = Vector3d::UnitZ();
  machine->forward_axis = axis.name;
  machine->base_from_machine << forward, up.cross(forward), up;
}

void add_part(Machine* machine, const Vector3d& centre_m, const Vector3d& half_m) {
  constexpr double kMargin_m = 0.06;
  const Matrix3d& turn = machine->base_from_machine;
  Solid part = box(turn * centre_m, half_m, 0.0);
  part.axes = turn;
  machine->body_base.push_back(part);
  const Vector3d half_base_m = (turn * half_m).cwiseAbs() + Vector3d::Constant(kMargin_m);
  const Vector3d low_m = part.centre_m - half_base_m, high_m = part.centre_m + half_base_m;
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%.3f %.3f %.3f %.3f %.3f %.3f", low_m.x(), high_m.x(), low_m.y(), high_m.y(),
                low_m.z(), high_m.z());
  machine->boxes.emplace_back(text.data());
}

// Hull and boom, below the sensor by as much as a mast holds it up. The boom hangs ahead and a little aside.
void add_body(Machine* machine, double sensor_z_m, Draw* draw) {
  const double top_m = sensor_z_m - draw->uniform(0.35, 0.9);
  const double bottom_m = -machine->base_height_m + 0.25;
  if (top_m < bottom_m + 0.2) return;
  add_part(machine, {0.0, 0.0, 0.5 * (top_m + bottom_m)}, {kHalfLength_m, kHalfWidth_m, 0.5 * (top_m - bottom_m)});
  const double boom_half_m = draw->uniform(0.4, 0.9), boom_y_m = draw->uniform(-0.4, 0.4);
  add_part(machine, {kHalfLength_m + boom_half_m, boom_y_m, top_m - 0.2}, {boom_half_m, 0.25, 0.2});
}

void mount(Machine* machine, Hung hung, Draw* draw) {
  Mounting* mounting = &machine->mounting;
  mounting->yaw_rad = draw->uniform(-kPi, kPi);
  mounting->pitch_rad = kRadPerDeg * draw->uniform(-4.0, 4.0);
  mounting->roll_rad = kRadPerDeg * draw->uniform(-4.0, 4.0);
  if (hung == Hung::kAnyhow) {
    mounting->pitch_rad += kRadPerDeg * draw->uniform(-15.0, 15.0);
    mounting->roll_rad += kRadPerDeg * draw->uniform(-15.0, 15.0);
  }
  const bool over = hung == Hung::kUpsideDown || (hung == Hung::kAnyhow && draw->chance(0.4));
  if (over) mounting->roll_rad += kPi;
  const Vector3d position_m(draw->uniform(-0.4, 0.4), draw->uniform(-0.3, 0.3), draw->uniform(-0.3, 0.3));
  mounting->position_base_m = machine->base_from_machine * position_m;
}

// Level: the floor's normal is up. Written from the definitions of the specification's chapters 5 to 7.
struct Level {
  explicit Level(const Vector3d& n_base)
      : roll_rad(std::atan2(n_base.y(), n_base.z())),
        pitch_rad(std::atan2(-n_base.x(), std::hypot(n_base.y(), n_base.z()))),
        from_base(about(Vector3d::UnitY(), pitch_rad) * about(Vector3d::UnitX(), roll_rad)) {}

  double roll_rad, pitch_rad;
  Matrix3d from_base;
};

double yaw_by_wall_rad(const Vector3d& forward_level, const Vector3d& normal_level) {
  Vector3d along = Vector3d::UnitZ().cross(normal_level).normalized();
  if (along.dot(forward_level) < 0.0) along = -along;
  // From the projection of the forward axis to the road, about +Z.
  const double cross = forward_level.x() * along.y() - forward_level.y() * along.x();
  return std::atan2(cross, forward_level.x() * along.x() + forward_level.y() * along.y());
}

}  // namespace

Matrix3d Mounting::turn() const {
  return about(Vector3d::UnitZ(), yaw_rad) * about(Vector3d::UnitY(), pitch_rad) * about(Vector3d::UnitX(), roll_rad);
}

Machine draw_machine(const Road& road, Hung hung, Draw* draw) {
  Machine machine;
  choose_axis(&machine, draw->whole(0, 3));
  mount(&machine, hung, draw);
  const double sensor_z_m = machine.mounting.position_base_m.z();
  machine.base_height_m = std::min(draw->uniform(1.1, 2.2), road.height_m - 0.7) - sensor_z_m;
  if (draw->chance(0.3)) {
    machine.s_front_m = draw->uniform(1.0, 3.0);
    machine.s_back_m = draw->uniform(-3.0, -1.0);
    machine.offset_left_m = draw->uniform(0.0, kHalfWidth_m);
    machine.offset_right_m = draw->uniform(-kHalfWidth_m, 0.0);
  }
  if (road.has(kBody)) add_body(&machine, sensor_z_m, draw);
  return machine;
}

Stance draw_stance(const Road& road, bool quiet, Draw* draw) {
  Stance stance;
  const double room_m = 0.5 * (road.free_left_m + road.free_right_m) - kHalfWidth_m - kClear_m;
  const double middle_m = 0.5 * (road.free_left_m - road.free_right_m);
  stance.y_m = middle_m + draw->uniform(-0.7, 0.7) * std::max(0.0, room_m);
  const double beside_m = room_m - std::abs(stance.y_m - middle_m);
  const double steepest = draw->chance(0.3) ? 0.4 : 0.1;  // sine: most machines stand along the road
  const double largest_rad = std::asin(std::clamp(beside_m / kHalfLength_m, 0.0, steepest));
  stance.turned_left_rad = draw->uniform(-1.0, 1.0) * largest_rad;
  const double largest_deg = quiet ? 4.0 : draw->chance(0.15) ? 10.0 : 4.0;
  stance.nose_down_rad = kRadPerDeg * draw->uniform(-largest_deg, largest_deg);
  stance.right_down_rad = kRadPerDeg * draw->uniform(-largest_deg, largest_deg);
  return stance;
}

void creep(Stance* stance, Draw* draw) {
  stance->x_m += draw->uniform(-kCreep_m, kCreep_m);
  stance->y_m += draw->uniform(-0.3 * kCreep_m, 0.3 * kCreep_m);
  stance->turned_left_rad += draw->uniform(-kCreep_rad, kCreep_rad);
  stance->nose_down_rad += draw->uniform(-kCreep_rad, kCreep_rad);
  stance->right_down_rad += draw->uniform(-kCreep_rad, kCreep_rad);
}

Pose Stance::pose(const Road& road, const Machine& machine) const {
  const Matrix3d floor = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), road.floor.normal).toRotationMatrix();
  // x ahead, y left, z up: a positive turn about y lowers the nose, one about x lowers the right side.
  const Matrix3d attitude = about(Vector3d::UnitZ(), turned_left_rad) * about(Vector3d::UnitY(), nose_down_rad) *
                            about(Vector3d::UnitX(), right_down_rad);
  return {floor * attitude * machine.base_from_machine.transpose(), floor * Vector3d(x_m, y_m, machine.base_height_m)};
}

double Truth::error(int quantity, double value) const {
  const auto q = static_cast<std::size_t>(quantity);
  return value - std::clamp(value, low.at(q), high.at(q));
}

Truth truth_of(const Road& road, const Machine& machine, const Pose& pose) {
  const Level level(pose.turn.transpose() * road.floor.normal);
  const Matrix3d level_from_world = level.from_base * pose.turn.transpose();
  const Vector3d forward_base = machine.base_from_machine.col(0), left_base = machine.base_from_machine.col(1);
  const double by_left_rad = yaw_by_wall_rad(level.from_base * forward_base, level_from_world * road.left.normal);
  const double by_right_rad = yaw_by_wall_rad(level.from_base * forward_base, level_from_world * road.right.normal);
  Truth truth;
  truth.low = {level.roll_rad, level.pitch_rad, std::min(by_left_rad, by_right_rad), 0.0, 0.0, 0.0, 0.0};
  truth.high = {level.roll_rad, level.pitch_rad, std::max(by_left_rad, by_right_rad), 0.0, 0.0, 0.0, 0.0};
  const std::array<double, 2> along_m = {machine.s_front_m, machine.s_back_m};
  for (std::size_t k = 0; k < 2; ++k) {
    const Vector3d on_left_m = pose.to_world(along_m[k] * forward_base + machine.offset_left_m * left_base);
    const Vector3d on_right_m = pose.to_world(along_m[k] * forward_base + machine.offset_right_m * left_base);
    truth.low[POSE_WALL_D_LF + k] = truth.high[POSE_WALL_D_LF + k] = std::abs(road.left.distance_m(on_left_m));
    truth.low[POSE_WALL_D_RF + k] = truth.high[POSE_WALL_D_RF + k] = std::abs(road.right.distance_m(on_right_m));
  }
  return truth;
}

std::vector<Setting> settings_of(const Machine& machine) {
  const Mounting& mounting = machine.mounting;
  std::vector<Setting> settings = {{"forward_axis", machine.forward_axis}};
  const auto number = [&settings](const char* key, double value) {
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.9f", value);
    settings.emplace_back(key, text.data());
  };
  number("extrinsic_x", mounting.position_base_m.x());
  number("extrinsic_y", mounting.position_base_m.y());
  number("extrinsic_z", mounting.position_base_m.z());
  number("extrinsic_roll", mounting.roll_rad);
  number("extrinsic_pitch", mounting.pitch_rad);
  number("extrinsic_yaw", mounting.yaw_rad);
  number("s_front", machine.s_front_m);
  number("s_back", machine.s_back_m);
  number("lateral_offset_left", machine.offset_left_m);
  number("lateral_offset_right", machine.offset_right_m);
  for (std::size_t k = 0; k < machine.boxes.size(); ++k) {
    settings.emplace_back("body_box_" + std::to_string(k + 1), machine.boxes[k]);
  }
  return settings;
}

}  // namespace pose_wall::judge
