// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/centre_line.hpp"
#include "sim/setup.hpp"

namespace pose_wall::tools::sim {

// A setting of the engine: a key of pose_wall.yaml and its value.
struct EngineSetting {
  std::string key;
  std::string value;
};

struct SensorModel {
  Sensor sensor;
  std::string help;
  double mount_roll_deg;              // as it is to be mounted; a scene may say otherwise
  std::vector<EngineSetting> engine;  // in which an engine for this sensor differs from the defaults
};

const std::vector<SensorModel>& sensor_models();
// nullptr if there is none of this name.
const SensorModel* find_sensor(std::string_view name);

struct Beam {
  Vector direction;  // unit, lidar frame
  std::uint16_t ring = 0;
  std::uint16_t step = 0;  // beams of one step fire at once, and the steps evenly over the scan
};

// Of a frame, ring by ring for rotating sensors, where every frame has the same; a non-repetitive pattern goes on where
// the last frame ended.
std::vector<Beam> beams_of(const Sensor& sensor, std::uint32_t frame_index);
// How many steps a scan has: the columns of a rotating sensor.
std::uint32_t scan_steps(const Sensor& sensor);

}  // namespace pose_wall::tools::sim
