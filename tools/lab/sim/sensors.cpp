// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "lab/sim/sector.hpp"

namespace pose_wall::tools::sim {
namespace {

// A pattern's points fire one by one; within a thousandth of a scan nothing moves.
constexpr std::uint32_t kPatternSteps = 1000;

Sensor rotating(const char* name, double rings, double columns, double elevation_deg, double noise_m, double reach_m) {
  Sensor sensor;
  sensor.name = name;
  sensor.rings = rings;
  sensor.columns = columns;
  sensor.elevation_min_deg = -elevation_deg;
  sensor.elevation_max_deg = elevation_deg;
  sensor.range_noise_m = noise_m;
  sensor.range_ceiling_m = reach_m;
  return sensor;
}

// Where a sensor of this lowest beam sees the floor well from 1.3 m above it, and twice as far: as in config/. One that
// looks down steeply sees the floor from the machine's end on.
Sensor with_floor(Sensor sensor) {
  struct FloorReach {
    double lowest_deg, from_m, to_m;
  };
  for (const FloorReach& reach :
       {FloorReach{-12.0, 8.0, 16.0}, FloorReach{-19.0, 5.0, 10.0}, FloorReach{-30.0, 4.0, 8.0}}) {
    if (sensor.elevation_min_deg < reach.lowest_deg) continue;
    sensor.floor_from_m = reach.from_m;
    sensor.floor_to_m = reach.to_m;
    break;
  }
  return sensor;
}

Sensor non_repetitive() {
  Sensor sensor = rotating("mid360", 0.0, 0.0, 0.0, 0.02, 40.0);
  sensor.pattern_points = 20000.0;
  sensor.elevation_min_deg = -7.0;
  sensor.elevation_max_deg = 52.0;
  return sensor;
}

Vector direction(double azimuth_rad, double elevation_rad) {
  return {std::cos(elevation_rad) * std::cos(azimuth_rad), std::cos(elevation_rad) * std::sin(azimuth_rad),
          std::sin(elevation_rad)};
}

Sensor real_sensor(const BeamTable& table) {
  Sensor sensor;
  sensor.name = table.word;
  sensor.beams = &table;
  sensor.rings = static_cast<double>(table.lasers.size());
  sensor.columns = table.columns;
  sensor.elevation_min_deg = table.lowest_deg();
  sensor.elevation_max_deg = table.highest_deg();
  sensor.range_noise_m = table.ranges.noise_m;
  sensor.range_quantum_m = table.ranges.unit_m;
  sensor.range_floor_m = table.ranges.min_m;
  sensor.range_ceiling_m = table.ranges.max_m;
  sensor.divergence_deg = table.ranges.beam_deg;
  return with_floor(sensor);
}

SensorModel model_of(const Sensor& sensor, const std::string& help, double mount_roll_deg) {
  return {sensor, help, mount_roll_deg, engine_settings_of(sensor.name)};
}

std::string help_of(const BeamTable& table) {
  std::ostringstream help;
  help << table.title << ": " << table.lasers.size() << " lasers, " << table.lowest_deg() << " to "
       << table.highest_deg() << " deg, " << table.columns << " columns, noise " << 100.0 * table.ranges.noise_m
       << " cm, steps of " << 1000.0 * table.ranges.unit_m << " mm, light from "
       << std::round(1e6 * table.reach_m()) / 1e3 << " mm off the origin";
  return help.str();
}

std::vector<Beam> table_beams(const Sensor& sensor) {
  const BeamTable& table = *sensor.beams;
  std::vector<Laser> by_ring = table.lasers;
  std::sort(by_ring.begin(), by_ring.end(), [](const Laser& a, const Laser& b) { return a.ring < b.ring; });
  const auto columns = static_cast<std::uint32_t>(sensor.columns);
  std::vector<Beam> beams;
  beams.reserve(by_ring.size() * columns);
  for (const Laser& laser : by_ring) {
    for (std::uint32_t column = 0; column < columns; ++column) {
      const auto [origin_m, direction] = laser_ray(table, laser, column, columns);
      beams.push_back({Vector(direction.data()), laser.ring, static_cast<std::uint16_t>(column),
                       laser.after_ns / table.cycle_ns, Vector(origin_m.data())});
    }
  }
  return beams;
}

std::vector<Beam> ring_beams(const Sensor& sensor) {
  const auto rings = static_cast<int>(sensor.rings);
  const auto columns = static_cast<int>(sensor.columns);
  const double span_deg = sensor.elevation_max_deg - sensor.elevation_min_deg;
  std::vector<Beam> beams;
  beams.reserve(static_cast<std::size_t>(rings) * static_cast<std::size_t>(columns));
  for (int ring = 0; ring < rings; ++ring) {
    const double elevation_deg =
        sensor.elevation_min_deg + (rings > 1 ? span_deg * ring / (rings - 1) : 0.5 * span_deg);
    for (int column = 0; column < columns; ++column) {
      beams.push_back({direction(-2.0 * M_PI * column / columns, elevation_deg * kRadPerDeg),
                       static_cast<std::uint16_t>(ring), static_cast<std::uint16_t>(column), 0.0, Vector::Zero()});
    }
  }
  return beams;
}

// The R2 low-discrepancy sequence (Roberts 2018): even cover in every frame, never the same twice.
std::vector<Beam> pattern_beams(const Sensor& sensor, std::uint32_t frame_index) {
  constexpr double kStepAzimuth = 0.7548776662466927;
  constexpr double kStepElevation = 0.5698402909980532;
  const auto count = static_cast<std::size_t>(sensor.pattern_points);
  const double span_deg = sensor.elevation_max_deg - sensor.elevation_min_deg;
  std::vector<Beam> beams;
  beams.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = static_cast<double>(frame_index % 10000u) * static_cast<double>(count) + static_cast<double>(i);
    double whole = 0.0;
    const double azimuth = 2.0 * M_PI * std::modf(n * kStepAzimuth, &whole);
    const double elevation_deg = sensor.elevation_min_deg + span_deg * std::modf(n * kStepElevation, &whole);
    beams.push_back({direction(azimuth, elevation_deg * kRadPerDeg), 0,
                     static_cast<std::uint16_t>(i * kPatternSteps / count), 0.0, Vector::Zero()});
  }
  return beams;
}

}  // namespace

