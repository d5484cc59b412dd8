// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the floor is found below a level or tilted machine, near or only far away, neither roof nor bench nor heap
// nor reflection is taken for it without a word, and where several planes are about as good the levels reach to all.

#include "engine/floor/floor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/floor_fixture.hpp"

namespace pose_wall {
namespace {

using test::FloorFixture;

// 2000 points of 5 mm over 3 m around: 0.1 mrad; ten times that.
constexpr double kAngle_rad = 0.001;
constexpr double kHeight_m = 0.002;

void expect_floor(const FloorResult& f, double roll, double pitch) {
  ASSERT_TRUE(f.fit.found && !f.fit.refused);
  const RollPitch angles = roll_pitch_of_up(f.fit.plane.n);
  EXPECT_NEAR(angles.roll_rad, roll, kAngle_rad);
  EXPECT_NEAR(angles.pitch_rad, pitch, kAngle_rad);
  EXPECT_NEAR(f.fit.plane.d, test::kFloorBelow_m, kHeight_m);
  EXPECT_LT(std::fabs(angles.roll_rad - roll), 5.0 * f.roll.sigma_rad + f.roll.bound_rad.sum() + 5e-5);
  EXPECT_LT(std::fabs(angles.pitch_rad - pitch), 5.0 * f.pitch.sigma_rad + f.pitch.bound_rad.sum() + 5e-5);
}

TEST(Floor, LevelAndTilted) {
  for (const double roll : {-0.35, 0.0, 0.2}) {
    for (const double pitch : {-0.26, 0.0, 0.35}) {
      FloorFixture g;
      g.tilt(roll, pitch);
      g.add_road();
      expect_floor(g.floor(), roll, pitch);
    }
  }
}

TEST(Floor, TheLowSideOfATiltedMachineIsNotTheWholeFloor) {
  FloorFixture g;
  g.tilt(0.3, 0.0);
  g.add_road();
  const FloorResult f = g.floor();
  EXPECT_GT(f.area_m2, 15.0);
  EXPECT_GT(f.fit.inliers, 1500U);
}

TEST(Floor, OnlySeenFarAway) {
  FloorFixture g({{"ground_inlier_min", "300"}});
  g.add_level({4.0, 9.0, -2.5, 2.5}, 0.0);
  g.add_level({-9.0, -4.0, -2.5, 2.5}, 0.0);
  g.add_wall(2.5);
  g.add_wall(-2.5);
  const FloorResult f = g.floor();
  expect_floor(f, 0.0, 0.0);
  EXPECT_GT(f.roi_radius_m, 3.0);
}

// Rough enough that no radius is good enough. Within a wider one there is no more of it, or half as much again.
TEST(Floor, AWiderRadiusIsLookedAtWhereItHoldsMore) {
  for (const bool more : {false, true}) {
    FloorFixture g({{"ground_roi_radius", "3"}, {"ground_roi_radius_max", "15"}});
    g.add_level({-2.0, 2.0, -2.0, 2.0}, 0.0, 0.04);
    if (more) g.add_level({3.0, 6.0, -2.0, 2.0}, 0.0, 0.04);
    const FloorResult wide = g.floor();
    g.settings().ground_roi_radius_max = 3.0;
    const FloorResult narrow = g.floor();
    ASSERT_TRUE(wide.fit.found && narrow.fit.found);
    EXPECT_EQ(narrow.roi_radius_m, 3.0);
    EXPECT_EQ(wide.roi_radius_m, more ? 6.75 : 3.0);
    const bool the_same = wide.fit.plane.n == narrow.fit.plane.n &&
                          wide.roll.bound_rad.sum() == narrow.roll.bound_rad.sum() &&
                          wide.pitch.bound_rad.sum() == narrow.pitch.bound_rad.sum();
    EXPECT_EQ(the_same, !more);
  }
}

TEST(Floor, NothingOrNoFloorIsRefused) {
  FloorFixture empty;
  EXPECT_TRUE(empty.floor().fit.refused);
  EXPECT_NE(empty.floor().fit.reasons, 0U);
  FloorFixture roof;
  roof.add_level({-8, 8, -2.5, 2.5}, 3.2);
  EXPECT_TRUE(roof.floor().fit.refused) << "a roof alone";
  FloorFixture walls;
  walls.add_level({-8, 8, -2.5, 2.5}, 3.2);
  walls.add_wall(2.5);
  walls.add_wall(-2.5);
  EXPECT_TRUE(walls.floor().fit.refused) << "walls and roof, no floor";
}

TEST(Floor, OneLineOnTheFloorIsNoFloor) {
  FloorFixture g({{"ground_inlier_min", "20"}});
  for (double y = -2.5; y <= 2.5; y += 0.002) g.add(3.0 + 0.0004 * std::sin(99 * y), y, 0.0);
  EXPECT_TRUE(g.floor().fit.refused);
}

// A piece of a floor is seen and is too little; a splinter, with as many points, is none.
TEST(Floor, ASplinterIsNoFloorAndAPieceTooLittleOfOne) {
  constexpr double kStep_m = 0.02;
  FloorFixture splinter({{"ground_inlier_min", "50"}}), piece({{"ground_inlier_min", "50"}});
  splinter.add_level({1.05, 1.45, 0.05, 0.45}, 0.0, 0.003, kStep_m);
  piece.add_level({1.05, 2.2, 0.05, 1.2}, 0.0, 0.003, 2.0 * kStep_m);
  const FloorResult nothing = splinter.floor(), little = piece.floor();
  EXPECT_TRUE(nothing.fit.refused);
  EXPECT_FALSE(nothing.fit.found);
  EXPECT_NE(nothing.fit.reasons & POSE_WALL_R_FLOOR_NOT_FOUND, 0U);
  EXPECT_TRUE(little.fit.refused);
  EXPECT_NE(little.fit.reasons & POSE_WALL_R_FLOOR_THIN, 0U);
}

TEST(Floor, FewPointsAreRefused) {
  FloorFixture g({{"ground_inlier_min", "100000"}});
  g.add_road();
  const FloorResult f = g.floor();
  EXPECT_TRUE(f.fit.refused);
  EXPECT_NE(f.fit.reasons & POSE_WALL_R_FLOOR_FEW_INLIERS, 0U);
}

TEST(Floor, ABenchIsNotTheFloorUnlessItSaysSo) {
  FloorFixture g;
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

// Floors that rise to either side of a level one in the middle, which runs along the road or across it.
struct Valley {
  double middle_half_m, left_slope_rad, right_slope_rad;
  bool across = false;
  double heading_rad = 0.0;
  double pitch_rad = 0.0;  // of the machine on its middle

  FloorResult floor() const {
    // One radius: nothing but the rivals moves the bounds by much.
    FloorFixture g({{"ground_roi_radius", "6"}, {"ground_roi_radius_max", "6"}});
    g.tilt(0.0, pitch_rad);
    test::Noise noise(2);
    for (double x = -8.0; x <= 8.0; x += 0.1) {
      for (double y = -8.0; y <= 8.0; y += 0.1) {
        const double along = x + noise.uniform(-0.04, 0.04), aside = y + noise.uniform(-0.04, 0.04);
        const double x_m = across ? aside : along, y_m = across ? along : aside;
        const double cosine = std::cos(heading_rad), sine = std::sin(heading_rad);
        g.add(cosine * x_m + sine * y_m, cosine * y_m - sine * x_m, height_m(aside) + noise.normal(0.005));
      }
    }
    return g.floor();
  }

  // As large as what is wrong if the floor is the farthest of its slopes, and not much larger.
  void expect_bound_reaches(const FloorResult& f) const {
    constexpr double kMuch = 2.0;          // what the rivals tell, bend and halves of finer patches tell again
    constexpr double kOfRival_rad = 0.01;  // a rival is not fitted in full
    const RollPitch angles = roll_pitch_of_up(f.fit.plane.n);
    const double found_rad = across ? angles.pitch_rad : -angles.roll_rad;  // positive where left or ahead is high
    const double bound_rad = across ? f.pitch.bound_rad.sum() : f.roll.bound_rad.sum();
    const double farthest_rad = std::max(std::fabs(found_rad - left_slope_rad), std::fabs(found_rad + right_slope_rad));
    EXPECT_GE(bound_rad, farthest_rad);
    EXPECT_LE(bound_rad, kMuch * farthest_rad + kOfRival_rad);
    EXPECT_LT(across ? f.roll.bound_rad.sum() : f.pitch.bound_rad.sum(), 0.03) << "about the other axis they agree";
  }

 private:
  double height_m(double aside_m) const {
    if (aside_m > middle_half_m) return std::tan(left_slope_rad) * (aside_m - middle_half_m);
    if (aside_m < -middle_half_m) return std::tan(right_slope_rad) * (-aside_m - middle_half_m);
    return 0.0;
  }
};

// As large as the other floor, and of little more than half its size.
TEST(Floor, BoundsReachToARivalFloor) {
  const Valley with_rival[] = {{0.0, 0.09, 0.0}, {0.0, 0.14, 0.0}, {0.7, 0.14, 0.0}};
  for (Valley valley : with_rival) {
    for (const bool across : {false, true}) {
      SCOPED_TRACE(::testing::Message() << valley.left_slope_rad << (across ? " across" : " along"));
      valley.across = across;
      const FloorResult f = valley.floor();
      ASSERT_TRUE(f.fit.found && !f.fit.refused);
      EXPECT_NE(f.fit.reasons & POSE_WALL_R_FLOOR_AMBIGUOUS, 0U);
      valley.expect_bound_reaches(f);
    }
  }
}

TEST(Floor, BoundsReachToTheFartherOfTwoRivalFloors) {
  for (const bool across : {false, true}) {
    for (const double left_rad : {0.12, 0.21}) {
      SCOPED_TRACE(::testing::Message() << left_rad << (across ? " across" : " along"));
      const Valley valley{0.7, left_rad, 0.33 - left_rad, across};
      const FloorResult f = valley.floor();
      ASSERT_TRUE(f.fit.found && !f.fit.refused);
      EXPECT_NE(f.fit.reasons & POSE_WALL_R_FLOOR_AMBIGUOUS, 0U);
      valley.expect_bound_reaches(f);
    }
  }
}

// The road may climb: a steep floor that has no rival is as sure as a level one.
TEST(Floor, ASteepFloorWithoutRivalsKeepsItsBounds) {
  FloorFixture g;
  g.tilt(0.25, 0.2);
  g.add_road();
  const FloorResult f = g.floor();
  ASSERT_TRUE(f.fit.found && !f.fit.refused);
  EXPECT_LT(std::max(f.roll.bound_rad.sum(), f.pitch.bound_rad.sum()), 0.01);
}

// Two flanks of one heap, and nothing level: the floor under the machine is neither.
// Whichever way the machine looks: askew to the heap neither roll nor pitch is as large as the tilt.
TEST(Floor, WhereAllThatMayBeTheFloorIsSteepTheBoundsReachToUpright) {
  for (const double heading_rad : {0.0, 0.785, 1.571}) {
    for (Valley valley : {Valley{0.0, 0.38, -0.27}, Valley{0.0, 0.29, -0.19}}) {
      SCOPED_TRACE(::testing::Message() << valley.left_slope_rad << " seen from " << heading_rad);
      valley.heading_rad = heading_rad;
      const FloorResult f = valley.floor();
      ASSERT_TRUE(f.fit.found && !f.fit.refused);
      ASSERT_NE(f.fit.reasons & POSE_WALL_R_FLOOR_AMBIGUOUS, 0U);
      const double tilt_rad = tilt_of_up(f.fit.plane.n);
      EXPECT_GT(tilt_rad, 0.17);
      EXPECT_GE(f.roll.bound_rad.sum(), tilt_rad);
      EXPECT_GE(f.pitch.bound_rad.sum(), tilt_rad);
    }
  }
}

TEST(Floor, ASlopeOfAThirdOfTheFloorIsNoRival) {
  for (const bool across : {false, true}) {
    const FloorResult f = Valley{2.5, 0.14, 0.0, across}.floor();
    ASSERT_TRUE(f.fit.found && !f.fit.refused);
    EXPECT_EQ(f.fit.reasons & POSE_WALL_R_FLOOR_AMBIGUOUS, 0U);
    EXPECT_LT(std::max(f.roll.bound_rad.sum(), f.pitch.bound_rad.sum()), 0.03);
  }
}

TEST(Floor, ASlopeOfLessThanHalfOfTheFloorIsARivalHoweverTheMachineStands) {
  for (const double pitch_rad : {0.0, 0.25}) {
    Valley valley{1.35, 0.0, 0.2};
    valley.pitch_rad = pitch_rad;
    const FloorResult f = valley.floor();
    ASSERT_TRUE(f.fit.found && !f.fit.refused);
    ASSERT_NEAR(tilt_of_up(f.fit.plane.n), pitch_rad, 0.02);
    EXPECT_TRUE((f.fit.reasons & POSE_WALL_R_FLOOR_AMBIGUOUS) != 0) << pitch_rad;
  }
}

TEST(Floor, GhostsMirroredBelowTheFloorAreNotTheFloor) {
  FloorFixture g;
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

TEST(Floor, TheLastFramesFloorIsNeverTrusted) {
  FloorFixture g;
  g.add_road();
  Plane wrong;
  wrong.d = 0.7;
  expect_floor(g.floor(&wrong), 0.0, 0.0);
  FloorFixture empty;
  EXPECT_TRUE(empty.floor(&wrong).fit.refused);
}

TEST(Floor, TiltBeyondTheLimitIsRefused) {
  FloorFixture g({{"ground_tilt_max_deg", "10"}});
  g.tilt(0.3, 0.0);
  g.add_level({-8, 8, -2.5, 2.5}, 0.0);
  EXPECT_TRUE(g.floor().fit.refused);
}

}  // namespace
}  // namespace pose_wall
