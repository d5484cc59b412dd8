// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Lens, unit, nearest and farthest range: RoboSense's rs_driver, 4eeadace. Each sensor tells its own angles in its
// DIFOP packet; these are the design's. Accuracy 2 cm, of RS-LiDAR-32 and Bpearl 3 cm.

#include <array>
#include <cmath>

#include "io/beams/beam_table.hpp"

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

// Order and angles: ros_rslidar, 726eacca, data/rs_lidar_32/angle.csv, in thousandths of a degree as a device packet
// has them. Lasers 16 to 31 fire half a step after lasers 0 to 15.
constexpr std::array<std::array<double, 2>, 32> kRs32_deg = {
    {{-10.264, 9.121},  {0.297, -7.120},  {-6.406, 8.911},  {-0.018, -1.778}, {2.279, 9.121},    {-0.333, 3.572},
     {3.297, -6.838},   {-0.667, 8.786},  {4.614, 9.121},   {1.685, -7.156},  {7.018, -6.767},   {1.297, -1.814},
     {10.298, 9.051},   {1.000, 3.486},   {15.017, -6.944}, {0.703, 8.901},   {-25.000, -6.697}, {-2.279, -7.332},
     {-14.638, -6.661}, {-2.667, -2.000}, {-7.910, -6.767}, {-3.018, 3.393},  {-5.407, -6.838},  {-3.297, 8.806},
     {-3.649, -7.191},  {-1.018, -7.297}, {-4.053, -1.864}, {-1.333, -1.814}, {-4.386, 3.493},   {-1.631, 3.572},
     {-4.649, 8.806},   {-1.982, 8.731}}};

