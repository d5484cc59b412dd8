// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the walls stage finds the two sides of a road and what they say of yaw and distances, and does not take for a
// side what is none: a face, a short patch, a leaning plane, things seen through, walls that run apart. It tells where
// both sides lean as only a wrong level makes them.

#include "engine/walls/walls.hpp"

#include <gtest/gtest.h>

#include "support/band_fixture.hpp"
#include "support/ray_scene.hpp"

namespace pose_wall {
namespace {

using test::BandFixture;
using test::kLongWall;

// 160 x 21 points of 1 cm on each wall, voxels not involved: offset 0.2 mm, direction 0.05 mrad. Ten times that.
constexpr double kDistance_m = 0.002, kYaw_rad = 0.0005;

bool is_good(const JudgedWall& wall) {
  return wall.fit.found && !wall.fit.refused;
}

TEST(Walls, BothSidesOfAStraightRoad) {
  BandFixture band;
  band.add_wall(2.5, kLongWall);
  band.add_wall(-2.0, kLongWall);
  const WallsResult r = band.walls();
  ASSERT_TRUE(is_good(r.side[0]) && is_good(r.side[1]));
  for (int end = 0; end < 2; ++end) {
    EXPECT_NEAR(r.side[0].distance_m[end], 2.5, kDistance_m);
    EXPECT_NEAR(r.side[1].distance_m[end], 2.0, kDistance_m);
    EXPECT_FALSE(r.side[0].extrapolated[end]);
  }
  for (const JudgedWall& wall : r.side) {
    EXPECT_NEAR(wall.yaw_rad, 0.0, kYaw_rad);
    EXPECT_NEAR(wall.lean_rad, 0.0, 0.005);
    EXPECT_NEAR(wall.along_min_m, -8.0, 0.6);
    EXPECT_NEAR(wall.along_max_m, 8.0, 0.6);
    EXPECT_GT(wall.fit.inliers, 5000U);
  }
  EXPECT_LT(r.side[0].fit.plane.n.y(), -0.99);
  EXPECT_GT(r.side[1].fit.plane.n.y(), 0.99);
}

TEST(Walls, ATurnedRoadTurnsYawAndDistances) {
  for (const double turned : {-0.6, -0.1, 0.3, 0.6}) {
    BandFixture band;
    band.add_wall(2.5, kLongWall, turned);
    band.add_wall(-2.0, kLongWall, turned);
    const WallsResult r = band.walls();
    ASSERT_TRUE(is_good(r.side[0]) && is_good(r.side[1])) << turned;
    EXPECT_NEAR(r.side[0].yaw_rad, turned, kYaw_rad);
    EXPECT_NEAR(r.side[1].yaw_rad, turned, kYaw_rad);
    // The line through (0, y) in direction (cos, sin), from (s, 0).
    EXPECT_NEAR(r.side[0].distance_m[0], 2.5 * std::cos(turned) + 2.0 * std::sin(turned), kDistance_m);
    EXPECT_NEAR(r.side[0].distance_m[1], 2.5 * std::cos(turned) - 2.0 * std::sin(turned), kDistance_m);
    EXPECT_NEAR(r.side[1].distance_m[0], std::fabs(2.0 * std::cos(turned) - 2.0 * std::sin(turned)), kDistance_m);
  }
}

TEST(Walls, LeanIsEstimatedNotForcedToZero) {
  BandFixture band;
  band.add_wall(2.5, kLongWall, 0.0, 0.01, 0.10);
  band.add_wall(-2.5, kLongWall, 0.0, 0.01, -0.07);
  const WallsResult r = band.walls();
  ASSERT_TRUE(is_good(r.side[0]) && is_good(r.side[1]));
  EXPECT_NEAR(r.side[0].lean_rad, 0.10, 0.003);
  EXPECT_NEAR(r.side[1].lean_rad, -0.07, 0.003);
  EXPECT_NEAR(r.side[0].distance_m[0], 2.5 * std::cos(0.10), kDistance_m);
}

// Where both walls lean the same way about the road, the level is wrong: one leans out as far as the other leans in.
TEST(Walls, WhatBothSidesSayOfTheLevel) {
  constexpr double kTurned_rad = 0.4;
  const auto tilt = [](double out_left_rad, double out_right_rad, double turned_rad = 0.0) {
    BandFixture band;
    band.add_wall(2.5, kLongWall, turned_rad, 0.01, out_left_rad);
    band.add_wall(-2.0, kLongWall, turned_rad, 0.01, out_right_rad);
    return band.walls().tilt_level_rad;
  };
  for (const double lean : {0.3, -0.3}) {
    const Eigen::Vector3d along = tilt(lean, -lean), turned = tilt(lean, -lean, kTurned_rad);
    EXPECT_GT(along.norm(), 0.3) << lean;
    EXPECT_LT(along.norm(), 0.5) << lean;
    EXPECT_NEAR(std::fabs(along.x()), along.norm(), 0.01) << "about the road, " << lean;
    EXPECT_NEAR(turned.y() / turned.x(), std::tan(kTurned_rad), 0.02) << "about the road, " << lean;
    EXPECT_EQ(tilt(lean, lean).norm(), 0.0) << "both in, or both out: " << lean;
  }
  for (const double lean : {0.17, -0.17}) EXPECT_EQ(tilt(lean, -lean).norm(), 0.0) << "as walls may: " << lean;
  for (const double other : {-0.01, 0.01}) EXPECT_EQ(tilt(0.5, other).norm(), 0.0) << "the other is upright: " << other;
}

TEST(Walls, AWallThatLeansTooMuchIsRefused) {
  BandFixture band({{"wall_lean_max_deg", "5"}});
  band.add_wall(2.5, kLongWall, 0.0, 0.01, 0.2);
  band.add_wall(-2.5, kLongWall);
  const WallsResult r = band.walls();
  EXPECT_FALSE(is_good(r.side[0]));
  EXPECT_TRUE(is_good(r.side[1]));
}

TEST(Walls, NoPointsNoWalls) {
  BandFixture band;
  for (const JudgedWall& wall : band.walls().side) {
    EXPECT_FALSE(is_good(wall));
    EXPECT_TRUE(wall.fit.refused);
    EXPECT_NE(wall.fit.reasons & POSE_WALL_R_WALL_NOT_FOUND, 0U);
  }
}

TEST(Walls, AFaceAheadIsNoSide) {
  BandFixture band;
  band.add_wall(2.5, {-8.0, 4.0, 0.3, 2.4});
  band.add_wall(-2.5, {-8.0, 4.0, 0.3, 2.4});
  band.add_face(4.0, -4.5, 4.5);
  const WallsResult r = band.walls();
  ASSERT_TRUE(is_good(r.side[0]) && is_good(r.side[1]));
  EXPECT_NEAR(r.side[0].yaw_rad, 0.0, 2 * kYaw_rad);
  EXPECT_NEAR(r.side[1].distance_m[0], 2.5, kDistance_m);
}

TEST(Walls, OnlyAFaceMakesNoWallsAtAll) {
  BandFixture band;
  band.add_face(3.0, -6.0, 6.0);
  for (const JudgedWall& wall : band.walls().side) EXPECT_FALSE(is_good(wall));
}

TEST(Walls, AShortPatchIsRefused) {
  BandFixture band;
  band.add_wall(2.5, {-0.5, 0.5, 0.3, 2.4});
  const JudgedWall left = band.walls().side[0];
  EXPECT_TRUE(left.fit.refused);
  EXPECT_NE(left.fit.reasons, 0U);
}

TEST(Walls, FewPointsAreRefused) {
  BandFixture band({{"wall_inlier_min", "50000"}});
  band.add_wall(2.5, kLongWall);
  const JudgedWall left = band.walls().side[0];
  EXPECT_TRUE(left.fit.refused);
  EXPECT_NE(left.fit.reasons & POSE_WALL_R_WALL_FEW_INLIERS, 0U);
}

TEST(Walls, OneWallIsNotMadeTwo) {
  BandFixture band;
  band.add_wall(-2.5, kLongWall);
  const WallsResult r = band.walls();
  EXPECT_FALSE(is_good(r.side[0]));
  ASSERT_TRUE(is_good(r.side[1]));
  EXPECT_NEAR(r.side[1].distance_m[0], 2.5, kDistance_m);
}

TEST(Walls, ARailInFrontIsNotTheWall) {
  BandFixture band;
  band.add_wall(2.5, kLongWall);
  band.add_wall(-2.5, kLongWall);
  // A pipe as a strip of two decimetres, half a metre before the left wall, with the wall seen over and under it.
  for (int copy = 0; copy < 4; ++copy) band.add_wall(2.0, {-8.0, 8.0, 1.0, 1.2});
  const JudgedWall left = band.walls().side[0];
  if (is_good(left)) {
    EXPECT_NEAR(left.distance_m[0], 2.5, left.distance_bound_m[0].sum() + 0.02);
  }
}

// Pipes as thick as a leg from the floor to the roof, a finger's breadth apart: nothing is seen between them.
TEST(Walls, PipesOneAboveTheOtherAreDoubted) {
  constexpr double kRadius_m = 0.2, kPitch_m = 0.42;
  BandFixture band;
  band.add_wall(-2.5, kLongWall);
  for (double x = -8.0; x < 8.0; x += 0.06) {
    for (double h = 0.3; h < 2.4; h += 0.03) {
      const double off = h - kPitch_m * std::round(h / kPitch_m);
      if (std::fabs(off) > kRadius_m) continue;
      const double front = std::sqrt(kRadius_m * kRadius_m - off * off);
      band.points().add(x, 2.7 - front + band.noise().normal(0.01), h + test::kFloorZ_m);
    }
  }
  const WallsResult r = band.walls();
  ASSERT_TRUE(r.side[0].fit.found && r.side[1].fit.found);
  EXPECT_NE(r.side[0].fit.reasons & POSE_WALL_R_WALL_AMBIGUOUS, 0U);
  EXPECT_EQ(r.side[1].fit.reasons & POSE_WALL_R_WALL_AMBIGUOUS, 0U);
  for (int end = 0; end < 2; ++end) {
    EXPECT_GE(r.side[0].distance_bound_m[end].sum(), 2.0);
    EXPECT_LT(r.side[1].distance_bound_m[end].sum(), 0.1);
  }
}

// Half of a pair whose other half is a conveyor after all.
TEST(Walls, WhatIsLeftOfAPairMustBeAsLongAsAWallAlone) {
  for (const double half_length_m : {1.75, 12.0}) {
    BandFixture band;
    test::RayScene scene;
    scene.set_noise(0.01);
    scene.add(test::level_panel(test::kFloorZ_m));
    scene.add(test::side_panel(3.0, {-half_length_m, half_length_m}, {test::kFloorZ_m, 1.8}));
    scene.add(test::side_panel(-3.0, {-half_length_m, half_length_m}, {test::kFloorZ_m, 0.1}));
    scene.add(test::side_panel(-6.0, {-16.0, 16.0}, {test::kFloorZ_m, 1.8}, true));
    scene.scan({-22.5, 22.5, 0.7, 0.35}, &band);
    const WallsResult r = band.walls();
    ASSERT_TRUE(r.side[0].fit.found && r.side[1].fit.found) << half_length_m;
    EXPECT_TRUE(r.side[1].fit.refused) << half_length_m;
    const bool short_alone = half_length_m < 2.5;
    EXPECT_EQ(r.side[0].fit.refused, short_alone) << half_length_m;
    EXPECT_EQ((r.side[0].fit.reasons & POSE_WALL_R_WALL_SHORT) != 0, short_alone) << half_length_m;
  }
}

// Walls that run apart, of which one shows so much less that the other is taken alone: it need not be the one that runs
// along the road.
TEST(Walls, AWallAloneTellsTheRoadNoBetterThanTheOtherSideAllows) {
  constexpr BandFixture::Extent kHalfAsHigh{-8.0, 8.0, 0.3, 1.1};
  for (const double apart_rad : {0.0, 0.5}) {
    BandFixture band;
    band.add_wall(2.5, kLongWall);
    band.add_wall(-4.5, kHalfAsHigh, apart_rad);
    const WallsResult r = band.walls();
    ASSERT_TRUE(is_good(r.side[0])) << apart_rad;
    ASSERT_EQ(is_good(r.side[1]), apart_rad == 0.0);
    if (apart_rad == 0.0) {
      EXPECT_LT(r.side[0].yaw_bound_rad.sum(), 0.02);
    } else {
      EXPECT_GE(r.side[0].yaw_bound_rad.sum(), apart_rad - 0.02);
    }
  }
  BandFixture alone;
  alone.add_wall(2.5, kLongWall);
  EXPECT_LT(alone.walls().side[0].yaw_bound_rad.sum(), 0.02) << "nothing on the other side speaks against it";
}

// Also where the last column that is seen is the sampling point's own.
TEST(Walls, BeyondTheLastWallIsExtrapolationAndTheLevelSaysSo) {
  for (const double to_m : {0.5, 1.4, 1.8}) {
    BandFixture band;
    band.add_wall(2.5, {-8.0, to_m, 0.3, 2.4});
    band.add_wall(-2.5, kLongWall);
    const WallsResult r = band.walls();
    ASSERT_TRUE(is_good(r.side[0])) << to_m;
    EXPECT_TRUE(r.side[0].extrapolated[0]) << to_m;
    EXPECT_GE(r.side[0].distance_bound_m[0].sum(), 2.0) << to_m;
    EXPECT_FALSE(r.side[0].extrapolated[1]) << to_m;
    EXPECT_LT(r.side[0].distance_bound_m[1].sum(), 0.05) << to_m;
    EXPECT_FALSE(r.side[1].extrapolated[0]) << to_m;
    EXPECT_GT(r.side[0].distance_sigma_m[0], r.side[0].distance_sigma_m[1]) << to_m;
  }
}

// A post hides a little of a wall, and what is seen to both sides of it tells enough.
TEST(Walls, AWallThatIsHiddenAtASamplingPointIsExtrapolatedWhereMuchOfItIs) {
  for (const double hidden_m : {0.4, 1.0}) {
    BandFixture band;
    band.add_wall(2.5, {-8.0, 2.0 - 0.5 * hidden_m, 0.3, 2.4});
    band.add_wall(2.5, {2.0 + 0.5 * hidden_m, 8.0, 0.3, 2.4});
    band.add_wall(-2.5, kLongWall);
    const WallsResult r = band.walls();
    ASSERT_TRUE(is_good(r.side[0])) << hidden_m;
    EXPECT_EQ(r.side[0].extrapolated[0], hidden_m > 0.6) << hidden_m;
    EXPECT_EQ(r.side[0].distance_bound_m[0].sum() >= 2.0, hidden_m > 0.6) << hidden_m;
  }
}

TEST(Walls, WallsThatBeginWellAheadTellTheYawOnlyAsWellAsRoadsRunStraight) {
  for (const double from_m : {1.0, 3.2}) {
    BandFixture band;
    band.add_wall(2.5, {from_m, 12.0, 0.3, 2.4});
    band.add_wall(-2.5, {-12.0, -from_m, 0.3, 2.4});
    const WallsResult r = band.walls();
    for (int side = 0; side < 2; ++side) {
      ASSERT_TRUE(is_good(r.side[side])) << from_m;
      EXPECT_EQ(r.side[side].yaw_to_rival_rad > 0.3, from_m > 2.0) << side;
      EXPECT_EQ((r.side[side].fit.reasons & POSE_WALL_R_EXTRAPOLATED) != 0, from_m > 2.0) << side;
    }
  }
}

TEST(Walls, AMachineThatNearlyTouchesAWallSeesItAllTheSame) {
  for (const double flank_m : {2.3, 2.42, 2.46}) {
    BandFixture band;
    band.settings().lateral_offset_left = flank_m;
    band.add_wall(2.5, kLongWall);
    band.add_wall(-2.5, kLongWall);
    const WallsResult r = band.walls();
    ASSERT_TRUE(is_good(r.side[0])) << flank_m;
    for (int end = 0; end < 2; ++end) {
      EXPECT_NEAR(r.side[0].distance_m[end], 2.5 - flank_m, 0.01);
      EXPECT_FALSE(r.side[0].extrapolated[end]) << flank_m;
      EXPECT_LT(r.side[0].distance_bound_m[end].sum(), 0.05) << flank_m;
    }
  }
}

TEST(Walls, ASamplingPointInTheRockHasALevelThatReachesToItsOtherSign) {
  BandFixture band;
  band.settings().lateral_offset_left = 2.8;
  band.add_wall(2.5, kLongWall);
  band.add_wall(-2.5, kLongWall);
  const WallsResult r = band.walls();
  ASSERT_TRUE(is_good(r.side[0]) && is_good(r.side[1]));
  for (int end = 0; end < 2; ++end) {
    EXPECT_NEAR(r.side[0].distance_m[end], 0.3, 0.02);
    EXPECT_TRUE(r.side[0].extrapolated[end]);
    EXPECT_GE(r.side[0].distance_bound_m[end].sum(), 2.0 * 0.28);
    EXPECT_FALSE(r.side[1].extrapolated[end]);
    EXPECT_LT(r.side[1].distance_bound_m[end].sum(), 0.05);
  }
}

// Shorter than two columns of the grid: each of them holds points of the wall beside the step.
TEST(Walls, AShortStepAtASamplingPointIsToldAndBounded) {
  constexpr double kFrom_m = -2.42, kTo_m = -1.66;
  for (const double by_m : {0.08, 0.12, 0.3, -0.08, -0.12, -0.3}) {
    BandFixture band;
    band.add_wall(2.5, {-8.0, kFrom_m, 0.3, 2.4});
    band.add_wall(2.5 - by_m, {kFrom_m + 0.05, kTo_m, 0.3, 2.4});
    band.add_wall(2.5, {kTo_m + 0.05, 8.0, 0.3, 2.4});
    band.add_wall(-2.5, kLongWall);
    const WallsResult r = band.walls();
    ASSERT_TRUE(is_good(r.side[0]) && is_good(r.side[1])) << by_m;
    EXPECT_TRUE(r.side[0].extrapolated[1]) << by_m;
    EXPECT_GE(r.side[0].distance_bound_m[1].sum(), std::fabs(r.side[0].distance_m[1] - (2.5 - by_m))) << by_m;
    EXPECT_FALSE(r.side[0].extrapolated[0]) << by_m;
    EXPECT_FALSE(r.side[1].extrapolated[1]) << by_m;
  }
}

TEST(Walls, TheLastFramesPlaneIsNeverTrusted) {
  BandFixture band;
  band.add_wall(2.5, kLongWall);
  band.add_wall(-2.5, kLongWall);
  const Plane wrong_left{Eigen::Vector3d(0, -1, 0), 1.2}, wrong_right{Eigen::Vector3d(0, 1, 0), 1.2};
  const WallsResult r = band.walls(&wrong_left, &wrong_right);
  ASSERT_TRUE(is_good(r.side[0]) && is_good(r.side[1]));
  EXPECT_NEAR(r.side[0].distance_m[0], 2.5, kDistance_m);
  EXPECT_NEAR(r.side[1].distance_m[0], 2.5, kDistance_m);
  BandFixture empty;
  EXPECT_FALSE(is_good(empty.walls(&wrong_left, &wrong_right).side[0]));
}

TEST(Walls, WorkIsBoundedByTheConfig) {
  BandFixture band({{"wall_iterations", "60"}});
  band.add_wall(2.5, kLongWall);
  band.add_wall(-2.5, kLongWall);
  // Draws, the last frame's plane and a few offsets of the other side's direction.
  for (const JudgedWall& wall : band.walls().side) EXPECT_LE(wall.fit.iterations, 60U + 16U);
}

}  // namespace
}  // namespace pose_wall
