// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The keys of pose_wall.yaml by which pose_walld maps the roadway, finds itself in a saved map, and stops the machine.

#pragma once

#include <string>
#include <vector>

#include "io/config_file/live_settings.hpp"
#include "io/config_file/outside_key.hpp"
#include "pose_wall_planar_scan.h"
#include "pose_wall_planar_stop.h"

namespace pose_wall::tools {

pose_wall_planar_stop_settings default_stop_settings();

struct PlanarSettings {
  std::string mode = "off";  // map: SLAM; localise: in the map of `map`
  std::string map;           // trail.pwt, or map.yaml
  std::string map_whole = "no";
  std::string motion = "assumed";
  std::string tf = "off";
  std::string map_frame = "map", odom_frame = "odom";
  std::string command_modbus, command_ros;  // where the commanded motion comes from; empty: not from there
  double command_can = 0.0;                 // likewise; 0: not from there
  double command_age_s = 0.25;
  double cell_m = 0.05, map_every_s = 2.0;
  // The machine, in base and above its floor.
  double x_min_m = -2.25, x_max_m = 2.25, y_min_m = -0.6, y_max_m = 0.6;
  double height_m = 1.8, clearance_m = 0.25;
  double turn_max_deg_s = 23.0, period_s = 0.1;
  // What keys set as it is. stop_settings_of fills in what follows from the others.
  pose_wall_planar_stop_settings stop = default_stop_settings();

  bool is_on() const { return mode != "off"; }
  bool maps() const { return mode == "map"; }
  bool takes_measured() const { return motion == "measured" || motion == "both"; }
  bool takes_command() const { return motion == "commanded" || motion == "both"; }
};

// All rows, in the table's order.
const std::vector<OutsideKey>& planar_keys();
const OutsideKey* find_planar_key(const std::string& name);

// As it would be written in pose_wall.yaml.
std::string planar_value_text(const PlanarSettings& settings, const OutsideKey& key);

// False where the value is not allowed; the settings are then as before.
bool set_planar_value(PlanarSettings* settings, const OutsideKey& key, const std::string& value);

// For the parts of the library; what neither has a key nor follows from one keeps the library's default.
pose_wall_planar_stop_settings stop_settings_of(const PlanarSettings& settings);
pose_wall_planar_scanner_settings scanner_settings_of(const PlanarSettings& settings);

// The rule over several keys that the settings break; empty: none. Each begins with the keys.
std::string broken_planar_rule(const PlanarSettings& settings);
// Likewise over these and the keys of the edges by which commands come.
std::string broken_command_rule(const PlanarSettings& settings, const LiveSettings& live);

}  // namespace pose_wall::tools
