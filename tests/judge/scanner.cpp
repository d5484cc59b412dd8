// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/scanner.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

namespace pose_wall::judge {
namespace {

// Largest constant error of a range that is drawn: half of what the config allows (range_bias_max).
constexpr double kBias_m = 0.015;
constexpr double kRangeMin_m = 0.1, kRangeMax_m = 90.0;
constexpr double kScan_us = 1e5, kScan_ns = 1e8;  // 10 Hz
constexpr double kLost_m = -1.0;

Vector3d towards(double azimuth_rad, double elevation_rad) {
  const double level = std::cos(elevation_rad);
  return {level * std::cos(azimuth_rad), level * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

std::vector<Solid> moved(const std::vector<Solid>& body, const Pose& pose) {
  std::vector<Solid> body_world = body;
  for (Solid& part : body_world) {
    part.centre_m = pose.to_world(part.centre_m);
    part.axes = pose.turn * part.axes;
  }
  return body_world;
}

}  // namespace

// Range noise and steps by the data sheets. Velodyne: VLP-16 within 3 cm, taken for two sigma, 2 mm; HDL-32E 2 cm;
// VLP-32C as the VLP-16, 4 mm. Ouster: OS1-64 and OS0-128 1 to 1.5 cm, 1 mm. Livox: Mid-360 2 cm at 10 m, 1 mm, 200,000
// points a second. Hesai: XT32 1 cm, 4 mm. RoboSense: RS-16 within 2 cm, 5 mm.
// The even rows of rings stay, so that a seed keeps its road.
const std::array<Sensor, kAllSensors> kSensorTable = {{
    {"vlp16", "vlp16.yaml", Pattern::kRings, 16, 28800, -15.0, 15.0, 0.015, 0.002, 0.003, Hung::kUpright},
    {"hdl32", "os1-64.yaml", Pattern::kRings, 32, 57600, -30.67, 10.67, 0.015, 0.002, 0.003, Hung::kUpright},
    {"os1_64", "os1-64.yaml", Pattern::kRings, 64, 65536, -22.5, 22.5, 0.012, 0.001, 0.005, Hung::kAnyhow},
    {"os0_128", "pose_wall.yaml", Pattern::kRings, 128, 65536, -45.0, 45.0, 0.012, 0.001, 0.005, Hung::kAnyhow},
    {"mid360_down", "mid360.yaml", Pattern::kRosette, 1, 20000, -7.0, 52.0, 0.02, 0.001, 0.01, Hung::kUpsideDown},
    {"mid360_up", "mid360.yaml", Pattern::kRosette, 1, 20000, -7.0, 52.0, 0.02, 0.001, 0.01, Hung::kUpright},
    {"random_down", "mid360.yaml", Pattern::kRandom, 1, 20000, -7.0, 52.0, 0.02, 0.001, 0.02, Hung::kUpsideDown},
    {"random_wide", "mid360.yaml", Pattern::kRandom, 1, 40000, -45.0, 45.0, 0.015, 0.001, 0.02, Hung::kAnyhow},
    {"vlp16_beams", "vlp16.yaml", Pattern::kRings, 16, 0, 0.0, 0.0, 0.015, 0.002, 0.003, Hung::kUpright, vlp16_beams},
    {"hdl32_beams", "os1-64.yaml", Pattern::kRings, 32, 0, 0.0, 0.0, 0.015, 0.002, 0.003, Hung::kUpright, hdl32_beams},
    {"vlp32c", "os1-64.yaml", Pattern::kRings, 32, 0, 0.0, 0.0, 0.015, 0.004, 0.003, Hung::kUpright, vlp32c_beams},
    {"xt32", "os1-64.yaml", Pattern::kRings, 32, 0, 0.0, 0.0, 0.01, 0.004, 0.003, Hung::kUpright, xt32_beams},
    {"os1_64_beams", "os1-64.yaml", Pattern::kRings, 64, 0, 0.0, 0.0, 0.012, 0.001, 0.005, Hung::kAnyhow, os1_64_beams},
    {"os0_128_beams", "pose_wall.yaml", Pattern::kRings, 128, 0, 0.0, 0.0, 0.012, 0.001, 0.005, Hung::kAnyhow,
     os0_128_beams},
    {"rs16", "vlp16.yaml", Pattern::kRings, 16, 0, 0.0, 0.0, 0.01, 0.005, 0.003, Hung::kUpright, rs16_beams},
}};

int sensor_row(const std::string& name) {
  for (int row = 0; row < kAllSensors; ++row) {
    if (name == sensor_at(row).name) return row;
  }
  return -1;
}

int draw_real_sensor(Draw* draw) {
  std::vector<int> rows;
  for (int row = 0; row < kAllSensors; ++row) {
    if (sensor_at(row).pattern != Pattern::kRings || sensor_at(row).beams != nullptr) rows.push_back(row);
  }
  return rows[static_cast<std::size_t>(draw->whole(0, static_cast<int>(rows.size()) - 1))];
}

bool tells_times(const Sensor& sensor) {
  return sensor.pattern != Pattern::kRandom;
}

pose_wall_cloud Cloud::described(std::int64_t stamp_ns) const {
  pose_wall_cloud cloud;
  pose_wall_cloud_xyz32(&cloud, points.data(), static_cast<std::uint32_t>(points.size()), sizeof(Point), stamp_ns);
  if (timed) {
    cloud.time = {offsetof(Point, after_ns), POSE_WALL_FIELD_UINT32};
    cloud.ring = {offsetof(Point, ring), POSE_WALL_FIELD_UINT32};
  }
  return cloud;
}

Scanner::Scanner(const Sensor& sensor, bool no_bias, Draw* draw)
    : sensor_(sensor),
      beams_(sensor.beams == nullptr ? Beams() : sensor.beams()),
      bias_m_(draw->uniform(-kBias_m, kBias_m) * (no_bias ? 0.0 : 1.0)),
      phase_rad_(draw->uniform(0.0, 2.0 * kPi)),
      lost_as_(draw->whole(0, 2)) {}

Vector3d Scanner::direction(int ray, int frame, Draw* draw) const {
  const double down_rad = kRadPerDeg * sensor_.down_deg, up_rad = kRadPerDeg * sensor_.up_deg;
  double azimuth_rad = 0.0, elevation_rad = 0.0;
  if (sensor_.pattern == Pattern::kRings) {
    const int ring = ray % sensor_.rings, column = ray / sensor_.rings, columns = sensor_.rays / sensor_.rings;
    azimuth_rad = phase_rad_ + 2.0 * kPi * column / columns;
    elevation_rad = down_rad + (up_rad - down_rad) * ring / (sensor_.rings - 1);
  } else if (sensor_.pattern == Pattern::kRosette) {
    // Turns about the axis and swings across the field at rates without a common measure, by four lines of light.
    const double time = frame + static_cast<double>(ray) / sensor_.rays, line = ray % 4;
    const double swing = 0.5 - 0.5 * std::cos(2.0 * kPi * 97.61803 * time + 0.35 * line);
    azimuth_rad = phase_rad_ + 2.0 * kPi * (13.41421 * time + 0.25 * line);
    elevation_rad = down_rad + (up_rad - down_rad) * swing;
  } else {
    azimuth_rad = draw->uniform(-kPi, kPi);
    elevation_rad = draw->uniform(down_rad, up_rad);
  }
  return towards(azimuth_rad, elevation_rad);
}

// These heads turn clockwise, seen from above, and never stop between two lasers.
Scanner::Shot Scanner::shot_by_table(int k) const {
  const int lasers = static_cast<int>(beams_.lasers.size());
  const Beam& beam = beams_.lasers[static_cast<std::size_t>(k % lasers)];
  const double share = (k / lasers * beams_.firing_us + beam.after_us) / kScan_us;
  const double head_rad = phase_rad_ - 2.0 * kPi * share;
  const Vector3d from_m = beams_.lens_m * towards(head_rad, 0.0) + beam.up_m * Vector3d::UnitZ();
  return {from_m, towards(head_rad + kRadPerDeg * beam.azimuth_deg, kRadPerDeg * beam.elevation_deg), share, beam.ring};
}

int Scanner::shots() const {
  if (beams_.lasers.empty()) return sensor_.rays;
  return static_cast<int>(kScan_us / beams_.firing_us + 1e-9) * static_cast<int>(beams_.lasers.size());
}

Scanner::Shot Scanner::shot(int k, int frame, Draw* draw) const {
  if (!beams_.lasers.empty()) return shot_by_table(k);
  const int at_once = sensor_.pattern == Pattern::kRings ? sensor_.rings : 1;
  const double share =
      sensor_.pattern == Pattern::kRandom ? 0.0 : static_cast<double>(k / at_once * at_once) / sensor_.rays;
  const int line = sensor_.pattern == Pattern::kRosette ? k % 4 : k % sensor_.rings;
  return {Vector3d::Zero(), direction(k, frame, draw), share, line};
}

double Scanner::told_m(double exact_m, double before_m, Draw* draw) const {
  const double measured_m = before_m + exact_m + bias_m_ + sensor_.noise_m * draw->normal();
  const double told_m = sensor_.quantum_m * std::round(measured_m / sensor_.quantum_m) - before_m;
  const bool lost = exact_m < kRangeMin_m || exact_m > kRangeMax_m || draw->chance(sensor_.dropouts);
  return lost ? kLost_m : told_m;
}

void Scanner::add(Cloud* cloud, const Shot& shot, double told_m) const {
  if (told_m == kLost_m && lost_as_ == 0) return;
  const double none = lost_as_ == 1 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
  Vector3d at_m = Vector3d::Constant(none);
  if (told_m != kLost_m) at_m = shot.from_m + told_m * shot.way;
  cloud->points.push_back({static_cast<float>(at_m.x()), static_cast<float>(at_m.y()), static_cast<float>(at_m.z()),
                           static_cast<std::uint32_t>(kScan_ns * shot.share), static_cast<std::uint32_t>(shot.ring)});
}

Cloud Scanner::scan(const Road& road, const Machine& machine, const Pose& pose, int frame, Draw* draw) const {
  const Matrix3d sensor_to_world = pose.turn * machine.mounting.turn();
  const Vector3d origin_m = pose.to_world(machine.mounting.position_base_m);
  const std::vector<Solid> body_world = moved(machine.body_base, pose);
  Cloud cloud;
  cloud.points.reserve(static_cast<std::size_t>(shots()));
  for (int k = 0; k < shots(); ++k) {
    const Shot ray = shot(k, frame, draw);
    const Vector3d from_m = origin_m + sensor_to_world * ray.from_m;
    const double exact_m = judge::range_m(road, body_world, {from_m, sensor_to_world * ray.way}, draw);
    add(&cloud, ray, told_m(exact_m, beams_.from_axis ? beams_.lens_m : 0.0, draw));
  }
  return cloud;
}

Cloud Scanner::sweep(const Road& road, const Machine& machine, const Passage& passage, int frame, Draw* draw) const {
  const Matrix3d sensor_to_base = machine.mounting.turn();
  Cloud cloud;
  cloud.timed = tells_times(sensor_);
  cloud.points.reserve(static_cast<std::size_t>(shots()));
  double posed_at = -1.0;
  Pose pose;
  std::vector<Solid> body_world;
  for (int k = 0; k < shots(); ++k) {
    const Shot ray = shot(k, frame, draw);
    if (ray.share != posed_at) {
      pose = passage.at(ray.share);
      body_world = moved(machine.body_base, pose);
      posed_at = ray.share;
    }
    const Vector3d from_m = pose.to_world(machine.mounting.position_base_m + sensor_to_base * ray.from_m);
    const Ray to = {from_m, pose.turn * (sensor_to_base * ray.way)};
    const double exact_m = judge::range_m(road, body_world, to, draw);
    add(&cloud, ray, told_m(exact_m, beams_.from_axis ? beams_.lens_m : 0.0, draw));
  }
  return cloud;
}

}  // namespace pose_wall::judge
