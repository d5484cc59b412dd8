// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what a driver or a network delivers anew under new stamps is never taken for now. A ring of up to 64 old
// clouds, and the old points that lost packets leave in a sector, give no valid value and no measured travel. Both
// parts say why, and go on as soon as fresh clouds come.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "pose_wall_motion.h"
#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"
#include "support/motion_under_test.hpp"
#include "support/room.hpp"

namespace pose_wall::test {
namespace {

constexpr std::int64_t kFrame_ns = 100000000;

int valid_values(const pose_wall_result& result) {
  int valid = 0;
  for (const pose_wall_value& v : result.quantity) valid += v.state == POSE_WALL_VALID ? 1 : 0;
  return valid;
}

bool is_frozen(const pose_wall_result& result) {
  return (result.frame_reasons & POSE_WALL_R_FROZEN) != 0;
}

// The points of `now`, but in a sector those of `old`.
Points partly_old(const Points& now, const Points& old, double from_deg, double width_deg) {
  const auto is_in = [&](const std::array<float, 3>& p) {
    const double deg = std::atan2(static_cast<double>(p[1]), static_cast<double>(p[0])) * 180.0 / M_PI;
    return std::fmod(deg - from_deg + 720.0, 360.0) < width_deg;
  };
  Points out;
  for (const auto& p : now) {
    if (!is_in(p)) out.push_back(p);
  }
  for (const auto& p : old) {
    if (is_in(p)) out.push_back(p);
  }
  return out;
}

TEST(FreshnessOfTheEngine, NoRingOfOldCloudsHasAValidValue) {
  for (const std::uint32_t ring : {1U, 2U, 5U, 12U, 64U}) {
    EngineUnderTest engine(small_config());
    std::vector<Points> clouds;
    for (std::uint32_t k = 0; k < ring; ++k) clouds.push_back(room_points(k + 1));
    std::int64_t stamp_ns = 0;
    const auto next = [&](const Points& points) { return engine.process(cloud_of(points, stamp_ns += kFrame_ns)); };
    for (const Points& points : clouds) EXPECT_FALSE(is_frozen(next(points)));
    for (std::uint32_t k = 0; k < ring + 3; ++k) {
      const pose_wall_result result = next(clouds[k % ring]);
      EXPECT_TRUE(is_frozen(result)) << ring << " clouds, repeat " << k;
      EXPECT_EQ(valid_values(result), 0) << ring << " clouds, repeat " << k;
    }
    pose_wall_result fresh{};
    for (std::uint32_t k = 0; k < 4; ++k) fresh = next(room_points(100 + k));
    EXPECT_FALSE(is_frozen(fresh));
    EXPECT_EQ(valid_values(fresh), POSE_WALL_QUANTITIES);
  }
}

// The machine goes sideways, and a wall stays where it was.
TEST(FreshnessOfTheEngine, APartThatStaysOldLeavesNoValidValue) {
  for (const double width_deg : {10.0, 45.0, 180.0}) {
    for (const double from_deg : {0.0, 37.0, 300.0}) {
      EngineUnderTest engine(small_config());
      std::int64_t stamp_ns = 0;
      const Points old = room_points(1);
      for (std::uint32_t k = 0; k < 3; ++k) {
        const Points first = k == 2 ? old : room_points(50 + k);
        EXPECT_FALSE(is_frozen(engine.process(cloud_of(first, stamp_ns += kFrame_ns))));
      }
      for (std::uint32_t k = 1; k < 20; ++k) {
        const Points points = partly_old(room_points(1 + k, 0.02 * k), old, from_deg, width_deg);
        const pose_wall_result result = engine.process(cloud_of(points, stamp_ns += kFrame_ns));
        ASSERT_TRUE(is_frozen(result)) << width_deg << " degrees from " << from_deg << ", frame " << k;
        ASSERT_EQ(valid_values(result), 0) << width_deg << " degrees from " << from_deg << ", frame " << k;
      }
    }
  }
}

TEST(FreshnessOfMotion, WhatComesAgainIsNeverMeasured) {
  for (const std::uint32_t ring : {1U, 2U, 5U, 64U}) {
    MotionUnderTest motion(small_config());
    std::vector<Points> clouds;
    for (std::uint32_t k = 0; k < ring; ++k) clouds.push_back(ribbed_room_points(k + 1));
    std::int64_t stamp_ns = 0;
    const auto next = [&](const Points& points) { return motion.process(cloud_of(points, stamp_ns += kFrame_ns)); };
    for (const Points& points : clouds) EXPECT_EQ(next(points).reasons & POSE_WALL_MOTION_R_REPEATED, 0U);
    for (std::uint32_t k = 0; k < 5; ++k) {
      const pose_wall_motion_result result = next(clouds[k % ring]);
      EXPECT_NE(result.reasons & POSE_WALL_MOTION_R_REPEATED, 0U) << ring << " clouds, repeat " << k;
      EXPECT_EQ(result.along_state, static_cast<std::uint32_t>(POSE_WALL_ALONG_LOST));
      EXPECT_TRUE(std::isnan(result.along_m));
    }
    pose_wall_motion_result fresh{};
    for (std::uint32_t k = 0; k < 4; ++k) fresh = next(ribbed_room_points(100 + k));
    EXPECT_EQ(fresh.reasons & POSE_WALL_MOTION_R_REPEATED, 0U);
    EXPECT_NE(fresh.along_state, static_cast<std::uint32_t>(POSE_WALL_ALONG_LOST)) << ring;
    EXPECT_TRUE(std::isfinite(fresh.along_m));
  }
}

TEST(FreshnessOfMotion, APartThatStaysOldIsNeverMeasured) {
  MotionUnderTest motion(small_config());
  const Points old = ribbed_room_points(1);
  std::int64_t stamp_ns = 0;
  motion.process(cloud_of(old, stamp_ns += kFrame_ns));
  for (std::uint32_t k = 1; k < 10; ++k) {
    const Points points = partly_old(ribbed_room_points(1 + k), old, 80.0, 20.0);
    const pose_wall_motion_result result = motion.process(cloud_of(points, stamp_ns += kFrame_ns));
    EXPECT_NE(result.reasons & POSE_WALL_MOTION_R_REPEATED, 0U) << k;
    EXPECT_EQ(result.along_state, static_cast<std::uint32_t>(POSE_WALL_ALONG_LOST));
  }
}

// The boom is no rock.
TEST(FreshnessOfMotion, WhatAFrameTellsOfTheMachineIsNotUsed) {
  MotionUnderTest whole(small_config()), without(small_config());
  const Points points = ribbed_room_points(1);
  pose_wall_inputs inputs{};
  inputs.struct_size = sizeof inputs;
  const double box_m[6] = {1.0, 6.0, -3.0, 3.0, -2.0, 2.0};
  std::copy_n(box_m, 6, inputs.body_box[0]);
  pose_wall_cloud cloud = cloud_of(points, kFrame_ns);
  const pose_wall_motion_result all = whole.process(cloud);
  cloud.inputs = &inputs;
  const pose_wall_motion_result fewer = without.process(cloud);
  EXPECT_LT(fewer.points_used, 0.8 * all.points_used);
  EXPECT_GT(fewer.points_used, 0.2 * all.points_used);
}

}  // namespace
}  // namespace pose_wall::test
