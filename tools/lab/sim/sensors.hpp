// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/beams/sensor_settings.hpp"
#include "lab/sim/centre_line.hpp"
#include "lab/sim/setup.hpp"

namespace pose_wall::tools::sim {

struct SensorModel {
  Sensor sensor;
  std::string help;
  double mount_roll_deg;              // as it is to be mounted; a scene may say otherwise
  std::vector<EngineSetting> engine;  // in which an engine for this sensor differs from the defaults
};

// One of each class: even rings whose light all leaves the origin. Campaigns judge these.
const std::vector<SensorModel>& sensor_models();
// As they are built, by the tables of io/beams/.
const std::vector<SensorModel>& real_sensor_models();
// Of either; nullptr if there is none of this name.
const SensorModel* find_sensor(std::string_view name);
// Of both, in this order.
std::vector<std::string> sensor_names();

struct Beam {
  Vector direction;  // unit, lidar frame
  std::uint16_t ring = 0;
  std::uint16_t step = 0;          // the steps of a scan fire evenly over it: a firing of all lasers, or beams at once
  double share = 0.0;              // of its step, after which this beam fires
  Vector origin = Vector::Zero();  // where its light leaves, lidar frame
};

// Where a beam ends, as the sensor's driver works it out, in units of 1 / unit_scale m.
Vector point_of(const Beam& beam, double range_m, double unit_scale = 1.0);

// Of a frame, ring by ring for rotating sensors, where every frame has the same; a non-repetitive pattern goes on where
// the last frame ended.
std::vector<Beam> beams_of(const Sensor& sensor, std::uint32_t frame_index);
// How many steps a scan has: the columns of a rotating sensor.
std::uint32_t scan_steps(const Sensor& sensor);

}  // namespace pose_wall::tools::sim
