// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the obstacle stop would let a machine do on the best of roads: flat, straight and empty, with exact motion,
// after a person has looked round the machine. The stop itself judges simulated frames. What it does not permit there
// it permits nowhere.

#pragma once

#include <cstdint>
#include <string>

#include "io/config_file/load_config.hpp"
#include "lab/sim/sensors.hpp"

namespace pose_wall::tools {

struct StopProspect {
  bool drives = false;        // on and on: further than the strip that a person confirmed
  std::uint32_t reasons = 0;  // of its last stop, where it does not drive
};

// The mount is that of config. Without known motion the stop assumes every one, as with planar_motion: assumed. Throws
// PlanarError where the stop cannot be opened.
StopProspect stop_prospect(const api::Config& config, const pose_wall_planar_stop_settings& settings,
                           const sim::Sensor& sensor, bool is_motion_known);

// For check-config: what the settings of pose_wall.yaml let the machine do, and where that is nothing, which other
// mount would help. "" where planar is off, or the sensor's beams are not known here.
std::string stop_prospect_text(const LoadedConfig& loaded);

}  // namespace pose_wall::tools
