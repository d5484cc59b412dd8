// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: two places of an odometry move each quantity as floor and walls that stand still move before the machine;
// errors of places do not add up frame by frame while drift does; and beyond what was seen only the config bounds. The
// motion within a scan widens levels by what the odometry does not know or by what the values of two frames show, and
// is taken out only where that narrows them.

#include "engine/output/temporal_odometry.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <limits>

#include "base/math/rotation.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

const Axes kAheadX = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
constexpr double kWallLevel_rad = 0.01, kPlaceLevel = 0.004;

pose_wall_odometry place(double x_m, double y_m, double yaw_rad, double roll_rad = 0.0) {
  pose_wall_odometry o{};
  o.run = 7;
  o.position_m[0] = x_m;
  o.position_m[1] = y_m;
  const Eigen::Quaterniond q(rotation_zyx(roll_rad, 0.0, yaw_rad));
  for (int k = 0; k < 4; ++k) o.quaternion[k] = q.coeffs()[k];
  o.along[0] = o.across[1] = 1.0;
  for (double& level : o.level) level = kPlaceLevel;
  return o;
}

// A straight road along X: floor 1 m below base, walls 2 m to the left and 3 m to the right, seen 10 m either way.
struct Road {
  FloorResult floor;
  Levelling levelling;
  JudgedWall walls[2];
  Measurements measured;

  Road() {
    for (Measurement& m : measured.quantity) m.measured = true;
    floor.fit.plane = {Eigen::Vector3d::UnitZ(), 1.0};
    floor.roi_radius_m = 3.0;
    floor.roll.sigma_rad = floor.pitch.sigma_rad = 0.001;
    for (int side = 0; side < 2; ++side) {
      walls[side].fit.plane = {side == 0 ? Eigen::Vector3d(0.0, -1.0, 0.0) : Eigen::Vector3d(0.0, 1.0, 0.0),
                               side == 0 ? 2.0 : 3.0};
      walls[side].along_level = Eigen::Vector3d::UnitX();
      walls[side].along_min_m = -10.0;
      walls[side].along_max_m = 10.0;
      walls[side].yaw_bound_rad[POSE_WALL_PART_BEND] = kWallLevel_rad;
    }
  }
  OdometryMemory seen_from(const pose_wall_odometry& o, const Settings& s) const {
    OdometryMemory memory;
    remember_place(o, floor, levelling, walls, measured, s, kAheadX, &memory);
    return memory;
  }
};

Change change_between(const pose_wall_odometry& from, const pose_wall_odometry& to, const Settings& s) {
  const OdometryMemory memory = Road().seen_from(from, s);
  Change change = change_by_config(s, 0.1);
  (void)change_by_odometry(to, memory, s, kAheadX, &change);
  return change;
}

TEST(TemporalOdometry, AStepToTheLeftNearsTheLeftWallAndLeavesTheRight) {
  const Change c = change_between(place(0, 0, 0), place(0.3, 0.1, 0), test::settings_with());
  EXPECT_NEAR(c.carry[POSE_WALL_D_LF], -0.1, 1e-12);
  EXPECT_NEAR(c.carry[POSE_WALL_D_LB], -0.1, 1e-12);
  EXPECT_NEAR(c.carry[POSE_WALL_D_RF], 0.1, 1e-12);
  EXPECT_NEAR(c.carry[POSE_WALL_YAW], 0.0, 1e-12);
}

TEST(TemporalOdometry, ATurnToTheLeftLowersYawAndSwingsTheSamplingPoints) {
  const double turn = 0.2;
  const Settings s = test::settings_with({{"s_front", "2"}, {"s_back", "-1.5"}});
  const Change c = change_between(place(0, 0, 0), place(0, 0, turn), s);
  EXPECT_NEAR(c.carry[POSE_WALL_YAW], -turn, 1e-12);
  EXPECT_NEAR(c.carry[POSE_WALL_D_LF], -2.0 * std::sin(turn), 1e-12) << "exact, whatever the turn";
  EXPECT_NEAR(c.carry[POSE_WALL_D_LB], 1.5 * std::sin(turn), 1e-12);
  EXPECT_NEAR(c.carry[POSE_WALL_D_RF], 2.0 * std::sin(turn), 1e-12);
}

TEST(TemporalOdometry, AMachineThatRollsBeforeAStandingFloorReportsIt) {
  const Change c = change_between(place(0, 0, 0), place(0, 0, 0, 0.05), test::settings_with());
  EXPECT_NEAR(c.carry[POSE_WALL_ROLL], 0.05, 1e-12);
  EXPECT_NEAR(c.carry[POSE_WALL_PITCH], 0.0, 1e-12);
}

