// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The settings of a planar scanner as its stages read them.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "lidar/mount.hpp"
#include "part/settings.hpp"
#include "pose_wall_planar_scan.h"

namespace pose_wall::planar {

// Those of the caller, and what follows from them.
struct ScanSettings : pose_wall_planar_scanner_settings {
  // The band's edges above the floor.
  double low_m() const { return ground_clearance_m - margin_m; }
  double high_m() const { return machine_height_m + margin_m; }

  // the scan
  std::uint32_t beams = 0;
  std::uint32_t fill_beams = 0;  // neighbours this far apart can be joined
  double steps_of_turn = 0.0;
  bool goes_round = false;  // the last beam lies beside the first
  bool alone_is_apart = false;
  std::uint32_t sectors = 0;  // of the guarantee, over a whole turn
  double reach_m = 0.0;       // of the guarantee

  // the sensor, and the floor that is held
  double sigma_m = 0.0, hold_rate_rad_s = 0.0;
  Mount mount{};
};

struct ScannerTable : SettingsTable<pose_wall_planar_scanner_settings> {
  using SettingsTable::SettingsTable;
  static SettingRows rows();
  SettingFault broken_rule() const;
};

// Of checked settings.
std::uint32_t beams_of(const pose_wall_planar_scanner_settings& settings);
ScanSettings scan_settings_of(const pose_wall_planar_scanner_settings& settings);
// Of a checked config: the sensor and the hold rate.
void read_sensor(const pose_wall_config& config, ScanSettings* settings);

}  // namespace pose_wall::planar
