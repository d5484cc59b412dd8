// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: fits become measurements by the stated arithmetic: weighted mean of both walls, range bias, splay, which
// reasons come along, and that nothing is measured from what was refused.

#include "engine/output/quality.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/math/elementary.hpp"
#include "engine/walls/doubts/doubts.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

FloorResult good_floor() {
  FloorResult f;
  f.fit.found = true;
  f.roll.sigma_rad = 0.0004;
  f.pitch.sigma_rad = 0.0006;
  f.roll.dof = f.pitch.dof = 40.0;
  return f;
}

JudgedWall good_wall(double yaw = 0.02, double sigma = 0.001) {
  JudgedWall w;
  w.fit.found = true;
  w.yaw_rad = yaw;
  w.yaw_sigma_rad = sigma;
  w.distance_dof[0] = w.distance_dof[1] = 40.0;
  w.yaw_dof = 40.0;
  w.distance_m[0] = 2.4;
  w.distance_m[1] = 2.6;
  w.distance_sigma_m[0] = 0.004;
  w.distance_sigma_m[1] = 0.005;
  return w;
}

struct Scene {
  FloorResult floor = good_floor();
  Levelling levelling;
  JudgedWall walls[2] = {good_wall(), good_wall()};
  Settings settings = test::settings_with({{"range_bias_max", "0.03"}, {"integrity_risk", "5.733e-7"}});

  // Of endless walls.
  Measurements measured() const {
    MeasuredWalls found;
    for (int side = 0; side < 2; ++side) found.side[side] = walls[side];
    return measure_quantities(floor, levelling, found, settings);
  }
};

TEST(Quality, GoodFitsMeasureAllSeven) {
  Scene scene;
  scene.levelling.roll_rad = 0.1;
  scene.levelling.pitch_rad = -0.2;
  const Measurements m = scene.measured();
  const double expected[] = {0.1, -0.2, 0.02, 2.4, 2.6, 2.4, 2.6};
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    EXPECT_TRUE(m.quantity[q].measured) << q;
    EXPECT_NEAR(m.quantity[q].raw, expected[q], 1e-12) << q;
    EXPECT_GT(m.quantity[q].sigma, 0.0) << q;
    EXPECT_GT(m.quantity[q].protection.sum(), 5.0 * m.quantity[q].sigma) << q;
    EXPECT_EQ(m.quantity[q].reasons, 0U) << q;
  }
  EXPECT_TRUE(m.has_yaw_difference);
  EXPECT_EQ(m.left_right_yaw_difference_rad, 0.0);
}

TEST(Quality, RefusedFitsMeasureNothingAndSayWhy) {
  Scene scene;
  scene.floor.fit.refused = true;
  scene.floor.fit.reasons = POSE_WALL_R_FLOOR_THIN;
  scene.walls[0].fit.refused = true;
  scene.walls[0].fit.reasons = POSE_WALL_R_WALL_SHORT;
  const Measurements m = scene.measured();
  for (const std::uint32_t q : {POSE_WALL_ROLL, POSE_WALL_PITCH}) {
    EXPECT_FALSE(m.quantity[q].measured);
    EXPECT_EQ(m.quantity[q].reasons, static_cast<std::uint32_t>(POSE_WALL_R_FLOOR_THIN));
  }
  for (const std::uint32_t q : {POSE_WALL_D_LF, POSE_WALL_D_LB}) {
    EXPECT_FALSE(m.quantity[q].measured);
    EXPECT_EQ(m.quantity[q].reasons, static_cast<std::uint32_t>(POSE_WALL_R_WALL_SHORT));
  }
  EXPECT_TRUE(m.quantity[POSE_WALL_YAW].measured) << "by the wall that is left";
  EXPECT_TRUE(m.quantity[POSE_WALL_D_RF].measured);
  EXPECT_FALSE(m.has_yaw_difference);
}

TEST(Quality, WithoutWallsNoYawAndBothReasons) {
  Scene scene;
  for (JudgedWall& w : scene.walls) w.fit.refused = true;
  scene.walls[0].fit.reasons = POSE_WALL_R_WALL_SHORT;
  scene.walls[1].fit.reasons = POSE_WALL_R_WALL_NOT_FOUND;
  const Measurement yaw = scene.measured().quantity[POSE_WALL_YAW];
  EXPECT_FALSE(yaw.measured);
  EXPECT_EQ(yaw.reasons, static_cast<std::uint32_t>(POSE_WALL_R_WALL_SHORT | POSE_WALL_R_WALL_NOT_FOUND));
}

