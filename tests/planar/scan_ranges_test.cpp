// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/scan/beam_ranges.hpp"

#include <gtest/gtest.h>

#include "planar/scan_walls.hpp"

namespace {

using namespace pose_wall::test;
using pose_wall::planar::OrderStatistics;

TEST(ScanRanges, ExpectedOrderStatisticsAreThoseOfTheTables) {
  const OrderStatistics statistics;
  // Teichroew, Tables of expected values of order statistics, 1956: smallest of 1 to 3, second of 4, third of 8,
  // fourth of 16
  const std::pair<std::uint32_t, double> rows[] = {{1, 0.0},     {2, -0.5642}, {3, -0.8463},
                                                   {4, -0.2970}, {8, -0.4728}, {16, -0.7632}};
  for (const auto& [n, mean] : rows) EXPECT_NEAR(statistics.expected(n), mean, 0.03) << n;
  EXPECT_EQ(statistics.expected(1000), statistics.expected(64));
}

TEST(ScanRanges, FlatWallsAreRightWithinAMillimetreWhereTheMinimumIsShort) {
  for (const RingSensor& sensor : {kScanOs1, kScanVlp16}) {
    WallErrors errors;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) measure_walls(sensor, 0.0, seed, &errors);
    EXPECT_NEAR(errors.cells[0].ours.mean(), 0.0, 0.001) << sensor.name;
    EXPECT_NEAR(errors.cells[1].ours.mean(), 0.0, 0.0015) << sensor.name;
    EXPECT_LT(errors.cells[0].minimum.mean(), -0.01) << sensor.name;
    EXPECT_LT(errors.cells[0].ours.sd(), errors.cells[0].minimum.sd()) << sensor.name;
  }
}

TEST(ScanRanges, RoughRockKeepsItsNearFace) {
  WallErrors errors;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) measure_walls(kScanOs1, 0.03, seed, &errors);
  EXPECT_NEAR(errors.cells[0].ours.mean(), 0.0, 0.003);
  EXPECT_LT(errors.cells[0].from_mean.mean(), -0.01);
}

// A column of returns at this range and angle, evenly up the band.
void add_column(double range_m, double angle_rad, std::uint32_t count, Points* points) {
  for (std::uint32_t i = 0; i < count; ++i) {
    const double z = 0.3 + 1.4 * (i + 0.5) / count;
    points->push_back({static_cast<float>(range_m * std::cos(angle_rad)),
                       static_cast<float>(range_m * std::sin(angle_rad)), static_cast<float>(z - 1.5)});
  }
}

TEST(ScanRanges, NeighboursOfOneSurfaceAreJoinedAndOthersAreNot) {
  Points points;
  add_column(5.00, 0.0, 1, &points);
  add_column(5.02, 0.006, 1, &points);  // one surface
  add_column(3.00, 0.012, 1, &points);  // another
  add_column(3.00, 0.020, 1, &points);  // too far aside
  ScannerUnderTest scanner(config_with());
  const pose_wall_planar_floor floor = level_floor();
  scanner.process(cloud_of(points, 0), &floor);
  const float* const range_m = scanner.scan().range_m;
  const std::uint32_t first = scanner.beam_at(0.0), second = scanner.beam_at(0.006);
  EXPECT_NEAR(range_m[first + 3], 5.01, 0.003);
  EXPECT_EQ(scanner.view().returns[first], 1U);
  EXPECT_EQ(scanner.view().returns[first + 3], 0U);
  EXPECT_TRUE(std::isnan(range_m[second + 3]));
  EXPECT_EQ(scanner.scan().free_m[second + 3], 0.0F);
  EXPECT_TRUE(std::isnan(range_m[scanner.beam_at(0.016)]));
}

