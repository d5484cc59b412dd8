// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what is unknown of the motion within a scan widens the levels. It adds what the odometry leaves, or what the
// values of two frames show if that is less, whether motion was taken out of them or not. It never adds less than what
// is left in the scan moves a value. A motion is taken out only where that narrows the levels.

#include "output/motion_in_scan.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

const Axes kAxes = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
constexpr double kScan_s = 0.1, kRandom = 0.01, kInfinite = std::numeric_limits<double>::infinity();
constexpr double kActs = 0.625;  // of the scan, for a value whose points are seen evenly over it

// A machine in a road along X whose rates are told in base.
pose_wall_odometry with_rates(double yaw_rad_s, double level_of_turns, double level_of_ways = 0.0) {
  pose_wall_odometry o{};
  o.run = 7;
  o.quaternion[3] = o.along[0] = o.across[1] = 1.0;
  o.turn_rate_rad_s[2] = yaw_rad_s;
  for (int k = 0; k < POSE_WALL_ODOMETRY_DIRECTIONS; ++k) o.rate_level[k] = k < 3 ? level_of_ways : level_of_turns;
  return o;
}

const pose_wall_odometry kHardlyKnown = with_rates(0.0, 1.0, 1.0);

// Frames between two walls whose values are what they are told to be.
struct Frames {
  Measurements measured;
  JudgedWall walls[2];
  OwnChanges own;
  Settings settings = test::settings_with();

  Frames() {
    for (Measurement& m : measured.quantity) {
      m.measured = true;
      m.sigma = kRandom / settings.protection_sigmas;
      m.protection[POSE_WALL_PART_RANDOM] = kRandom;
    }
    measured.has_yaw_difference = true;
    for (int side = 0; side < 2; ++side) {
      walls[side].fit.found = true;
      walls[side].fit.plane = {Eigen::Vector3d(0.0, side == 0 ? -1.0 : 1.0, 0.0), 2.0};
    }
  }
  // The measurements with what the scan's motion adds.
  Measurements next(const pose_wall_odometry& o, double yaw_rad = 0.0, bool taken_out = false, double since_s = 0.1) {
    Measurements out = measured;
    out.quantity[POSE_WALL_YAW].raw = yaw_rad;
    MotionInScan(o, settings, kAxes).widen(taken_out, {{kScan_s, 0.5 * kScan_s}, since_s}, {}, walls, &own, &out);
    return out;
  }
  double added_to_yaw(const pose_wall_odometry& o, double yaw_rad = 0.0, bool taken_out = false, double since_s = 0.1) {
    return next(o, yaw_rad, taken_out, since_s).quantity[POSE_WALL_YAW].protection[POSE_WALL_PART_AGE];
  }
};

double added(const Measurements& measured, std::uint32_t quantity) {
  return measured.quantity[quantity].protection[POSE_WALL_PART_AGE];
}

// A motion that turns round hides from a single change, so two are needed.
TEST(MotionInScan, AStandingMachineKeepsItsLevelsFromTheThirdFrameOn) {
  Frames frames;
  for (int frame = 0; frame < 2; ++frame) {
    const Measurements first = frames.next(kHardlyKnown);
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) EXPECT_GT(added(first, q), kRandom) << q;
  }
  for (int frame = 2; frame < 5; ++frame) {
    const Measurements later = frames.next(kHardlyKnown);
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      EXPECT_LE(added(later, q), (q < POSE_WALL_D_LF ? 0.0 : 0.31) * kRandom) << q;
    }
  }
}

// The machine stood, and turns by 0.02 in the scan: the first value errs by all that it has changed.
TEST(MotionInScan, ATurnThatBeginsIsInTheLevelAtOnce) {
  Frames frames;
  frames.next(kHardlyKnown);
  frames.next(kHardlyKnown);
  EXPECT_GE(frames.added_to_yaw(kHardlyKnown, -kActs * 0.02), kActs * 0.02);
  // It goes on, steadily.
  double yaw_rad = -kActs * 0.02;
  for (int frame = 0; frame < 5; ++frame) {
    yaw_rad -= 0.02;
    const double level = frames.added_to_yaw(kHardlyKnown, yaw_rad);
    EXPECT_GE(level, kActs * 0.02);
    EXPECT_LE(level, 0.021) << "and not as if nothing were known";
  }
}

// A machine that turns steadily under an odometry that says how fast, and hardly how sure.
struct Turning {
  Frames frames;
  double rate_rad_s, yaw_rad = 0.0;

