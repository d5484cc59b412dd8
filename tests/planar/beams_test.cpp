// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "place/beams.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/math/elementary.hpp"

namespace {

using pose_wall::kPi;
using pose_wall::Span;
using namespace pose_wall::planar;

pose_wall_planar_scan quarter(const std::vector<float>& ranges) {
  pose_wall_planar_scan scan{};
  scan.struct_size = sizeof(scan);
  scan.beams = static_cast<std::uint32_t>(ranges.size());
  scan.sensor = {1.0, 2.0, kPi / 2.0};
  scan.angle_step_rad = kPi / 2.0;
  scan.range_min_m = 0.5;
  scan.range_max_m = 20.0;
  scan.sigma_m = 0.02;
  scan.range_m = ranges.data();
  return scan;
}

TEST(Beams, AThingLiesWhereTheSensorSawItInBase) {
  const std::vector<float> ranges = {3.0F, 4.0F};
  std::vector<Beam> room(POSE_WALL_PLANAR_BEAMS_MAX);
  const BeamScan beams = read_beams(quarter(ranges), Span<Beam>(room.data(), POSE_WALL_PLANAR_BEAMS_MAX));
  ASSERT_EQ(beams.beams.size(), 2U);
  EXPECT_NEAR(beams.end_m(beams.beams[0]).x(), 1.0, 1e-6);
  EXPECT_NEAR(beams.end_m(beams.beams[0]).y(), 5.0, 1e-6);
  EXPECT_NEAR(beams.end_m(beams.beams[1]).x(), -3.0, 1e-6);
  EXPECT_NEAR(beams.end_m(beams.beams[1]).y(), 2.0, 1e-6);
}

TEST(Beams, OnlyInfinityIsOpenAndAllElseOutsideTheLimitsIsUnknown) {
  const float infinite = std::numeric_limits<float>::infinity(), nan = std::nanf("");
  const std::vector<float> ranges = {infinite, -infinite, nan, 0.0F};
  const std::vector<float> outside = {0.4F, 20.5F, -1.0F, 20.0F};
  std::vector<Beam> room(POSE_WALL_PLANAR_BEAMS_MAX);
  const Span<Beam> span(room.data(), POSE_WALL_PLANAR_BEAMS_MAX);
  const BeamScan first = read_beams(quarter(ranges), span);
  EXPECT_EQ(first.beams[0].end, BeamEnd::open);
  EXPECT_FLOAT_EQ(first.beams[0].range_m, 20.0F);
  for (std::uint32_t k = 1; k < 4; ++k) EXPECT_EQ(first.beams[k].end, BeamEnd::unknown) << k;
  const BeamScan second = read_beams(quarter(outside), span);
  for (std::uint32_t k = 0; k < 3; ++k) EXPECT_EQ(second.beams[k].end, BeamEnd::unknown) << k;
  EXPECT_EQ(second.beams[3].end, BeamEnd::thing);
}

TEST(Beams, ABeamWithoutARangeIsFreeAsFarAsItWasSeenToBe) {
  const float nan = std::nanf("");
  const std::vector<float> ranges = {nan, nan, 5.0F, nan}, free = {3.0F, 0.0F, 5.0F, 90.0F};
  std::vector<Beam> room(POSE_WALL_PLANAR_BEAMS_MAX);
  const Span<Beam> span(room.data(), POSE_WALL_PLANAR_BEAMS_MAX);
  pose_wall_planar_scan scan = quarter(ranges);
  scan.free_m = free.data();
  const BeamScan beams = read_beams(scan, span);
  EXPECT_EQ(beams.beams[0].end, BeamEnd::open);
  EXPECT_FLOAT_EQ(beams.beams[0].range_m, 3.0F);
  EXPECT_EQ(beams.beams[1].end, BeamEnd::unknown);
  EXPECT_EQ(beams.beams[2].end, BeamEnd::thing);
  EXPECT_FLOAT_EQ(beams.beams[3].range_m, 20.0F);
  scan.struct_size = offsetof(pose_wall_planar_scan, free_m);  // of a caller that knows nothing of it
  EXPECT_EQ(check_scan(&scan), POSE_WALL_OK);
  EXPECT_EQ(read_beams(scan, span).beams[0].end, BeamEnd::unknown);
}

TEST(Beams, AScanOutsideItsLimitsIsRefused) {
  const std::vector<float> ranges = {3.0F, 4.0F};
  const auto with = [&](auto change) {
    pose_wall_planar_scan scan = quarter(ranges);
    change(scan);
    return check_scan(&scan);
  };
  EXPECT_EQ(with([](auto&) {}), POSE_WALL_OK);
  EXPECT_EQ(check_scan(nullptr), POSE_WALL_E_NULL);
  EXPECT_EQ(with([](auto& s) { s.struct_size -= 16; }), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(with([](auto& s) { s.range_m = nullptr; }), POSE_WALL_E_NULL);
  EXPECT_EQ(with([](auto& s) { s.beams = 0; }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& s) { s.beams = POSE_WALL_PLANAR_BEAMS_MAX + 1; }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& s) { s.angle_step_rad = 0.0; }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& s) { s.angle_step_rad = 7.0; }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& s) { s.angle_step_rad = std::nan(""); }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& s) { s.angle_min_rad = std::nan(""); }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& s) { s.range_max_m = 0.5; }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& s) { s.range_max_m = std::nan(""); }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& s) { s.sigma_m = 0.0; }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& s) { s.sensor.yaw_rad = std::nan(""); }), POSE_WALL_PLANAR_E_SCAN);
}

}  // namespace
