// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: two good walls of nearly one direction are turned onto their mean about their pivots and pay for it in their
// bounds; doubtful, refused or truly splayed ones are left alone.

#include "engine/walls/direction.hpp"

#include <gtest/gtest.h>

#include "base/math/elementary.hpp"
#include "support/band_fixture.hpp"

namespace pose_wall {
namespace {

JudgedWall wall(bool is_left, double yaw, double sigma) {
  JudgedWall w;
  w.fit.found = true;
  const double s = is_left ? 1.0 : -1.0;
  w.fit.plane.n = Eigen::Vector3d(s * std::sin(yaw), -s * std::cos(yaw), 0.0);
  w.fit.plane.d = 2.5;
  w.yaw_rad = yaw;
  w.yaw_sigma_rad = sigma;
  w.pivot_level_m = -2.5 * w.fit.plane.n;
  for (int end = 0; end < 2; ++end) {
    w.distance_m[end] = distance_at(w.fit.plane, Eigen::Vector3d(end == 0 ? 2 : -2, 0, 0));
  }
  return w;
}

double yaw_of_plane(const JudgedWall& w) {
  return yaw_of(along_of(w.fit.plane, Eigen::Vector3d::UnitX()), Eigen::Vector3d::UnitX());
}

TEST(WallsParallel, NearlyParallelWallsShareOneDirectionAndPayForIt) {
  test::BandFixture band;
  JudgedWall walls[2] = {wall(true, 0.010, 0.002), wall(false, 0.000, 0.002)};
  const JudgedWall before[2] = {walls[0], walls[1]};
  share_direction(band.scene(), &walls);
  EXPECT_NEAR(yaw_of_plane(walls[0]), 0.005, 1e-9);
  EXPECT_NEAR(yaw_of_plane(walls[1]), 0.005, 1e-9);
  for (int side = 0; side < 2; ++side) {
    EXPECT_EQ(walls[side].yaw_rad, before[side].yaw_rad) << "as measured";
    EXPECT_NEAR(walls[side].fit.plane.signed_distance(before[side].pivot_level_m), 0.0, 1e-12);
    for (int end = 0; end < 2; ++end) {
      const double moved = std::fabs(walls[side].distance_m[end] - before[side].distance_m[end]);
      EXPECT_GT(moved, 0.005);
      EXPECT_GE(walls[side].distance_bound_m[end].sum(), moved - 1e-12);
    }
  }
}

TEST(WallsParallel, TheBetterWallMovesLess) {
  test::BandFixture band;
  JudgedWall walls[2] = {wall(true, 0.010, 0.001), wall(false, 0.000, 0.010)};
  share_direction(band.scene(), &walls);
  EXPECT_GT(yaw_of_plane(walls[0]), 0.0075);
  EXPECT_NEAR(yaw_of_plane(walls[0]), yaw_of_plane(walls[1]), 1e-9);
}

TEST(WallsParallel, SplayedDoubtfulAndRefusedWallsAreLeftAlone) {
  for (int which = 0; which < 4; ++which) {
    test::BandFixture band;
    if (which == 3) band.settings().wall_parallel_within_deg = 0.0;
    JudgedWall walls[2] = {wall(true, which == 0 ? 0.06 : 0.010, 0.002), wall(false, 0.0, 0.002)};
    if (which == 1) walls[1].fit.reasons = POSE_WALL_R_WALL_AMBIGUOUS;
    if (which == 2) walls[1].fit.refused = true;
    const double before = walls[0].distance_m[0];
    share_direction(band.scene(), &walls);
    EXPECT_EQ(walls[0].distance_m[0], before) << which;
    EXPECT_EQ(walls[0].distance_bound_m[0].sum(), 0.0) << which;
  }
}

}  // namespace
}  // namespace pose_wall
