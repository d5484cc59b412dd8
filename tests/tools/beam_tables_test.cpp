// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the tables of beams hold what the makers' documents say where these can be worked out by hand, and nothing
// that contradicts itself. Decoders of these tables are looked at in velodyne_models_test, hesai_test and packets_test.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "io/beams/beam_table.hpp"

namespace pose_wall::tools {
namespace {

TEST(BeamTables, EachIsNamedSourcedAndSound) {
  std::set<std::string> words, titles;
  for (const BeamTable* const table : beam_tables()) {
    EXPECT_TRUE(words.insert(table->word).second) << table->word;
    EXPECT_TRUE(titles.insert(table->title).second) << table->title;
    EXPECT_FALSE(table->source.empty()) << table->word;
    EXPECT_NEAR(table->columns * table->cycle_ns, 1e8, 1e6) << table->word << ": a turn of 0.1 s, to a hundredth";
    EXPECT_GT(table->ranges.unit_m, 0.0) << table->word;
    EXPECT_GE(table->ranges.noise_m, table->ranges.unit_m) << table->word;
    EXPECT_LT(table->ranges.min_m, table->ranges.max_m) << table->word;
    std::set<std::uint16_t> rings;
    for (const Laser& laser : table->lasers) {
      EXPECT_TRUE(rings.insert(laser.ring).second) << table->word << " has two of ring " << laser.ring;
      EXPECT_GE(laser.after_ns, 0.0) << table->word;
      EXPECT_LT(laser.after_ns, table->cycle_ns) << table->word;
      for (const Laser& other : table->lasers) {
        EXPECT_TRUE(laser.ring >= other.ring || laser.elevation_deg <= other.elevation_deg) << table->word;
      }
    }
    EXPECT_EQ(*rings.rbegin() + 1U, table->lasers.size()) << table->word;
  }
}

double highest_up_m(const BeamTable& table) {
  double up_m = 0.0;
  for (const Laser& laser : table.lasers) up_m = std::max(up_m, laser.up_m);
  return up_m;
}

// Velodyne 63-9243: the lowest laser of a VLP-16 leaves 11.2 mm above the origin, the highest as much below it.
TEST(BeamTables, APucksLasersCrossInFrontOfIt) {
  const BeamTable& puck = velodyne_vlp16();
  for (const Laser& laser : puck.lasers) {
    EXPECT_LT(laser.up_m * laser.elevation_deg, 0.0);
    const Laser& mirrored = *std::find_if(puck.lasers.begin(), puck.lasers.end(), [&](const Laser& other) {
      return other.elevation_deg == -laser.elevation_deg;
    });
    EXPECT_EQ(mirrored.up_m, -laser.up_m);
  }
  EXPECT_EQ(highest_up_m(puck), 0.0112);
  EXPECT_EQ(puck.lasers[15].after_ns, 34'560.0);
  EXPECT_EQ(velodyne_vlp32c().lasers[31].after_ns, 34'560.0) << "pairs";
  EXPECT_EQ(velodyne_hdl32e().lasers[31].after_ns, 35'712.0);
}

TEST(BeamTables, RevisionsOfAnOusterDifferInTheirBeamOrigin) {
  const std::pair<const BeamTable*, double> origins_mm[] = {
      {&ouster_os0_128(), 27.67},      {&ouster_os0_128_rev7(), 27.116}, {&ouster_os1_64_gen1(), 12.163},
      {&ouster_os1_64(), 15.806},      {&ouster_os1_64_rev7(), 16.721},  {&ouster_os2_128(), 13.762},
      {&ouster_os2_128_rev7(), 27.397}};
  for (const auto& [table, out_mm] : origins_mm) {
    EXPECT_DOUBLE_EQ(1e3 * table->lens.out_m, out_mm) << table->word;
    EXPECT_EQ(table->ahead_m(), table->lens.out_m) << table->word;
    EXPECT_NE(table->source.find(std::to_string(static_cast<int>(out_mm))), std::string::npos) << table->source;
  }
  EXPECT_EQ(ouster_os1_64().lasers.size(), 64U);
  EXPECT_EQ(ouster_os0_128().lasers.size(), 128U);
}

// In turn four columns of lasers look aside: both ways alike.
TEST(BeamTables, AnOustersRowsAreTheirMirrorImage) {
  const std::vector<Laser>& os0 = ouster_os0_128().lasers;
  for (std::size_t i = 0; i < 64; ++i) {
    EXPECT_EQ(os0[i].elevation_deg, -os0[127 - i].elevation_deg);
    EXPECT_EQ(os0[i].azimuth_deg, -os0[127 - i].azimuth_deg);
  }
  // Every second row of an OS1-128: the two inner and outer columns of one side of the head each.
  const std::vector<Laser>& os1 = ouster_os1_64().lasers;
  EXPECT_EQ(os1.front().elevation_deg, 21.1679);
  EXPECT_EQ(os1.back().elevation_deg, -21.4764);
  EXPECT_EQ(os1.front().azimuth_deg, 1.4197);
  EXPECT_EQ(os1.back().azimuth_deg, -4.2521);
  EXPECT_NEAR(ouster_os1_64_gen1().lasers[1].elevation_deg, 16.084, 1e-9) << "the SDK's design value";
  EXPECT_NEAR(ouster_os1_64_gen1().lasers[62].elevation_deg, -16.084, 1e-9);
}

// rs_driver: 38.25 and 34.98 mm along the azimuth. Lslidar_ROS1_driver: 43.1 and 36.1 mm behind it.
TEST(BeamTables, LensesOfRoboSenseAndLslidarStandOffTheAxis) {
  EXPECT_EQ(robosense_rs16().lens.out_m, 0.03825);
  EXPECT_EQ(robosense_helios32().lens.out_m, 0.03498);
  EXPECT_EQ(robosense_helios32().lasers.back().elevation_deg, -55.0);
  EXPECT_EQ(beam_table("lslidar-c16-v3").lens.out_m, 0.0431);
  EXPECT_EQ(beam_table("lslidar-c16-v4").lens.out_m, 0.0361);
  EXPECT_EQ(beam_table("lslidar-c16-v3").highest_deg(), 15.0);
  EXPECT_EQ(beam_table("lslidar-c16-v4").lowest_deg(), -16.0) << "firmware 4 is not symmetric";
  EXPECT_EQ(beam_table("lslidar-c16-v4").highest_deg(), 14.0);
  for (const BeamTable* const table : {&beam_table("lslidar-c16-v3"), &beam_table("lslidar-c16-v4")}) {
    EXPECT_LT(table->lens.azimuth_deg, 0.0) << table->word;
    EXPECT_EQ(table->ahead_m(), 0.0) << table->word << ": its ranges begin at the lens";
  }
}

TEST(BeamTables, ALaserTurnsOnWhileOthersFireWhereItsMakerCountsSo) {
  const LaserRay last = laser_ray(velodyne_vlp16(), velodyne_vlp16().lasers[15], 0, 1800);
  EXPECT_NEAR(std::atan2(last.direction[1], last.direction[0]) * 180.0 / M_PI, -0.2 * 34.56 / 55.296, 1e-12);
  const LaserRay xt = laser_ray(hesai_xt32(), hesai_xt32().lasers[31], 500, 2000);
  EXPECT_NEAR(xt.direction[0], 0.0, 1e-12) << "a quarter turn to the right, whenever it fires";
  EXPECT_NEAR(xt.direction[1], -std::cos(16.0 * M_PI / 180.0), 1e-12);
}

}  // namespace
}  // namespace pose_wall::tools
