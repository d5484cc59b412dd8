// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "pose_wall_planar_scan.h"

namespace {

const float kInfinite = std::numeric_limits<float>::infinity();

// As a driver of half a turn in steps of half a degree fills it in.
pose_wall_planar_laserscan half_turn(const std::vector<float>& ranges) {
  pose_wall_planar_laserscan message{};
  message.angle_min = static_cast<float>(-M_PI / 2.0);
  message.angle_max = static_cast<float>(M_PI / 2.0);
  message.angle_increment = static_cast<float>(M_PI / 360.0);
  message.range_min = 0.1F;
  message.range_max = 30.0F;
  message.count = static_cast<std::uint32_t>(ranges.size());
  message.ranges = ranges.data();
  return message;
}

std::int32_t scan_of_message(const pose_wall_planar_laserscan& message, std::uint32_t infinite_is_open, float* room,
                             pose_wall_planar_scan* scan) {
  const pose_wall_planar_pose sensor = {0.5, 0.0, 0.1};
  return pose_wall_planar_scan_of_laserscan(&message, &sensor, 0.02, 77, infinite_is_open, room, scan);
}

TEST(ScanLaserScan, InAndOutIsTheSameMessage) {
  const std::vector<float> ranges(361, 4.0F);
  const pose_wall_planar_laserscan message = half_turn(ranges);
  pose_wall_planar_scan scan{};
  ASSERT_EQ(scan_of_message(message, 1, nullptr, &scan), POSE_WALL_OK);
  EXPECT_EQ(scan.struct_size, sizeof(scan));
  EXPECT_EQ(scan.stamp_ns, 77);
  EXPECT_NEAR(scan.angle_min_rad + 360 * scan.angle_step_rad, M_PI / 2.0, 1e-7);
  EXPECT_EQ(scan.free_m, nullptr);
  EXPECT_EQ(scan.sensor.x_m, 0.5);
  pose_wall_planar_laserscan back{};
  ASSERT_EQ(pose_wall_planar_laserscan_of(&scan, &back), POSE_WALL_OK);
  EXPECT_EQ(back.angle_min, message.angle_min);
  EXPECT_EQ(back.angle_max, message.angle_max);
  EXPECT_EQ(back.angle_increment, message.angle_increment);
  EXPECT_EQ(back.range_min, message.range_min);
  EXPECT_EQ(back.range_max, message.range_max);
  EXPECT_EQ(back.count, message.count);
  EXPECT_EQ(back.ranges, message.ranges);
}

TEST(ScanLaserScan, AnEndThatIsNotTheLastBeamsMiddleIsNotUsed) {
  const std::vector<float> ranges(360, 4.0F);  // one beam fewer than the end says
  pose_wall_planar_scan scan{};
  ASSERT_EQ(scan_of_message(half_turn(ranges), 1, nullptr, &scan), POSE_WALL_OK);
  EXPECT_NEAR(scan.angle_step_rad, M_PI / 360.0, 1e-9);
}

TEST(ScanLaserScan, InfinityIsUnknownUnlessTheDriverMeansOpen) {
  std::vector<float> ranges(361, kInfinite), room(361, 0.0F);
  ranges[7] = 3.0F;
  pose_wall_planar_scan scan{};
  ASSERT_EQ(scan_of_message(half_turn(ranges), 0, room.data(), &scan), POSE_WALL_OK);
  EXPECT_EQ(scan.range_m, room.data());
  EXPECT_TRUE(std::isnan(scan.range_m[0]));
  EXPECT_EQ(scan.range_m[7], 3.0F);
  ASSERT_EQ(scan_of_message(half_turn(ranges), 1, nullptr, &scan), POSE_WALL_OK);
  EXPECT_EQ(scan.range_m[0], kInfinite);
}

TEST(ScanLaserScan, WhatIsNoScanIsRefused) {
  const std::vector<float> ranges(361, 4.0F);
  pose_wall_planar_scan scan{};
  const auto with = [&](auto change) {
    pose_wall_planar_laserscan message = half_turn(ranges);
    change(message);
    return scan_of_message(message, 1, nullptr, &scan);
  };
  EXPECT_EQ(with([](auto& m) { m.count = 0; }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& m) { m.count = 7000; }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& m) { m.angle_min = std::nanf(""); }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& m) { m.angle_increment = std::nanf(""); }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& m) { m.angle_increment = 0.0F, m.angle_max = m.angle_min; }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& m) { m.range_max = kInfinite; }), POSE_WALL_PLANAR_E_SCAN);
  EXPECT_EQ(with([](auto& m) { m.ranges = nullptr; }), POSE_WALL_E_NULL);
  EXPECT_EQ(scan_of_message(half_turn(ranges), 0, nullptr, &scan), POSE_WALL_E_NULL);
  EXPECT_EQ(scan.struct_size, 0U);
  EXPECT_EQ(pose_wall_planar_laserscan_of(nullptr, nullptr), POSE_WALL_E_NULL);
}

}  // namespace