  explicit Turning(double rate) : rate_rad_s(rate) {}
  // The error that the scan's motion gives a value, turned left: smaller.
  double error(double told_rad_s, bool taken_out) const {
    return -kActs * kScan_s * (rate_rad_s - (taken_out ? told_rad_s : 0.0));
  }
  double next(double told_rad_s, bool taken_out) {
    yaw_rad -= kScan_s * rate_rad_s;
    return frames.added_to_yaw(with_rates(told_rad_s, 2.0, 2.0), yaw_rad + error(told_rad_s, taken_out), taken_out);
  }
};

// The values move as they were told to, so the motion that was taken out was the right one, whoever doubts it.
TEST(MotionInScan, WhatWasTakenOutRightlyCostsNothing) {
  Turning turning(0.3);
  for (int frame = 0; frame < 2; ++frame) EXPECT_GT(turning.next(0.3, true), kActs * 0.03);
  for (int frame = 2; frame < 6; ++frame) EXPECT_LT(turning.next(0.3, true), 1e-12);
}

// Another rate is told each time, and taken out or left in by turns: what is left alternates.
TEST(MotionInScan, WhatIsLeftOfASteadyTurnIsInTheLevel) {
  std::mt19937 random(20261127);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const double rate = share(random) - 0.5;
    Turning turning(rate);
    for (int frame = 0; frame < 12; ++frame) {
      const double told = rate * (0.5 + share(random));
      const bool taken_out = share(random) < 0.5;
      const double level = turning.next(told, taken_out);
      ASSERT_GE(level + 1e-12, std::fabs(turning.error(told, taken_out))) << trial << " " << frame;
    }
  }
}

TEST(MotionInScan, WhatWasTakenOutIsAChangeOfEachValue) {
  pose_wall_odometry o = with_rates(0.0, 2.0, 2.0);
  o.velocity_m_s[0] = 1.0;
  o.velocity_m_s[1] = 0.2;  // to the left wall
  o.turn_rate_rad_s[0] = 0.05;
  o.turn_rate_rad_s[1] = -0.04;
  o.turn_rate_rad_s[2] = 0.03;
  Frames frames;
  const double front_m = frames.settings.s_front, back_m = frames.settings.s_back;
  const auto moved = [&](double seconds) {
    Measurements m = frames.measured;
    m.quantity[POSE_WALL_ROLL].raw = 0.05 * seconds;
    m.quantity[POSE_WALL_PITCH].raw = -0.04 * seconds;
    m.quantity[POSE_WALL_YAW].raw = -0.03 * seconds;
    m.quantity[POSE_WALL_D_LF].raw = -(0.2 + 0.03 * front_m) * seconds;
    m.quantity[POSE_WALL_D_LB].raw = -(0.2 + 0.03 * back_m) * seconds;
    m.quantity[POSE_WALL_D_RF].raw = (0.2 + 0.03 * front_m) * seconds;
    m.quantity[POSE_WALL_D_RB].raw = (0.2 + 0.03 * back_m) * seconds;
    return m;
  };
  for (int frame = 0; frame < 5; ++frame) {
    Measurements m = moved(kScan_s * frame);
    MotionInScan(o, frames.settings, kAxes)
        .widen(true, {{kScan_s, 0.5 * kScan_s}, kScan_s}, {}, frames.walls, &frames.own, &m);
    for (std::uint32_t q = 0; frame > 1 && q < POSE_WALL_QUANTITIES; ++q) {
      EXPECT_LT(added(m, q), (q < POSE_WALL_D_LF ? 0.001 : 0.31) * kRandom) << q << " in frame " << frame;
    }
  }
}

// To and fro at half the frame rate: two scans may show the same.
TEST(MotionInScan, ATurnToAndFroIsRememberedForAFrame) {
  Frames frames;
  frames.next(kHardlyKnown);
  frames.next(kHardlyKnown);
  frames.next(kHardlyKnown, 0.02);
  EXPECT_GE(frames.added_to_yaw(kHardlyKnown, 0.02), 0.02);
}

TEST(MotionInScan, AGoodOdometryAddsAsVariancesDo) {
  Frames frames;
  const double rate = 0.1;
  const Measurements first = frames.next(with_rates(0.0, rate));
  const double level = kActs * kScan_s * rate, expected = std::sqrt(kRandom * kRandom + level * level);
  EXPECT_NEAR(added(first, POSE_WALL_YAW), expected - kRandom, 1e-12);
  EXPECT_EQ(first.quantity[POSE_WALL_YAW].sigma, kRandom / frames.settings.protection_sigmas)
      << "the measurement's own";
}

// The odometry says that nothing turns, and the value changed by more than its noise.
TEST(MotionInScan, AnOdometryThatTheValuesContradictIsNotBelieved) {
  Frames frames;
  const pose_wall_odometry sure = with_rates(0.0, 1e-6);
  frames.next(sure);
  const double noise = std::sqrt(2.0) * kRandom;
  EXPECT_GE(frames.added_to_yaw(sure, 5.0 * noise), 4.0 * noise);
  EXPECT_LT(frames.added_to_yaw(sure, 4.5 * noise), 0.01 * noise);
}