// A sigma floor of 0.05 mrad and the floor's tilt play no part here beyond a few per cent.
TEST(Quality, YawIsTheMeanByInformation) {
  Scene scene;
  scene.walls[0] = good_wall(0.010, 0.001);
  scene.walls[1] = good_wall(0.013, 0.002);
  const Measurement yaw = scene.measured().quantity[POSE_WALL_YAW];
  EXPECT_NEAR(yaw.raw, 0.010 * 0.8 + 0.013 * 0.2, 1e-4);
  EXPECT_NEAR(yaw.sigma, 0.001 * 2.0 / std::sqrt(5.0), 5e-5);
}

TEST(Quality, ARangeBiasOfBothWallsCancelsAndOfOneCounts) {
  Scene both;
  both.walls[0].yaw_bias_rad_per_m = 0.2;
  both.walls[1].yaw_bias_rad_per_m = -0.2;
  Scene one = both;
  one.walls[1].fit.refused = true;
  Scene none;
  const double without = none.measured().quantity[POSE_WALL_YAW].protection.sum();
  EXPECT_NEAR(both.measured().quantity[POSE_WALL_YAW].protection.sum(), without, 1e-9);
  EXPECT_GE(one.measured().quantity[POSE_WALL_YAW].protection.sum(), 0.03 * 0.2);
}

// By two of their standard deviations walls differ by chance; by nearly three, neither is known so well.
TEST(Quality, WallsThatDifferMoreThanIsLikelyAreLessWellKnown) {
  const auto yaw_of_apart = [](double apart_in_sigmas) {
    Scene scene;
    scene.walls[1].yaw_rad = scene.walls[0].yaw_rad + apart_in_sigmas * std::sqrt(2.0) * 0.001;
    return scene.measured().quantity[POSE_WALL_YAW];
  };
  const Measurement alike = yaw_of_apart(0.0);
  EXPECT_EQ(yaw_of_apart(1.9).sigma, alike.sigma);
  EXPECT_EQ(yaw_of_apart(1.9).protection.sum(), alike.protection.sum());
  EXPECT_NEAR(yaw_of_apart(2.5).sigma, 1.25 * alike.sigma, 0.02 * alike.sigma);
  EXPECT_NEAR(yaw_of_apart(2.9).protection.sum(), 1.45 * alike.protection.sum(), 0.02 * alike.protection.sum());
}

// However few pieces they are known by, and whether one is known much better.
TEST(Quality, WallsFurtherApartAreNeverKnownBetter) {
  for (const double dof : {3.0, 8.0, 40.0}) {
    for (const double second_sigma : {0.0005, 0.001, 0.004}) {
      Measurement last;
      for (double apart = 0.0; apart < 0.03; apart += 0.0001) {
        Scene scene;
        scene.walls[1] = good_wall(scene.walls[0].yaw_rad + apart, second_sigma);
        for (JudgedWall& wall : scene.walls) wall.yaw_dof = dof;
        const Measurement yaw = scene.measured().quantity[POSE_WALL_YAW];
        EXPECT_GE(yaw.protection.sum(), last.protection.sum()) << apart << " " << second_sigma << " " << dof;
        EXPECT_GE(yaw.sigma, last.sigma) << apart << " " << second_sigma << " " << dof;
        last = yaw;
      }
    }
  }
}

TEST(Quality, WallsThatDifferWidenTheLevelToReachEither) {
  Scene scene;
  scene.walls[0].yaw_rad = 0.00;
  scene.walls[1].yaw_rad = 0.06;
  const Measurement yaw = scene.measured().quantity[POSE_WALL_YAW];
  for (const JudgedWall& w : scene.walls) EXPECT_LE(std::fabs(yaw.raw - w.yaw_rad), yaw.protection.sum());
}

// The weaker wall's rival as well: where the road bends ahead, both walls are those behind the bend.
TEST(Quality, YawReachesToARivalOfEitherWallHoweverSmallItsWeight) {
  for (const int side : {0, 1}) {
    Scene scene;
    const double before = scene.measured().quantity[POSE_WALL_YAW].protection.sum();
    scene.walls[side].yaw_sigma_rad = 0.02;
    scene.walls[side].yaw_to_rival_rad = 0.3;
    EXPECT_GE(scene.measured().quantity[POSE_WALL_YAW].protection.sum(), 0.3 + 0.5 * before) << side;
    scene.walls[1 - side].fit.refused = true;
    EXPECT_GE(scene.measured().quantity[POSE_WALL_YAW].protection.sum(), 0.3 + 0.1) << side;
  }
}

