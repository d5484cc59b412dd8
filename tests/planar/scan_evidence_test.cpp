// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/scan/evidence.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/math/elementary.hpp"
#include "planar/scan_scenes.hpp"
#include "planar/scanner_under_test.hpp"
#include "support/engine_under_test.hpp"

namespace {

using namespace pose_wall::test;
using pose_wall::kPi;

struct Scanned {
  explicit Scanned(const Points& points, const pose_wall_planar_floor& floor = level_floor(),
                   const pose_wall_config& config = config_with(),
                   const pose_wall_planar_scanner_settings& settings = scan_settings())
      : scanner(config, settings) {
    scanner.process(cloud_of(points, 0), &floor);
  }
  float range_at(double angle_rad) const { return scanner.scan().range_m[scanner.beam_at(angle_rad)]; }
  float free_at(double angle_rad) const { return scanner.scan().free_m[scanner.beam_at(angle_rad)]; }
  const pose_wall_planar_scan_view& view() const { return scanner.view(); }

  ScannerUnderTest scanner;
};

TEST(ScanEvidence, ReturnsAreToldApartByTheirHeightAboveTheFloor) {
  // heights 0.02, 0.10, 0.5, 1.95 and 2.5 at 5 m, one direction each
  const float far = 5.0F;
  const Points points = {{far, 0, 0.02F - 1.5F},
                         {0, far, 0.10F - 1.5F},
                         {-far, 0.01F, 0.5F - 1.5F},
                         {0, -far, 1.95F - 1.5F},
                         {far, far, 2.5F - 1.5F}};
  const Scanned scanned(points);
  EXPECT_EQ(scanned.view().of_floor, 1U);
  EXPECT_EQ(scanned.view().of_low, 1U);
  EXPECT_EQ(scanned.view().of_band, 1U);
  EXPECT_EQ(scanned.view().of_overhead, 1U);
  EXPECT_EQ(scanned.view().of_roof, 1U);
  EXPECT_NEAR(scanned.range_at(std::atan2(0.01, -5.0)), 5.0, 1e-4);
  EXPECT_FALSE(std::isfinite(scanned.range_at(0.0)));
  EXPECT_NEAR(scanned.view().low_m[scanned.scanner.beam_at(kPi / 2)], 5.0, 1e-4);
  EXPECT_NEAR(scanned.view().overhead_m[scanned.scanner.beam_at(-kPi / 2)], 5.0, 1e-4);
  EXPECT_NEAR(scanned.view().sensor_height_m, 1.5, 1e-9);
  EXPECT_NEAR(scanned.view().min_height_m, -(1.5 - 0.25 + 0.1), 1e-9);
  EXPECT_NEAR(scanned.view().max_height_m, 1.8 - 1.5 + 0.1, 1e-9);
}

TEST(ScanEvidence, TheBandIsAboutTheFloorAndNotAboutTheAxesOfTheSensor) {
  // nose down by 10 degrees: a thing 8 m ahead, 0.5 m above the floor, and the floor itself
  const double pitch_rad = 0.1745;
  const Eigen::Matrix3d R = pose_wall::rotation_zyx(0.0, pitch_rad, 0.0);
  const auto in_sensor = [&](double x, double z) {
    const Eigen::Vector3f p = (R.transpose() * Eigen::Vector3d(x, 0.0, z - 1.5)).cast<float>();
    return std::array<float, 3>{p.x(), p.y(), p.z()};
  };
  pose_wall_planar_floor floor = level_floor();
  for (int i = 0; i < 3; ++i) floor.normal[i] = R(2, i);
  const Scanned scanned({in_sensor(8.0, 0.5), in_sensor(6.0, 0.0)}, floor);
  EXPECT_EQ(scanned.view().of_band, 1U);
  EXPECT_EQ(scanned.view().of_floor, 1U);
  EXPECT_NEAR(scanned.range_at(0.0), 8.0, 1e-3);
}

TEST(ScanEvidence, ARayProvesWhatItPassed) {
  // to the floor at 10 m: out of the band (0.15 m) at 9; to the roof of 3 m at 10 m: out (1.9 m) at 10 x 0.4 / 1.5
  const Points points = {{10, 0, -1.5F}, {0, 10, 1.5F}};
  const Scanned scanned(points);
  EXPECT_NEAR(scanned.free_at(0.0), 9.0, 1e-3);
  EXPECT_NEAR(scanned.free_at(kPi / 2), 10.0 * 0.4 / 1.5, 1e-3);
  EXPECT_EQ(scanned.free_at(kPi), 0.0F);
  for (std::uint32_t b = 0; b < scanned.scanner.scan().beams; ++b)
    EXPECT_TRUE(std::isnan(scanned.scanner.scan().range_m[b]));
}

TEST(ScanEvidence, OpenIsOnlyWhatWasSeenToItsEnd) {
  const Points points = {{29.0F, 0, 0}, {0, 31.0F, 0}};
  const Scanned scanned(points);
  EXPECT_NEAR(scanned.range_at(0.0), 29.0, 1e-3);
  EXPECT_EQ(scanned.range_at(kPi / 2), std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(scanned.range_at(kPi)));
}

TEST(ScanEvidence, AThingTooNearIsUnknownAndBlocksItsBeam) {
  pose_wall_planar_scanner_settings settings = scan_settings();
  settings.range_min_m = 1.0;
  const Scanned scanned({{0.7F, 0, 0}, {9.0F, 0.0F, -1.5F}}, level_floor(), config_with(), settings);
  EXPECT_TRUE(std::isnan(scanned.range_at(0.0)));
  EXPECT_LT(scanned.free_at(0.0), 0.75F);
}

TEST(ScanEvidence, TheBandShrinksBeyondTheReachOfTheFloor) {
  pose_wall_planar_floor floor = level_floor();
  floor.reach_m = 5.0;
  // at 15 m the ground may be 0.2 m higher: 0.3 m is low there, and in the band at 4 m
  const Scanned scanned({{15, 0, 0.3F - 1.5F}, {0, 4, 0.3F - 1.5F}, {-15, 0, 1.8F - 1.5F}}, floor);
  EXPECT_EQ(scanned.view().of_low, 1U);
  EXPECT_EQ(scanned.view().of_band, 1U);
  EXPECT_EQ(scanned.view().of_overhead, 1U);
  EXPECT_NEAR(scanned.view().low_m[scanned.scanner.beam_at(0.0)], 15.0, 1e-3);
  EXPECT_NEAR(scanned.view().overhead_m[scanned.scanner.beam_at(-kPi)], 15.0, 1e-3);
}

TEST(ScanEvidence, TheMachineItselfAndBadPointsAreLeftOut) {
  const float nan = std::nanf(""), infinite = std::numeric_limits<float>::infinity();
  pose_wall_config config = config_with();
  set(&config, "body_box_1", "-1 1 -0.6 0.6 -1.5 0.4");
  pose_wall_inputs inputs{};
  inputs.struct_size = sizeof(inputs);
  const double boom[6] = {1.0, 3.0, -0.3, 0.3, -1.0, 0.5};
  std::copy(boom, boom + 6, inputs.body_box[0]);
  const Points points = {{0.8F, 0.1F, 0}, {2.0F, 0, 0},    {nan, 1, 1},   {infinite, 0, 0}, {0, 0, 0},
                         {0.1F, 0, 0},    {5000.0F, 0, 0}, {1e30F, 0, 0}, {4.0F, 0, 0}};
  ScannerUnderTest scanner(config);
  pose_wall_cloud cloud = cloud_of(points, 0);
  cloud.inputs = &inputs;
  const pose_wall_planar_floor floor = level_floor();
  scanner.process(cloud, &floor);
  EXPECT_EQ(scanner.view().of_body, 2U);
  EXPECT_EQ(scanner.view().dropped, 6U);
  EXPECT_EQ(scanner.view().of_band, 1U);
  EXPECT_EQ(scanner.view().points_in, 9U);
  EXPECT_NEAR(scanner.scan().range_m[scanner.beam_at(0.0)], 4.0, 1e-4);
}

TEST(ScanEvidence, AnyLayoutOfTheCloudGivesTheSameScan) {
  RoadScene road;
  road.noise_m = 0.01;
  const SeenScene seen = see(road, kScanVlp16, rays_of(kScanVlp16, 1), 1);
  const pose_wall_planar_floor floor = level_floor();
  ScannerUnderTest plain(config_with()), other(config_with());
  plain.process(cloud_of(seen.points, 0), &floor);
  CloudLayout layout;
  layout.float64 = true;
  layout.big_endian = true;
  layout.offset = 3;
  layout.point_extra = 5;
  layout.rows = 2;
  layout.row_extra = 11;
  const Points whole(seen.points.begin(),
                     seen.points.begin() + static_cast<std::ptrdiff_t>(seen.points.size() / 2 * 2));
  plain.process(cloud_of(whole, 0), &floor);
  const EncodedCloud encoded = encode(whole, layout, 0);
  other.process(encoded.cloud, &floor);
  EXPECT_EQ(std::memcmp(plain.scan().range_m, other.scan().range_m, 4U * plain.scan().beams), 0);
  EXPECT_EQ(std::memcmp(plain.view().clear_m, other.view().clear_m, 4U * plain.scan().beams), 0);
}

TEST(ScanEvidence, DirectionsAreWithinAHundredthOfABeam) {
  SceneDraw draw(5);
  for (int i = 0; i < 20000; ++i) {
    const double angle_rad = draw.between(-kPi, kPi);
    const Points one = {
        {static_cast<float>(6.0 * std::cos(angle_rad)), static_cast<float>(6.0 * std::sin(angle_rad)), 0}};
    if (i >= 40) break;
    const Scanned scanned(one);
    const double place = (angle_rad + kPi) / 0.001 + 0.5, inside = place - std::floor(place);
    if (inside < 0.02 || inside > 0.98) continue;
    EXPECT_NEAR(scanned.scanner.scan().range_m[static_cast<std::uint32_t>(place)], 6.0, 1e-4) << angle_rad;
  }
}

TEST(ScanEvidence, MoreReturnsThanAreKeptStillCountForTheNearest) {
  Points points(POSE_WALL_PLANAR_SCAN_RETURNS, {8.0F, 0, 0});
  points.push_back({0, 3.0F, 0});
  const Scanned scanned(points);
  EXPECT_EQ(scanned.view().uncounted, 1U);
  EXPECT_NEAR(scanned.range_at(kPi / 2), 3.0, 1e-4);
  EXPECT_EQ(scanned.view().returns[scanned.scanner.beam_at(0.0)], 65535U);
}

}  // namespace
