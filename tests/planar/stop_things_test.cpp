// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// When a thing is gone, and how many returns make one.

#include <gtest/gtest.h>

#include "planar/encounter/standing.hpp"

namespace {

using namespace pose_wall::test;

constexpr auto kStands = static_cast<std::uint32_t>(POSE_WALL_PLANAR_STOP_STOP);
constexpr double kFront_m = 2.25;  // of the machine
constexpr int kSettled = 30;       // frames for walls to settle
constexpr int kGone = 15;          // frames beyond the delay and the restart

Thing beam(double x_m, double bottom_m, double top_m) {
  Thing thing{};
  thing.x_m = x_m, thing.half_x_m = 0.15, thing.half_y_m = 0.5;
  thing.bottom_m = bottom_m, thing.top_m = top_m;
  return thing;
}

// A boom that the machine has come near to is below all rays, or above them. That rays pass over it, or under it, tells
// nothing of it. Without it the same drive ends with a permission.
void expect_kept(double bottom_m, double top_m) {
  constexpr double kFar_m = kFront_m + 1.7, kDrive_m = 1.5;
  for (const bool is_there : {false, true}) {
    Standing standing(plain_road());
    standing.frames(kSettled);
    if (is_there) standing.world().things.push_back(beam(kFar_m, bottom_m, top_m));
    const auto far = standing.frames(3);
    EXPECT_EQ((far.reasons & POSE_WALL_PLANAR_STOP_R_THING) != 0, is_there);
    standing.drive(kDrive_m);
    const auto near = standing.frames(kGone);
    EXPECT_EQ(near.state == kStands, is_there) << bottom_m;
    if (!is_there) continue;
    EXPECT_NE(near.nearest_height & POSE_WALL_PLANAR_STOP_HIGH, 0U) << bottom_m;
    EXPECT_LT(near.nearest_distance_m, 0.4) << bottom_m;
    // Seen gone from where rays come to its height.
    standing.world().things.clear();
    standing.drive(-kDrive_m);
    standing.frames(kGone);
    standing.drive(kDrive_m);
    EXPECT_NE(standing.frames(kGone).state, kStands) << bottom_m;
  }
}

TEST(StopThings, ABoomBelowTheRaysIsNotTakenForGone) {
  expect_kept(0.43, 0.71);
}

TEST(StopThings, ABoomAboveTheRaysIsNotTakenForGone) {
  expect_kept(1.6, 1.78);
}

// Right before the sensor a thing brings hundreds of returns, and a handful are dust.
TEST(StopThings, AHandfulOfReturnsBeforeTheSensorIsDust) {
  World world = plain_road();
  world.dust.push_back({2.6, 0.0, 1.2, 0.8, 0.0005});
  Standing standing(world);
  standing.frames(kSettled);
  for (int k = 0; k < 50; ++k) EXPECT_NE(standing.frame().state, kStands) << k;
  standing.world().things.push_back(round_thing(kFront_m + 0.4, 0.0, 0.15, 0.5, 1.4));
  EXPECT_EQ(standing.frames(2).state, kStands) << "a thin body amid the dust";
}

}  // namespace