// Solution separation: if the doubted one is a curtain, the other wall alone is right.
TEST(Quality, YawByAWallThatMayBeNoneReachesToTheOtherWallAlone) {
  for (const int side : {0, 1}) {
    Scene both;
    both.walls[side].yaw_rad += 0.002;
    Scene alone = both, doubted = both;
    alone.walls[side].fit.refused = true;
    doubted.walls[side].may_be_no_wall = true;
    const Measurement by_other = alone.measured().quantity[POSE_WALL_YAW];
    const Measurement yaw = doubted.measured().quantity[POSE_WALL_YAW];
    EXPECT_EQ(yaw.raw, both.measured().quantity[POSE_WALL_YAW].raw) << side;
    EXPECT_GE(yaw.protection.sum(), std::fabs(yaw.raw - by_other.raw) + by_other.protection.sum() - 1e-12) << side;
    EXPECT_LT(yaw.protection.sum(), by_other.protection.sum() + 0.002) << side;
  }
}

TEST(Quality, YawByThingsThatMayBeNoWallsIsNotKnown) {
  for (const bool is_alone : {false, true}) {
    Scene scene;
    scene.walls[0].may_be_no_wall = true;
    scene.walls[1].may_be_no_wall = !is_alone;
    scene.walls[1].fit.refused = is_alone;
    EXPECT_GE(scene.measured().quantity[POSE_WALL_YAW].protection.sum(), 0.44) << is_alone;
  }
}

// The sides' regions beside the machine: one of a kind, with a wall that is turned so far.
struct Regions : Scene {
  explicit Regions(RegionWall::Kind left, RegionWall::Kind right) {
    found.has_regions = true;
    for (int side = 0; side < 2; ++side) {
      found.side[side] = found.endless[side] = walls[side];
      found.region[side].kind = side == 0 ? left : right;
      found.region[side].wall = good_wall(side == 0 ? 0.10 : 0.04, 0.0005);
    }
  }
  Measurement yaw() const { return measure_quantities(floor, levelling, found, settings).quantity[POSE_WALL_YAW]; }
  MeasuredWalls found;
};

using Kind = RegionWall::Kind;

// However well each is known: by the definition each wall counts once, and a side that is none does not.
TEST(Quality, YawIsTheMeanOfTheRegionsWallsOrOfOneWhereTheOtherIsNone) {
  Regions both(Kind::kWall, Kind::kWall);
  both.found.region[0].wall.yaw_sigma_rad *= 3.0;
  EXPECT_NEAR(both.yaw().raw, 0.07, 1e-12);
  EXPECT_NEAR(Regions(Kind::kNone, Kind::kWall).yaw().raw, 0.04, 1e-12);
}

TEST(Quality, YawReachesToEachReadingOfADoubtfulSide) {
  const Measurement yaw = Regions(Kind::kWall, Kind::kDoubtful).yaw();
  EXPECT_GT(yaw.protection.sum(), std::fabs(yaw.raw - 0.10));
  EXPECT_LT(yaw.protection.sum(), 0.2);
}

TEST(Quality, YawIsOfTheEndlessWallsWhereARegionIsUnknownOrTheyAreKnownBetter) {
  Regions unknown(Kind::kUnknown, Kind::kWall);
  EXPECT_NEAR(unknown.yaw().raw, 0.03, 1e-12) << "the endless wall of one side, and the other's region";
  unknown.found.region[1].may_be_endless = true;
  EXPECT_NEAR(unknown.yaw().raw, 0.02, 1e-12) << "both endless walls";
  Regions alike(Kind::kWall, Kind::kWall);
  for (RegionWall& region : alike.found.region) {
    region.wall.yaw_sigma_rad = 0.02;
    region.may_be_endless = true;
  }
  EXPECT_NEAR(alike.yaw().raw, 0.02, 1e-12);
  alike.found.region[0].may_be_endless = false;
  EXPECT_NEAR(alike.yaw().raw, 0.07, 1e-12) << "one of the endless walls is another surface";
}