// It is no error by chance: the value is off by it, every time.
TEST(MotionInScan, AToldTurnThatIsLeftInTheScanAddsInFull) {
  Frames frames;
  EXPECT_NEAR(frames.added_to_yaw(with_rates(0.2, 0.0)), kActs * kScan_s * 0.2, 1e-12);
  EXPECT_NEAR(frames.added_to_yaw(with_rates(0.2, 0.0), 0.0, true), 0.0, 1e-12) << "taken out";
}

TEST(MotionInScan, OnlyTheFrameBeforeIsAWitness) {
  const auto is_none = [](const std::function<void(Frames*)>& spoil, double since_s = 0.1) {
    Frames frames;
    frames.next(kHardlyKnown);
    frames.next(kHardlyKnown);
    spoil(&frames);
    return frames.added_to_yaw(kHardlyKnown, 0.0, false, since_s) > kRandom;
  };
  EXPECT_FALSE(is_none([](Frames*) {}));
  EXPECT_TRUE(is_none([](Frames* f) { f->own.forget(); }));
  EXPECT_TRUE(is_none([](Frames*) {}, 0.05)) << "a part of a scan later";
  EXPECT_TRUE(is_none([](Frames*) {}, 0.5)) << "long after";
  EXPECT_TRUE(is_none([](Frames*) {}, 0.0)) << "under the same stamp";
  EXPECT_TRUE(is_none([](Frames* f) { f->measured.quantity[POSE_WALL_YAW].stale = true; })) << "a repeat";
  EXPECT_TRUE(is_none([](Frames* f) { f->next(with_rates(0.5, 0.1), 0.0, true); })) << "another motion was taken out";
  const auto leave_out = [](Frames* f) {
    f->measured.quantity[POSE_WALL_YAW].measured = false;
    f->next(kHardlyKnown);
    f->measured.quantity[POSE_WALL_YAW].measured = true;
  };
  EXPECT_TRUE(is_none(leave_out));
}

// The last value may have been of another surface: as far off as its level said.
TEST(MotionInScan, AWideLevelBeforeIsInTheLevelNow) {
  Frames frames;
  frames.measured.quantity[POSE_WALL_YAW].protection[POSE_WALL_PART_RIVAL] = 0.05;
  frames.next(kHardlyKnown);
  frames.next(kHardlyKnown);
  frames.measured.quantity[POSE_WALL_YAW].protection[POSE_WALL_PART_RIVAL] = 0.0;
  const pose_wall_odometry unknown = with_rates(0.0, 10.0);
  EXPECT_NEAR(frames.added_to_yaw(unknown), 0.05, 1e-12);
}

TEST(MotionInScan, AWallThatWasNeverSeenMayStandAcross) {
  Frames frames;
  for (JudgedWall& wall : frames.walls) wall.fit.refused = true;
  pose_wall_odometry along_unknown = with_rates(0.0, 0.0);
  along_unknown.rate_level[0] = 5.0;
  EXPECT_GT(added(frames.next(along_unknown), POSE_WALL_D_LF), 0.3);
  Frames seen;
  EXPECT_LT(added(seen.next(along_unknown), POSE_WALL_D_LF), 1e-9) << "along a wall nothing changes";
}

TEST(MotionInScan, IsTakenOutOnlyWhereThatNarrowsLevels) {
  Frames frames;
  frames.next(kHardlyKnown);
  const auto improves = [&](double turn, double level) {
    return MotionInScan(with_rates(turn, level), frames.settings, kAxes).improves(kScan_s, frames.own);
  };
  EXPECT_TRUE(improves(0.5, 0.05)) << "a turn of 0.05 known to a tenth";
  EXPECT_FALSE(improves(0.5, 2.0)) << "a turn that may be none";
  EXPECT_TRUE(improves(0.0, 2.0)) << "nothing is taken out";
}

TEST(MotionInScan, AnInfiniteLevelStaysOne) {
  Frames frames;
  const Measurements first = frames.next(with_rates(0.0, kInfinite));
  EXPECT_TRUE(std::isinf(added(first, POSE_WALL_YAW)));
  EXPECT_TRUE(std::isfinite(first.quantity[POSE_WALL_YAW].sigma)) << "a deviation is a number";
  frames.next(with_rates(0.0, kInfinite));
  EXPECT_LT(frames.added_to_yaw(with_rates(0.0, kInfinite)), 1e-12);
}

}  // namespace
}  // namespace pose_wall
