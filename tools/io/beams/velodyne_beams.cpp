// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <array>

#include "io/beams/beam_table.hpp"

namespace pose_wall::tools {
namespace {

// Nearest and farthest range of all: launch files of ros-drivers/velodyne, which has them from the maker.
constexpr double kVelodyneNearest_m = 0.4, kVelodyneFarthest_m = 130.0, kVlp32cFarthest_m = 200.0;

// Elevation and height of each laser: VLP-16 user manual, 63-9243.
constexpr std::array<std::array<double, 2>, 16> kPuck = {{{-15, 0.0112},
                                                          {1, -0.0007},
                                                          {-13, 0.0097},
                                                          {3, -0.0022},
                                                          {-11, 0.0081},
                                                          {5, -0.0037},
                                                          {-9, 0.0066},
                                                          {7, -0.0051},
                                                          {-7, 0.0051},
                                                          {9, -0.0066},
                                                          {-5, 0.0037},
                                                          {11, -0.0081},
                                                          {-3, 0.0022},
                                                          {13, -0.0097},
                                                          {-1, 0.0007},
                                                          {15, -0.0112}}};
constexpr double kHiResStep = 2.0 / 3.0;  // of 1 degree between the lasers of a Puck: 1.33 of 2

// HDL-32E user manual, 63-9113; the same figures stand in 32db.yaml of ros-drivers/velodyne.
constexpr std::array<double, 32> kHdl32e_deg = {-30.67, -9.33, -29.33, -8.00, -28.00, -6.67, -26.67, -5.33,
                                                -25.33, -4.00, -24.00, -2.67, -22.67, -1.33, -21.33, 0.00,
                                                -20.00, 1.33,  -18.67, 2.67,  -17.33, 4.00,  -16.00, 5.33,
                                                -14.67, 6.67,  -13.33, 8.00,  -12.00, 9.33,  -10.67, 10.67};

// Elevation and azimuth of each laser: VLP-32C user manual, 63-9325; VeloView-VLP-32C.yaml of ros-drivers/velodyne has
// the same figures, its azimuths with the other sign.
constexpr std::array<std::array<double, 2>, 32> kVlp32c = {
    {{-25, 1.4},     {-1, -4.2},    {-1.667, 1.4},  {-15.639, -1.4}, {-11.31, 1.4},  {0, -1.4},      {-0.667, 4.2},
     {-8.843, -1.4}, {-7.254, 1.4}, {0.333, -4.2},  {-0.333, 1.4},   {-6.148, -1.4}, {-5.333, 4.2},  {1.333, -1.4},
     {0.667, 4.2},   {-4, -1.4},    {-4.667, 1.4},  {1.667, -4.2},   {1, 1.4},       {-3.667, -4.2}, {-3.333, 4.2},
     {3.333, -1.4},  {2.333, 1.4},  {-2.667, -1.4}, {-3, 1.4},       {7, -1.4},      {4.667, 1.4},   {-2.333, -4.2},
     {-2, 4.2},      {15, -1.4},    {10.333, 1.4},  {-1.333, -1.4}}};

// Pucks fire one laser every 2.304 us, sixteen in 55.296 us; the table of times in their manual. Accuracy 3 cm and a
// beam of 0.18 degrees: the same.
BeamTable puck(bool hi_res) {
  BeamTable table{SensorMaker::kVelodyne,
                  hi_res ? "velodyne-vlp16-hires" : "velodyne-vlp16",
                  hi_res ? "Velodyne Puck Hi-Res" : "Velodyne VLP-16",
                  hi_res ? "VLP-16 user manual, 63-9243, two thirds of its angles" : "VLP-16 user manual, 63-9243",
                  {},
                  1800,
                  55'296.0,
                  true,
                  {},
                  {0.002, 0.015, kVelodyneNearest_m, kVelodyneFarthest_m, 0.18}};
  for (std::size_t i = 0; i < kPuck.size(); ++i) {
    table.lasers.push_back({kPuck[i][0] * (hi_res ? kHiResStep : 1.0), 0.0, hi_res ? 0.0 : kPuck[i][1],
                            static_cast<double>(i) * 2'304.0, 0});
  }
  number_rings(&table.lasers);
  return table;
}

// One laser every 1.152 us, and a pause of eight such times. Accuracy 2 cm.
BeamTable hdl32e() {
  BeamTable table{SensorMaker::kVelodyne,
                  "velodyne-hdl32e",
                  "Velodyne HDL-32E",
                  "HDL-32E user manual, 63-9113",
                  {},
                  2172,
                  46'080.0,
                  true,
                  {},
                  {0.002, 0.01, kVelodyneNearest_m, kVelodyneFarthest_m, 0.0}};
  for (std::size_t i = 0; i < kHdl32e_deg.size(); ++i) {
    table.lasers.push_back({kHdl32e_deg[i], 0.0, 0.0, static_cast<double>(i) * 1'152.0, 0});
  }
  number_rings(&table.lasers);
  return table;
}

// Two lasers at once every 2.304 us, sixteen pairs in 55.296 us. Accuracy 3 cm, a beam of 3 mrad.
BeamTable vlp32c() {
  BeamTable table{SensorMaker::kVelodyne,
                  "velodyne-vlp32c",
                  "Velodyne VLP-32C",
                  "VLP-32C user manual, 63-9325",
                  {},
                  1800,
                  55'296.0,
                  true,
                  {},
                  {0.004, 0.015, kVelodyneNearest_m, kVlp32cFarthest_m, 0.17}};
  for (std::size_t i = 0; i < kVlp32c.size(); ++i) {
    table.lasers.push_back({kVlp32c[i][0], kVlp32c[i][1], 0.0, static_cast<double>(i / 2) * 2'304.0, 0});
  }
  number_rings(&table.lasers);
  return table;
}

}  // namespace

const BeamTable& velodyne_vlp16() {
  static const BeamTable table = puck(false);
  return table;
}

const BeamTable& velodyne_vlp16_hires() {
  static const BeamTable table = puck(true);
  return table;
}

const BeamTable& velodyne_hdl32e() {
  static const BeamTable table = hdl32e();
  return table;
}

const BeamTable& velodyne_vlp32c() {
  static const BeamTable table = vlp32c();
  return table;
}

}  // namespace pose_wall::tools