TEST(TemporalOdometry, TheFrameOfTheRunDoesNotMatter) {
  const Settings s = test::settings_with();
  const Change straight = change_between(place(0, 0, 0), place(0.3, 0.1, 0.05), s);
  const double turn = 1.1;
  const auto turned = [&](double x, double y, double yaw) {
    pose_wall_odometry o =
        place(std::cos(turn) * x - std::sin(turn) * y + 40.0, std::sin(turn) * x + std::cos(turn) * y, yaw + turn);
    o.along[0] = o.across[1] = std::cos(turn);
    o.along[1] = std::sin(turn);
    o.across[0] = -std::sin(turn);
    return o;
  };
  const Change other = change_between(turned(0, 0, 0), turned(0.3, 0.1, 0.05), s);
  for (int q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    EXPECT_NEAR(other.carry[q], straight.carry[q], 1e-9) << q;
    EXPECT_NEAR(other.growth[q], straight.growth[q], 1e-9) << q;
    EXPECT_NEAR(other.place_level[q], straight.place_level[q], 1e-9) << q;
  }
}

TEST(TemporalOdometry, ErrorsOfPlacesDoNotAddUpAndDriftDoes) {
  const Settings s = test::settings_with();
  const Road road;
  Unknown unknown;
  OdometryMemory memory = road.seen_from(place(0, 0, 0), s);
  pose_wall_odometry at = place(0, 0, 0);
  for (int frame = 1; frame <= 100; ++frame) {
    at.drift_variance[5] += 1e-8;
    at.drift[5] += 1e-6;
    Change change = change_by_config(s, 0.1);
    change_by_odometry(at, memory, s, kAheadX, &change);
    unknown.grow(change, POSE_WALL_YAW, 0.1);
    memory = road.seen_from(at, s);
  }
  const double drift = s.protection_sigmas * std::sqrt(100 * 1e-8) + 100 * 1e-6;
  EXPECT_NEAR(unknown.total(), 2.0 * kPlaceLevel + drift, 1e-9);
  EXPECT_EQ(unknown.blind_s, 0.0);
}

TEST(TemporalOdometry, AFrameWithoutAPlaceAddsWhatTheConfigAllows) {
  const Settings s = test::settings_with();
  const Change by_place = change_between(place(0, 0, 0), place(0, 0, 0), s);
  Unknown unknown;
  unknown.grow(by_place, POSE_WALL_YAW, 0.1);
  unknown.grow(change_by_config(s, 0.5), POSE_WALL_YAW, 0.5);
  EXPECT_NEAR(unknown.total(), 2.0 * kPlaceLevel + 0.5 * s.hold_rate_angle, 1e-12);
  EXPECT_EQ(unknown.blind_s, 0.5);
  unknown.grow(by_place, POSE_WALL_YAW, 0.1);
  EXPECT_NEAR(unknown.total(), 4.0 * kPlaceLevel + 0.5 * s.hold_rate_angle, 1e-12) << "two more ends";
}

TEST(TemporalOdometry, AWallsDirectionCountsByTheWayAndNothingIsKnownBeyondWhatWasSeen) {
  const Settings s = test::settings_with();
  const Change inside = change_between(place(0, 0, 0), place(3, 0, 0), s);
  EXPECT_NEAR(inside.growth[POSE_WALL_D_LF], 3.0 * kWallLevel_rad, 1e-9);
  EXPECT_EQ(inside.growth[POSE_WALL_YAW], 0.0);
  const double ends = inside.place_level[POSE_WALL_D_LF];
  const Change beyond = change_between(place(0, 0, 0), place(9, 0, 0), s);
  EXPECT_NEAR(beyond.place_level[POSE_WALL_D_LF], ends + 1.0 + kPlaceLevel, 1e-9)
      << "its point is at 11 m, give or take its level; seen are 10";
  EXPECT_NEAR(beyond.place_level[POSE_WALL_D_LB], ends, 1e-9) << "its point is at 7 m";
  EXPECT_TRUE(beyond.by_places[POSE_WALL_YAW]) << "the machine is at 9 m";
  EXPECT_FALSE(change_between(place(0, 0, 0), place(10.5, 0, 0), s).by_places[POSE_WALL_YAW]);
}

TEST(TemporalOdometry, AnUnknownWayAlongComesAndGoes) {
  const Settings s = test::settings_with();
  pose_wall_odometry to = place(3, 0, 0);
  to.level[0] = 6.0;
  const Change c = change_between(place(0, 0, 0), to, s);
  EXPECT_NEAR(c.growth[POSE_WALL_D_LF], 3.0 * kWallLevel_rad, 1e-9) << "what adds up is the way";
  EXPECT_NEAR(c.place_level[POSE_WALL_D_LF], kWallLevel_rad * 6.0 + kPlaceLevel + 2.0 * kPlaceLevel + 1.0, 1e-9);
}