const std::vector<SensorModel>& sensor_models() {
  static const std::vector<SensorModel> models = {
      model_of(with_floor(rotating("vlp16", 16.0, 1800.0, 15.0, 0.02, 100.0)),
               "16 rings, -15 to 15 deg, 1800 columns, 2 cm noise", 0.0),
      model_of(with_floor(rotating("os1-64", 64.0, 1024.0, 22.5, 0.012, 90.0)),
               "64 rings, -22.5 to 22.5 deg, 1024 columns, 1.2 cm noise", 0.0),
      model_of(with_floor(rotating("os0-128", 128.0, 1024.0, 45.0, 0.015, 50.0)),
               "128 rings, -45 to 45 deg, 1024 columns, 1.5 cm noise", 0.0),
      model_of(non_repetitive(),
               "non-repetitive, -7 to 52 deg, 20000 points per frame, 2 cm noise; upside down, to see the floor",
               180.0),
  };
  return models;
}

const std::vector<SensorModel>& real_sensor_models() {
  static const std::vector<SensorModel> models = [] {
    std::vector<SensorModel> all;
    for (const BeamTable* const table : beam_tables()) {
      // What looks up alone has to be turned round to see the floor.
      const bool hangs = table->lowest_deg() > 0.0;
      all.push_back(model_of(real_sensor(*table), help_of(*table) + (hangs ? "; upside down, to see the floor" : ""),
                             hangs ? 180.0 : 0.0));
    }
    return all;
  }();
  return models;
}

const SensorModel* find_sensor(std::string_view name) {
  for (const auto* const models : {&sensor_models(), &real_sensor_models()}) {
    for (const SensorModel& model : *models) {
      if (model.sensor.name == name) return &model;
    }
  }
  return nullptr;
}

std::vector<std::string> sensor_names() {
  std::vector<std::string> names;
  for (const auto* const models : {&sensor_models(), &real_sensor_models()}) {
    for (const SensorModel& model : *models) names.push_back(model.sensor.name);
  }
  return names;
}

Vector point_of(const Beam& beam, double range_m, double unit_scale) {
  const Vector way = range_m * unit_scale * beam.direction;
  // Zeros would be added to minus zeros, and change their bits.
  return beam.origin.isZero(0.0) ? way : Vector(way + unit_scale * beam.origin);
}

std::vector<Beam> beams_of(const Sensor& sensor, std::uint32_t frame_index) {
  std::vector<Beam> beams = sensor.beams != nullptr ? table_beams(sensor)
                            : sensor.rings > 0.0    ? ring_beams(sensor)
                                                    : pattern_beams(sensor, frame_index);
  if (sensor.window_from_deg == sensor.window_to_deg) return beams;
  const auto is_outside = [&sensor](const Beam& beam) {
    const double azimuth_deg = std::atan2(beam.direction.y(), beam.direction.x()) / kRadPerDeg;
    return !in_sector(azimuth_deg, sensor.window_from_deg, sensor.window_to_deg);
  };
  beams.erase(std::remove_if(beams.begin(), beams.end(), is_outside), beams.end());
  return beams;
}

std::uint32_t scan_steps(const Sensor& sensor) {
  return sensor.rings > 0.0 ? static_cast<std::uint32_t>(sensor.columns) : kPatternSteps;
}

}  // namespace pose_wall::tools::sim
