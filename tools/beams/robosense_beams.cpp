// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Lens, unit, nearest and farthest range: RoboSense's rs_driver, 4eeadace, decoders of RS16 and RSHELIOS. Each sensor
// tells its own angles in its DIFOP packet; these are the design's. Accuracy of both: 2 cm.

#include <array>

#include "beams/beam_table.hpp"

namespace pose_wall::tools {
namespace {

// Elevations: ros_rslidar, 726eacca, data/rs_lidar_16/angle.csv. A laser each 2.8 us, a firing each 55.5 us: rs_driver.
BeamTable rs16() {
  BeamTable table{SensorMaker::kRoboSense,
                  "robosense-rs16",
                  "RoboSense RS-LiDAR-16",
                  "rs_driver 4eeadace; angle.csv of ros_rslidar 726eacca",
                  {},
                  1800,
                  55'500.0,
                  true,
                  {0.03825, 0.0, false},
                  {0.005, 0.01, 0.4, 230.0, 0.0}};
  for (int k = 0; k < 16; ++k) {
    const double elevation_deg = k < 8 ? -15.0 + 2.0 * k : 15.0 - 2.0 * (k - 8);
    table.lasers.push_back({elevation_deg, 0.0, 0.0, 2'800.0 * k, 0});
  }
  number_rings(&table.lasers);
  return table;
}

// Elevations and times from the top: RS-Helios-5515 user guide 3.0.1, tables 5 and 13, as a public converter of its
// clouds has them (which parts rings in the middle between two). Its horizontal offsets were not at hand: none here.
constexpr std::array<double, 16> kHeliosUpper_deg = {15.0, 13.0, 11.0,  9.0,   7.0,  5.5,   4.0,   2.67,
                                                     1.33, 0.0,  -1.33, -2.67, -4.0, -5.33, -6.67, -8.0};
constexpr double kHeliosLowerTop_deg = -10.0, kHeliosLowerStep_deg = 3.0;  // down to -55
constexpr std::array<double, 32> kHeliosTimes_us = {
    0.00,  1.57,  3.15,  4.72,  6.30,  7.87,  9.45,  11.36, 13.26, 15.17, 17.08, 18.99, 20.56, 22.14, 23.71, 25.29,
    26.53, 27.77, 29.01, 30.25, 31.49, 32.73, 33.98, 35.22, 36.46, 37.70, 38.94, 40.18, 41.42, 42.67, 43.91, 45.15};

BeamTable helios32() {
  BeamTable table{SensorMaker::kRoboSense,
                  "robosense-helios32",
                  "RoboSense RS-Helios-5515",
                  "rs_driver 4eeadace; RS-Helios-5515 user guide 3.0.1, tables 5 and 13",
                  {},
                  1800,
                  55'560.0,
                  true,
                  {0.03498, 0.0, false},
                  {0.0025, 0.01, 0.1, 180.0, 0.0}};
  for (std::size_t k = 0; k < kHeliosTimes_us.size(); ++k) {
    const std::size_t upper = kHeliosUpper_deg.size();
    const double elevation_deg =
        k < upper ? kHeliosUpper_deg[k] : kHeliosLowerTop_deg - kHeliosLowerStep_deg * static_cast<double>(k - upper);
    table.lasers.push_back({elevation_deg, 0.0, 0.0, 1e3 * kHeliosTimes_us[k], 0});
  }
  number_rings(&table.lasers);
  return table;
}

}  // namespace

const BeamTable& robosense_rs16() {
  static const BeamTable table = rs16();
  return table;
}

const BeamTable& robosense_helios32() {
  static const BeamTable table = helios32();
  return table;
}

}  // namespace pose_wall::tools