TEST(TemporalOdometry, ASurfaceThatNobodySawIsTheConfigsMatter) {
  const Settings s = test::settings_with();
  Road road;
  for (const int q : {POSE_WALL_D_RF, POSE_WALL_D_RB}) road.measured.quantity[q].measured = false;
  const OdometryMemory memory = road.seen_from(place(0, 0, 0), s);
  Change change = change_by_config(s, 0.1);
  change_by_odometry(place(0, 0.1, 0), memory, s, kAheadX, &change);
  EXPECT_TRUE(change.by_places[POSE_WALL_D_LF]);
  EXPECT_FALSE(change.by_places[POSE_WALL_D_RF]);
  EXPECT_EQ(change.carry[POSE_WALL_D_RF], 0.0);
  EXPECT_EQ(change.growth[POSE_WALL_D_RF], 0.1 * s.hold_rate_distance);
}

TEST(TemporalOdometry, ADriftThatFallsIsOfAnotherRun) {
  const Settings s = test::settings_with();
  pose_wall_odometry from = place(0, 0, 0);
  from.drift[0] = 1.0;
  const Change c = change_between(from, place(0, 0.1, 0), s);
  for (const bool by_places : c.by_places) EXPECT_FALSE(by_places);
  Change change = change_by_config(s, 0.1);
  EXPECT_FALSE(change_by_odometry(place(0, 0.1, 0), Road().seen_from(from, s), s, kAheadX, &change));
}

TEST(TemporalOdometry, ANewRunForgetsWhatWasSeen) {
  const Settings s = test::settings_with();
  Road road;
  OdometryMemory memory = road.seen_from(place(0, 0, 0), s);
  pose_wall_odometry other = place(0, 0, 0);
  other.run = 8;
  for (const int q : {POSE_WALL_D_LF, POSE_WALL_D_LB}) road.measured.quantity[q].stale = true;
  remember_place(other, road.floor, road.levelling, road.walls, road.measured, s, kAheadX, &memory);
  EXPECT_EQ(memory.run, 8U);
  EXPECT_FALSE(memory.wall[0].exists);
  EXPECT_TRUE(memory.wall[1].exists);
}

// What is in doubt is no landmark. What is only known widely is one, with its wide level.
TEST(TemporalOdometry, SurfacesInDoubtAreNotRemembered) {
  const Settings s = test::settings_with();
  for (const std::uint32_t reason : {POSE_WALL_R_FLOOR_AMBIGUOUS, POSE_WALL_R_ALERT_LIMIT}) {
    Road road;
    for (Measurement& m : road.measured.quantity) m.reasons = reason;
    const OdometryMemory memory = road.seen_from(place(0, 0, 0), s);
    EXPECT_EQ(memory.floor.exists, reason == POSE_WALL_R_ALERT_LIMIT);
    EXPECT_EQ(memory.wall[0].exists, reason == POSE_WALL_R_ALERT_LIMIT);
  }
}

TEST(TemporalOdometry, NumbersThatAreNoneAreUnsound) {
  const pose_wall_odometry good = place(1, 2, 0.3);
  ASSERT_TRUE(is_sound(good));
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  pose_wall_odometry far = good;
  far.level[0] = infinite;
  EXPECT_TRUE(is_sound(far)) << "nobody knows the way along: that is no fault";
  constexpr std::size_t kFirst = offsetof(pose_wall_odometry, position_m);
  for (std::size_t at = kFirst; at < sizeof(good); at += sizeof(double)) {
    for (const double bad : {nan, infinite, -infinite}) {
      pose_wall_odometry broken = good;
      std::memcpy(reinterpret_cast<unsigned char*>(&broken) + at, &bad, sizeof(bad));
      const bool of_levels =
          (at >= offsetof(pose_wall_odometry, level) && at < offsetof(pose_wall_odometry, drift_variance)) ||
          at >= offsetof(pose_wall_odometry, rate_level);
      EXPECT_EQ(is_sound(broken), of_levels && bad == infinite) << at << " " << bad;
    }
  }
  pose_wall_odometry no_run = good;
  no_run.run = 0;
  EXPECT_FALSE(is_sound(no_run));
  pose_wall_odometry long_quaternion = good;
  long_quaternion.quaternion[3] *= 1.01;
  EXPECT_FALSE(is_sound(long_quaternion));
}

}  // namespace
}  // namespace pose_wall