TEST(ScanRanges, JoiningGoesRoundTheEndOfTheTurn) {
  Points points;
  add_column(4.0, M_PI - 0.002, 3, &points);
  add_column(4.0, -M_PI + 0.002, 3, &points);
  ScannerUnderTest scanner(config_with());
  const pose_wall_planar_floor floor = level_floor();
  scanner.process(cloud_of(points, 0), &floor);
  EXPECT_NEAR(scanner.scan().range_m[0], 4.0, 0.05);
  EXPECT_NEAR(scanner.scan().range_m[scanner.scan().beams - 1], 4.0, 0.05);
}

TEST(ScanRanges, AReturnAloneIsAThingOrStandsApartAndIsNeverLost) {
  Points points;
  for (int i = -20; i <= 20; ++i) add_column(6.0, 0.006 * i, 9, &points);
  add_column(2.0, 0.0, 1, &points);  // a speck of dust
  const pose_wall_planar_floor floor = level_floor();
  for (const std::uint32_t alone : {POSE_WALL_PLANAR_ALONE_IS_THING, POSE_WALL_PLANAR_ALONE_IS_APART}) {
    pose_wall_planar_scanner_settings settings = scan_settings();
    settings.alone = alone;
    ScannerUnderTest scanner(config_with(), settings);
    scanner.process(cloud_of(points, 0), &floor);
    const std::uint32_t beam = scanner.beam_at(0.0);
    EXPECT_NEAR(scanner.view().alone_m[beam], 2.0, 1e-3);
    EXPECT_NEAR(scanner.scan().range_m[beam], alone == POSE_WALL_PLANAR_ALONE_IS_THING ? 2.0 : 6.0, 0.02);
    const float farther_m = alone == POSE_WALL_PLANAR_ALONE_IS_THING ? scanner.view().behind_m[beam] : 6.0F;
    EXPECT_NEAR(farther_m, 6.0, 0.02);
    EXPECT_EQ(scanner.view().returns[beam], alone == POSE_WALL_PLANAR_ALONE_IS_THING ? 1U : 9U);
    // either way nothing beyond it is clear
    EXPECT_FALSE(scanner.view().clear_m[beam] > 2.01F);
  }
}

TEST(ScanRanges, AThinThingBeforeAWallHasItsOwnCount) {
  Points points;
  add_column(6.0, 0.0, 20, &points);
  add_column(4.0, 0.0, 5, &points);
  ScannerUnderTest scanner(config_with());
  const pose_wall_planar_floor floor = level_floor();
  scanner.process(cloud_of(points, 0), &floor);
  const std::uint32_t beam = scanner.beam_at(0.0);
  EXPECT_EQ(scanner.view().returns[beam], 5U);
  EXPECT_NEAR(scanner.scan().range_m[beam], 4.0, 0.02);
  EXPECT_NEAR(scanner.view().behind_m[beam], 6.0, 0.02);
}

TEST(ScanRanges, WideBeamsOnASlantingWallAreMovedToTheirMiddle) {
  // a wall 2.5 m to the left; beams of 0.02 rad see 0.16 m of range at 8 m
  pose_wall_planar_scanner_settings settings = scan_settings();
  settings.angle_step_rad = 0.02;
  settings.fill_rad = 0.02;
  RoadScene road;
  road.noise_m = 0.005;
  pose_wall_config config = config_with();
  set(&config, "range_noise", 0.005);
  const SeenScene seen = see(road, kScanOs1, rays_of(kScanOs1, 1), 3);
  ScannerUnderTest scanner(config, settings);
  const pose_wall_planar_floor floor = level_floor();
  scanner.process(cloud_of(seen.points, 0), &floor);
  double sum_m = 0.0;
  int beams = 0;
  for (double angle_rad = 0.35; angle_rad < 0.9; angle_rad += 0.02, ++beams) {
    const std::uint32_t beam = scanner.beam_at(angle_rad);
    sum_m += static_cast<double>(scanner.scan().range_m[beam]) - 2.5 / std::sin(scanner.angle_of(beam));
  }
  EXPECT_NEAR(sum_m / beams, 0.0, 0.02);
}

}  // namespace
