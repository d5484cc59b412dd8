// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "judge/scanner.hpp"

#include <cmath>
#include <limits>

namespace pose_wall::judge {
namespace {

// Largest constant error of a range that is drawn: half of what the config allows (range_bias_max).
constexpr double kBias_m = 0.015;
constexpr double kRangeMin_m = 0.1, kRangeMax_m = 90.0;

}  // namespace

// Range noise and steps by the data sheets. Velodyne: VLP-16 within 3 cm, taken for two sigma, 2 mm; HDL-32E 2 cm.
// Ouster: OS1-64 and OS0-128 1 to 1.5 cm, 1 mm. Livox: Mid-360 2 cm at 10 m, 1 mm, 200,000 points a second.
const std::array<Sensor, kSensors> kSensorTable = {{
    {"vlp16", "vlp16.yaml", Pattern::kRings, 16, 28800, -15.0, 15.0, 0.015, 0.002, 0.003, Hung::kUpright},
    {"hdl32", "os1-64.yaml", Pattern::kRings, 32, 57600, -30.67, 10.67, 0.015, 0.002, 0.003, Hung::kUpright},
    {"os1_64", "os1-64.yaml", Pattern::kRings, 64, 65536, -22.5, 22.5, 0.012, 0.001, 0.005, Hung::kAnyhow},
    {"os0_128", "pose_wall.yaml", Pattern::kRings, 128, 65536, -45.0, 45.0, 0.012, 0.001, 0.005, Hung::kAnyhow},
    {"mid360_down", "mid360.yaml", Pattern::kRosette, 1, 20000, -7.0, 52.0, 0.02, 0.001, 0.01, Hung::kUpsideDown},
    {"mid360_up", "mid360.yaml", Pattern::kRosette, 1, 20000, -7.0, 52.0, 0.02, 0.001, 0.01, Hung::kUpright},
    {"random_down", "mid360.yaml", Pattern::kRandom, 1, 20000, -7.0, 52.0, 0.02, 0.001, 0.02, Hung::kUpsideDown},
    {"random_wide", "mid360.yaml", Pattern::kRandom, 1, 40000, -45.0, 45.0, 0.015, 0.001, 0.02, Hung::kAnyhow},
}};

Scanner::Scanner(const Sensor& sensor, bool no_bias, Draw* draw)
    : sensor_(sensor),
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
  const double level = std::cos(elevation_rad);
  return {level * std::cos(azimuth_rad), level * std::sin(azimuth_rad), std::sin(elevation_rad)};
}

std::vector<float> Scanner::scan(const Road& road, const Machine& machine, const Pose& pose, int frame,
                                 Draw* draw) const {
  const Matrix3d sensor_to_world = pose.turn * machine.mounting.turn();
  const Vector3d origin_m = pose.to_world(machine.mounting.position_base_m);
  std::vector<Solid> body_world = machine.body_base;
  for (Solid& part : body_world) {
    part.centre_m = pose.to_world(part.centre_m);
    part.axes = pose.turn * part.axes;
  }
  std::vector<float> points;
  points.reserve(3 * static_cast<std::size_t>(sensor_.rays));
  for (int ray = 0; ray < sensor_.rays; ++ray) {
    const Vector3d way_sensor = direction(ray, frame, draw);
    const double exact_m = judge::range_m(road, body_world, {origin_m, sensor_to_world * way_sensor}, draw);
    const double measured_m = exact_m + bias_m_ + sensor_.noise_m * draw->normal();
    const double told_m = sensor_.quantum_m * std::round(measured_m / sensor_.quantum_m);
    const bool lost = exact_m < kRangeMin_m || exact_m > kRangeMax_m || draw->chance(sensor_.dropouts);
    if (lost && lost_as_ == 0) continue;
    const double none = lost_as_ == 1 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < 3; ++i) points.push_back(static_cast<float>(lost ? none : told_m * way_sensor[i]));
  }
  return points;
}

}  // namespace pose_wall::judge