BeamTable rs32() {
  BeamTable table{SensorMaker::kRoboSense,
                  "robosense-rs32",
                  "RoboSense RS-LiDAR-32",
                  "rs_driver 4eeadace; angle.csv of ros_rslidar 726eacca",
                  {},
                  1800,
                  55'520.0,
                  true,
                  {0.03997, 0.0, false},
                  {0.005, 0.015, 0.4, 230.0, 0.0}};
  for (std::size_t k = 0; k < kRs32_deg.size(); ++k) {
    const std::size_t of_half = k % 16;
    const double first_ns = of_half == 15 ? 44'640.0 : 2'880.0 * static_cast<double>(of_half);
    table.lasers.push_back({kRs32_deg[k][0], kRs32_deg[k][1], 0.0, first_ns + (k < 16 ? 0.0 : 1'440.0), 0});
  }
  number_rings(&table.lasers);
  return table;
}

// Elevations: ros_rslidar, 726eacca, data/rs_bpearl/angle.csv; 2.8125 degrees apart, in hundredths as a device packet
// has them.
double bpearl_elevation_deg(int laser) {
  return 0.01 * std::round(100.0 * (89.5 - 2.8125 * laser));
}

// Times: rs_driver, with a pause after the eighth laser of each half.
BeamTable bpearl() {
  BeamTable table{SensorMaker::kRoboSense,
                  "robosense-bpearl",
                  "RoboSense RS-Bpearl",
                  "rs_driver 4eeadace; angle.csv of ros_rslidar 726eacca",
                  {},
                  1800,
                  55'520.0,
                  true,
                  {0.01473, 0.0, false},
                  {0.005, 0.015, 0.1, 150.0, 0.0}};
  constexpr double kUp_m = 0.09427;
  for (int k = 0; k < 32; ++k) {
    const double elevation_deg = bpearl_elevation_deg(k);
    const double first_ns = 2'560.0 * (k % 16) + (k % 16 < 8 ? 0.0 : 5'200.0);
    table.lasers.push_back({elevation_deg, 0.0, kUp_m, first_ns + (k < 16 ? 0.0 : 1'280.0), 0});
  }
  number_rings(&table.lasers);
  return table;
}

// A second design: another lens, half the unit, and lasers one after another. Its angles were not at hand; here they
// are those of the first.
BeamTable bpearl4() {
  BeamTable table{SensorMaker::kRoboSense,
                  "robosense-bpearl4",
                  "RoboSense RS-Bpearl 4",
                  "rs_driver 4eeadace; angles of the first Bpearl",
                  {},
                  1800,
                  55'560.0,
                  true,
                  {0.01619, 0.0, false},
                  {0.0025, 0.015, 0.1, 150.0, 0.0}};
  constexpr double kUp_m = 0.09571;
  for (int k = 0; k < 32; ++k) table.lasers.push_back({bpearl_elevation_deg(k), 0.0, kUp_m, 1'668.0 * k, 0});
  number_rings(&table.lasers);
  return table;
}

// Angles are about those in the device packet of an Airy (Perception4D/robosenseplugin, 88a43c24): elevations from 0.81
// to 89.39 in even steps, azimuths of each twelve lasers those of the first. Times: rs_driver, normal installation. No
// sheet was at hand: its noise is judgement, 2026-11-29.
constexpr std::array<double, 12> kAiryTimes_us = {0.0,    5.712,  12.376, 19.04,  25.704, 33.32,
                                                  41.888, 50.456, 59.024, 70.448, 81.872, 93.296};
constexpr std::array<double, 8> kAiryBeside_deg = {-1.63, 1.30, -1.81, 1.59, -2.47, 2.14, -5.05, 4.73};

BeamTable airy() {
  BeamTable table{SensorMaker::kRoboSense,
                  "robosense-airy",
                  "RoboSense Airy",
                  "rs_driver 4eeadace; about the angles of one Airy",
                  {},
                  900,
                  111'080.0,
                  true,
                  {0.010017, 0.0, false},
                  {0.005, 0.01, 0.1, 60.0, 0.0}};
  constexpr double kUp_m = 0.04532, kLowest_deg = 0.81, kHighest_deg = 89.39;
  for (std::size_t k = 0; k < 96; ++k) {
    const double elevation_deg = kLowest_deg + (kHighest_deg - kLowest_deg) * static_cast<double>(k) / 95.0;
    table.lasers.push_back(
        {0.01 * std::round(100.0 * elevation_deg), kAiryBeside_deg[k / 12], kUp_m, 1e3 * kAiryTimes_us[k / 8], 0});
  }
  number_rings(&table.lasers);
  return table;
}

// Elevations from the top: RS-Helios-5515 user guide 3.0.1, table 5. Its horizontal offsets were not at hand: none
// here. Times: rs_driver, where the maker mended those of the guide on 2024-03-29 (2813880).
constexpr std::array<double, 16> kHeliosUpper_deg = {15.0, 13.0, 11.0,  9.0,   7.0,  5.5,   4.0,   2.67,
                                                     1.33, 0.0,  -1.33, -2.67, -4.0, -5.33, -6.67, -8.0};
constexpr double kHeliosLowerTop_deg = -10.0, kHeliosLowerStep_deg = 3.0;  // down to -55
constexpr std::size_t kHeliosLasers = 32, kHelios16pLasers = 16;
constexpr double kHeliosLaser_ns = 1'730.0;

BeamTable helios32() {
  BeamTable table{SensorMaker::kRoboSense,
                  "robosense-helios32",
                  "RoboSense RS-Helios-5515",
                  "rs_driver 4eeadace; RS-Helios-5515 user guide 3.0.1, table 5",
                  {},
                  1800,
                  55'560.0,
                  true,
                  {0.03498, 0.0, false},
                  {0.0025, 0.01, 0.1, 180.0, 0.0}};
  for (std::size_t k = 0; k < kHeliosLasers; ++k) {
    const std::size_t upper = kHeliosUpper_deg.size();
    const double elevation_deg =
        k < upper ? kHeliosUpper_deg[k] : kHeliosLowerTop_deg - kHeliosLowerStep_deg * static_cast<double>(k - upper);
    table.lasers.push_back({elevation_deg, 0.0, 0.0, kHeliosLaser_ns * static_cast<double>(k), 0});
  }
  number_rings(&table.lasers);
  return table;
}

// Lasers of a Helios, two firings in a block. Its view is 15 degrees up and down (RS-Helios-16P user guide); the order
// of its lasers was not at hand: here from the top.
BeamTable helios16p() {
  BeamTable table = helios32();
  table.word = "robosense-helios16p";
  table.title = "RoboSense RS-Helios-16P";
  table.source = "rs_driver 4eeadace; view of its user guide";
  table.lasers.resize(kHelios16pLasers);
  for (std::size_t k = 0; k < kHelios16pLasers; ++k) {
    table.lasers[k].elevation_deg = 15.0 - 2.0 * static_cast<double>(k);
  }
  number_rings(&table.lasers);
  return table;
}

}  // namespace

const BeamTable& robosense_rs16() {
  static const BeamTable table = rs16();
  return table;
}

const BeamTable& robosense_rs32() {
  static const BeamTable table = rs32();
  return table;
}

const BeamTable& robosense_bpearl() {
  static const BeamTable table = bpearl();
  return table;
}

const BeamTable& robosense_bpearl4() {
  static const BeamTable table = bpearl4();
  return table;
}

const BeamTable& robosense_airy() {
  static const BeamTable table = airy();
  return table;
}

const BeamTable& robosense_helios32() {
  static const BeamTable table = helios32();
  return table;
}

const BeamTable& robosense_helios16p() {
  static const BeamTable table = helios16p();
  return table;
}

}  // namespace pose_wall::tools
