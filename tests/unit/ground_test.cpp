// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the floor is found below a level or tilted machine, near or only far away, and neither roof nor bench nor
// heap nor reflection is taken for it without a word.

#include "stages/ground.hpp"

#include <gtest/gtest.h>

#include "support/ground_fixture.hpp"

namespace pose_wall {
namespace {

using test::GroundFixture;

// 2000 points of 5 mm over 3 m around: 0.1 mrad; ten times that.
constexpr double kAngle_rad = 0.001;
constexpr double kHeight_m = 0.002;

void expect_floor(const FloorResult& f, double roll, double pitch) {
  ASSERT_TRUE(f.fit.found && !f.fit.refused);
  const RollPitch angles = roll_pitch_of_up(f.fit.plane.n);
  EXPECT_NEAR(angles.roll_rad, roll, kAngle_rad);
  EXPECT_NEAR(angles.pitch_rad, pitch, kAngle_rad);
  EXPECT_NEAR(f.fit.plane.d, test::kFloorBelow_m, kHeight_m);
  EXPECT_LT(std::fabs(angles.roll_rad - roll), 5.0 * f.roll_sigma_rad + f.roll_bound_rad + 5e-5);
  EXPECT_LT(std::fabs(angles.pitch_rad - pitch), 5.0 * f.pitch_sigma_rad + f.pitch_bound_rad + 5e-5);
}

TEST(Ground, LevelAndTilted) {
  for (const double roll : {-0.35, 0.0, 0.2}) {
    for (const double pitch : {-0.26, 0.0, 0.35}) {
      GroundFixture g;
      g.tilt(roll, pitch);
      g.add_road();
      expect_floor(g.floor(), roll, pitch);
    }
  }
}

TEST(Ground, TheLowSideOfATiltedMachineIsNotTheWholeFloor) {
  GroundFixture g;
  g.tilt(0.3, 0.0);
  g.add_road();
  const FloorResult f = g.floor();
  EXPECT_GT(f.area_m2, 15.0);
  EXPECT_GT(f.fit.inliers, 1500U);
}

TEST(Ground, OnlySeenFarAway) {
  GroundFixture g({{"ground_inlier_min", "300"}});
  g.add_level({4.0, 9.0, -2.5, 2.5}, 0.0);
  g.add_level({-9.0, -4.0, -2.5, 2.5}, 0.0);
  g.add_wall(2.5);
  g.add_wall(-2.5);
  const FloorResult f = g.floor();
  expect_floor(f, 0.0, 0.0);
  EXPECT_GT(f.roi_radius_m, 3.0);
}

TEST(Ground, NothingOrNoFloorIsRefused) {
  GroundFixture empty;
  EXPECT_TRUE(empty.floor().fit.refused);
  EXPECT_NE(empty.floor().fit.reasons, 0U);
  GroundFixture roof;
  roof.add_level({-8, 8, -2.5, 2.5}, 3.2);
  EXPECT_TRUE(roof.floor().fit.refused) << "a roof alone";
  GroundFixture walls;
  walls.add_level({-8, 8, -2.5, 2.5}, 3.2);
  walls.add_wall(2.5);
  walls.add_wall(-2.5);
  EXPECT_TRUE(walls.floor().fit.refused) << "walls and roof, no floor";
}

TEST(Ground, OneLineOnTheFloorIsNoFloor) {
  GroundFixture g({{"ground_inlier_min", "20"}});
  for (double y = -2.5; y <= 2.5; y += 0.002) g.add(3.0 + 0.0004 * std::sin(99 * y), y, 0.0);
  EXPECT_TRUE(g.floor().fit.refused);
}

TEST(Ground, FewPointsAreRefused) {
  GroundFixture g({{"ground_inlier_min", "100000"}});
  g.add_road();
  const FloorResult f = g.floor();
  EXPECT_TRUE(f.fit.refused);
  EXPECT_NE(f.fit.reasons & POSE_WALL_R_FLOOR_FEW_INLIERS, 0U);
}

TEST(Ground, ABenchIsNotTheFloorUnlessItSaysSo) {
  GroundFixture g;
  g.add_level({-8, 8, -2.5, 1.3}, 0.0);
  g.add_level({-8, 8, 1.3, 2.5}, 0.4);
  g.add_wall(2.5);
  g.add_wall(-2.5);
  const FloorResult f = g.floor();
  ASSERT_FALSE(f.fit.refused);
  if ((f.fit.reasons & POSE_WALL_R_FLOOR_AMBIGUOUS) == 0) {
    EXPECT_NEAR(f.fit.plane.d, test::kFloorBelow_m, 0.01);
  }
}

TEST(Ground, GhostsMirroredBelowTheFloorAreNotTheFloor) {
  GroundFixture g;
  g.add_level({-8, 8, -2.5, 2.5}, 0.0, 0.005, 0.15);
  // A roof mirrored, as dense as the floor.
  g.add_level({-4, 4, -2.0, 2.0}, -1.6, 0.005, 0.15);
  g.add_wall(2.5);
  g.add_wall(-2.5);
  const FloorResult f = g.floor();
  if (!f.fit.refused) {
    EXPECT_NEAR(f.fit.plane.d, test::kFloorBelow_m, 0.01);
  }
}

TEST(Ground, TheLastFramesFloorIsNeverTrusted) {
  GroundFixture g;
  g.add_road();
  Plane wrong;
  wrong.d = 0.7;
  expect_floor(g.floor(&wrong), 0.0, 0.0);
  GroundFixture empty;
  EXPECT_TRUE(empty.floor(&wrong).fit.refused);
}

TEST(Ground, TiltBeyondTheLimitIsRefused) {
  GroundFixture g({{"ground_tilt_max_deg", "10"}});
  g.tilt(0.3, 0.0);
  g.add_level({-8, 8, -2.5, 2.5}, 0.0);
  EXPECT_TRUE(g.floor().fit.refused);
}

}  // namespace
}  // namespace pose_wall
