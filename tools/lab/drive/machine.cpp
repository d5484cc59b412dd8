// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/drive/machine.hpp"

#include <algorithm>
#include <cmath>

#include "io/language/language.hpp"
#include "io/numbers/angles.hpp"
#include "lab/sim/network_people.hpp"
#include "study/planar/part_block.hpp"

namespace pose_wall::tools {
namespace {

// Standard deviations of floor and roof are a few centimetres; the reach of every sensor_model() is below this.
constexpr double kReach_m = 100.0;

// A point above base's place on the floor: the machine's lean moves it.
sim::Place leaned(const sim::TrackDrive& drive, double height_m) {
  const double along_m = kTurnAhead_m + height_m * std::sin(drive.pitch_rad()) * std::cos(drive.roll_rad());
  const double across_m = -height_m * std::sin(drive.roll_rad());
  const sim::PlanePose& at = drive.truth();
  const double c = std::cos(at.yaw_rad), s = std::sin(at.yaw_rad);
  return {at.x_m + c * along_m - s * across_m, at.y_m + s * along_m + c * across_m};
}

}  // namespace

std::vector<std::string> drive_sensors() {
  std::vector<std::string> names;
  for (const sim::SensorModel& model : sim::sensor_models()) names.push_back(model.sensor.name);
  return names;
}

const sim::SensorModel& drive_sensor(const std::string& name) {
  const sim::SensorModel* const model = sim::find_sensor(name);
  if (model == nullptr) throw std::invalid_argument(say("there is no sensor '{}'", name));
  return *model;
}

api::Config drive_config(const sim::SensorModel& model) {
  api::Config config;
  const auto set = [&config](const char* key, double value) {
    require_ok(config.set(key, value), translatable("the settings of the drive"));
  };
  for (const EngineSetting& setting : model.engine) {
    require_ok(config.set(setting.key.c_str(), setting.value.c_str()), translatable("the settings of the drive"));
  }
  set("extrinsic_z", kMastHeight_m - kBaseHeight_m);
  set("extrinsic_roll", model.mount_roll_deg * kRadPerDeg);
  set("range_max", kReach_m);
  return config;
}

pose_wall_planar_scanner_settings drive_scanner_settings() {
  pose_wall_planar_scanner_settings settings{};
  require_ok(pose_wall_planar_scanner_settings_init(&settings), translatable("the settings of the scan"));
  // On the plane of the tracks a hump far ahead would be a wall: the map takes what is well above the floor and near.
  settings.ground_clearance_m = 0.5;
  settings.range_max_m = 20.0;
  return settings;
}

pose_wall_planar_stop_settings drive_stop_settings() {
  pose_wall_planar_stop_settings settings{};
  require_ok(pose_wall_planar_stop_settings_init(&settings), translatable("the settings of the stop"));
  require_ok(pose_wall_planar_stop_rectangle(&settings, -kRear_m, kFront_m, -kHalfWidth_m, kHalfWidth_m),
             translatable("the settings of the stop"));
  settings.floor_z_m = -kBaseHeight_m;
  settings.speed_max_m_s = 0.7;
  settings.approach_m_s = sim::kWalkMost_mps;
  settings.scan_s = 0.0;             // simulated frames are taken at one instant
  settings.stale_s = 0.16;           // a frame's period, and its way to here
  settings.latency_s = 0.3;          // the lag of the tracks, and a little
  settings.deceleration_m_s2 = 0.5;  // sim::TrackSettings::acceleration_mps2, and the lag's tail
  settings.slack_s = 0.2;
  settings.restart_s = 0.5;
  settings.settle_s = 1.0;
  settings.memory_s = 600.0;                                   // nothing falls from the roof here
  settings.speed_error_m_s = settings.turn_error_rad_s = 0.0;  // fine counters and a gyroscope: a share is enough
  return settings;
}

pose_wall_planar_track_settings drive_track_settings(double speed_max_m_s) {
  pose_wall_planar_track_settings settings{};
  require_ok(pose_wall_planar_track_settings_init(&settings), translatable("the settings of the drive"));
  const sim::TrackSettings tracks = drive_tracks();
  settings.speed_max_m_s = speed_max_m_s;
  settings.track_distance_m = tracks.gauge_m * tracks.turn_resistance;
  settings.delay_s = kFrame_s - kResult_s;
  settings.lag_s = tracks.lag_s;
  return settings;
}

pose_wall_planar_plan_settings drive_plan_settings(const pose_wall_planar_grid& grid, double margin_m) {
  constexpr std::uint32_t kSideLeast = 8;
  pose_wall_planar_plan_settings settings{};
  require_ok(pose_wall_planar_plan_settings_init(&settings), translatable("the settings of the route"));
  settings.width_max = std::max(grid.width, kSideLeast);
  settings.height_max = std::max(grid.height, kSideLeast);
  settings.resolution_m = grid.resolution_m;
  settings.front_m = kFront_m;
  settings.rear_m = kRear_m;
  settings.left_m = settings.right_m = kHalfWidth_m;
  settings.margin_m = margin_m;
  settings.turn_cost_m_rad = 2.0;  // turns on the spot beside rock are slow under the stop
  return settings;
}

sim::TrackSettings drive_tracks() {
  sim::TrackSettings tracks;
  tracks.turn_ahead_m = kTurnAhead_m;
  tracks.count_m = 0.0005;
  tracks.gyroscope = 1.0;
  return tracks;
}

double stop_needs_least_m() {
  // Half the diagonals of a place on the ground and of a cell of sight, and what is lost between two slices of the
  // sweep: src/planar/stop.
  constexpr double kPlaceCorner_m = 0.071, kCellCorner_m = 0.064, kSlice_m = 0.1;
  return drive_stop_settings().protection_m + kPlaceCorner_m + kCellCorner_m + kSlice_m;
}

double stop_needs_most_m() {
  return stop_needs_least_m() + drive_stop_settings().drift_max_m;
}

sim::TrackSpeeds track_speeds(const Motion& motion) {
  const sim::TrackSettings tracks = drive_tracks();
  const double grip = 1.0 - tracks.odometry_slip;
  const double half_m_s = 0.5 * motion.turn_rad_s * tracks.gauge_m * tracks.odometry_turn_resistance;
  return {(motion.speed_m_s - half_m_s) / grip, (motion.speed_m_s + half_m_s) / grip};
}

double rim_speed_m_s(const Motion& motion) {
  const double across = std::abs(motion.turn_rad_s) * kRear_m;
  return std::hypot(std::abs(motion.speed_m_s) + std::abs(motion.turn_rad_s) * kHalfWidth_m, across);
}

pose_wall_planar_pose true_base(const sim::TrackDrive& drive) {
  const sim::Place at = leaned(drive, kBaseHeight_m);
  return {at.x(), at.y(), drive.truth().yaw_rad};
}

sim::StandingPose true_sensor(const sim::TrackDrive& drive, const sim::SensorModel& model) {
  const sim::Place at = leaned(drive, kMastHeight_m);
  sim::StandingPose pose;
  pose.at = {at.x(), at.y(), drive.truth().yaw_rad};
  pose.height_m = drive.height_m() + kMastHeight_m * std::cos(drive.pitch_rad()) * std::cos(drive.roll_rad());
  pose.roll_rad = drive.roll_rad() + model.mount_roll_deg * kRadPerDeg;
  pose.pitch_rad = drive.pitch_rad();
  return pose;
}

}  // namespace pose_wall::tools
