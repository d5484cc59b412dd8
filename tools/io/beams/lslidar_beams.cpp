// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The light of an LSLidar leaves beside the head's azimuth. Lens, unit, order of lasers: the maker's
// Lslidar_ROS1_driver, f29e947a. 32 equal steps of azimuth from block to block, which is 100 us with two firings.
// Accuracy 3 cm. The driver calls azimuth 0 its y; here it is x, as everywhere.

#include "io/beams/beam_table.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kC16Firing_ns = 50'000.0, kC16Laser_ns = kC16Firing_ns / 16.0;
constexpr std::uint32_t kC16Columns = 1992;                    // of 2,000 those that fill packets of 24
constexpr double kC16Nearest_m = 0.3, kC16Farthest_m = 150.0;  // judgement, 2026-11-28: no sheet was at hand

// Lasers of the lower and of the upper half in turn, two degrees apart in each.
BeamTable c16(const char* word, const char* title, double lowest_deg, const Lens& lens, double unit_m) {
  BeamTable table{SensorMaker::kLslidar,
                  word,
                  title,
                  "Lslidar_ROS1_driver f29e947a",
                  {},
                  kC16Columns,
                  kC16Firing_ns,
                  true,
                  lens,
                  {unit_m, 0.015, kC16Nearest_m, kC16Farthest_m, 0.0}};
  for (int k = 0; k < 16; ++k) {
    table.lasers.push_back({lowest_deg + (k / 2) * 2.0 + (k % 2) * 16.0, 0.0, 0.0, kC16Laser_ns * k, 0});
  }
  number_rings(&table.lasers);
  return table;
}

}  // namespace

const BeamTable& lslidar_c16_v3() {
  static const BeamTable table =
      c16("lslidar-c16-v3", "LSLidar C16, firmware 3", -15.0, {0.0431, -14.68, false}, 0.0025);
  return table;
}

const BeamTable& lslidar_c16_v4() {
  static const BeamTable table =
      c16("lslidar-c16-v4", "LSLidar C16, firmware 4", -16.0, {0.0361, -20.25, false}, 0.004);
  return table;
}

}  // namespace pose_wall::tools