// The level alone tells how good a value is: a doubt adds its reason here, and its bound where it is raised.
TEST(Quality, ADoubtOfAWallComesWithItsReasonAndSoDoesYaw) {
  for (const std::uint32_t reason :
       {POSE_WALL_R_WALL_AMBIGUOUS, POSE_WALL_R_WALL_SEEN_THROUGH, POSE_WALL_R_EXTRAPOLATED, POSE_WALL_R_CURVED}) {
    SCOPED_TRACE(reason);
    Scene scene;
    scene.walls[1].fit.reasons = reason;
    const Measurements m = scene.measured();
    for (const int q : {POSE_WALL_D_RF, POSE_WALL_D_RB, POSE_WALL_YAW}) {
      EXPECT_TRUE(m.quantity[q].measured) << q << ": in doubt, not refused";
      EXPECT_EQ(m.quantity[q].reasons, reason) << q;
    }
    EXPECT_EQ(m.quantity[POSE_WALL_D_LF].reasons, 0U) << "the other side is not in doubt";
  }
  Scene far;
  far.walls[0].extrapolated[0] = true;
  const Measurements m = far.measured();
  EXPECT_EQ(m.quantity[POSE_WALL_D_LF].reasons, POSE_WALL_R_EXTRAPOLATED);
  EXPECT_EQ(m.quantity[POSE_WALL_D_LB].reasons, 0U);
  Scene floor;
  floor.floor.fit.reasons = POSE_WALL_R_FLOOR_AMBIGUOUS;
  EXPECT_EQ(floor.measured().quantity[POSE_WALL_ROLL].reasons, POSE_WALL_R_FLOOR_AMBIGUOUS);
}

TEST(Quality, BoundsAddToTheLevel) {
  Scene plain, bound;
  bound.walls[0].distance_bound_m[0][POSE_WALL_PART_BEND] = 0.05;
  bound.floor.roll.bound_rad[POSE_WALL_PART_RIVAL] = 0.01;
  EXPECT_NEAR(bound.measured().quantity[POSE_WALL_D_LF].protection.sum() -
                  plain.measured().quantity[POSE_WALL_D_LF].protection.sum(),
              0.05, 1e-12);
  EXPECT_NEAR(bound.measured().quantity[POSE_WALL_ROLL].protection.sum() -
                  plain.measured().quantity[POSE_WALL_ROLL].protection.sum(),
              0.01, 1e-12);
}

TEST(Quality, FewPatchesWidenTheLevel) {
  Scene many, few;
  few.walls[0].distance_dof[0] = few.walls[0].distance_dof[1] = 3.0;
  few.walls[0].yaw_dof = 3.0;
  EXPECT_GT(few.measured().quantity[POSE_WALL_D_LF].protection.sum(),
            1.5 * many.measured().quantity[POSE_WALL_D_LF].protection.sum());
}

TEST(Quality, BeyondTheAlertLimitIsSaid) {
  Scene scene;
  scene.walls[0].distance_sigma_m[0] = 0.05;
  scene.walls[1].distance_sigma_m[0] = std::nan("");
  const Measurements m = scene.measured();
  EXPECT_NE(m.quantity[POSE_WALL_D_LF].reasons & POSE_WALL_R_ALERT_LIMIT, 0U);
  EXPECT_NE(m.quantity[POSE_WALL_D_RF].reasons & POSE_WALL_R_ALERT_LIMIT, 0U) << "NaN is within no limit";
  EXPECT_FALSE(m.quantity[POSE_WALL_D_RF].measured) << "and what has no bound is no measurement";
  EXPECT_EQ(m.quantity[POSE_WALL_D_LB].reasons & POSE_WALL_R_ALERT_LIMIT, 0U);
}

TEST(Quality, ASideFullOfNearReturnsIsRefused) {
  JudgedWall walls[2] = {good_wall(), good_wall()};
  IngestCounts counts;
  counts.points_in = 10000;
  counts.near_by_quadrant[kLeft] = 2000;
  counts.kept_by_quadrant[kLeft] = 500;
  counts.near_by_quadrant[kRight] = 100;  // housing, a hand: not what blocks a side
  counts.kept_by_quadrant[kRight] = 50;
  refuse_blocked_sides(counts, Scene().settings, &walls);
  EXPECT_TRUE(walls[0].fit.refused);
  EXPECT_NE(walls[0].fit.reasons & POSE_WALL_R_WALL_TOO_NEAR, 0U);
  EXPECT_FALSE(walls[1].fit.refused);
}

}  // namespace
}  // namespace pose_wall
