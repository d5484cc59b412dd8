// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what is unknown of the motion within a scan widens the levels. It adds what the odometry leaves, or what the
// values of two frames show if that is less, whether motion was taken out of them or not. It never adds less than what
// is left in the scan moves a value. Without an odometry the values alone tell. A motion is taken out only where that
// narrows the levels.

#include "engine/output/motion_in_scan.hpp"

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
    MotionInScan(&o, settings, kAxes).widen(taken_out, {{kScan_s, 0.5 * kScan_s}, since_s}, {}, walls, &own, &out);
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

  double acts = kActs;

  explicit Turning(double rate) : rate_rad_s(rate) {}
  // The error that the scan's motion gives a value, turned left: smaller.
  double error(double told_rad_s, bool taken_out) const {
    return -acts * kScan_s * (rate_rad_s - (taken_out ? told_rad_s : 0.0));
  }
  double next(double told_rad_s, bool taken_out, double since_s = kScan_s) {
    yaw_rad -= since_s * rate_rad_s;
    const double yaw = yaw_rad + error(told_rad_s, taken_out);
    return frames.added_to_yaw(with_rates(told_rad_s, 2.0, 2.0), yaw, taken_out, since_s);
  }
};

// The values move as they were told to, so the motion that was taken out was the right one, whoever doubts it.
TEST(MotionInScan, WhatWasTakenOutRightlyCostsNothing) {
  Turning turning(0.3);
  for (int frame = 0; frame < 2; ++frame) EXPECT_GT(turning.next(0.3, true), kActs * 0.03);
  for (int frame = 2; frame < 6; ++frame) EXPECT_LT(turning.next(0.3, true), 1e-6);
}

// Another rate is told each time, and taken out or left in by turns: what is left alternates. Points may come earlier
// in the scan than the engine assumes, and a frame a little late.
TEST(MotionInScan, WhatIsLeftOfASteadyTurnIsInTheLevel) {
  std::mt19937 random(20261127);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    const double rate = share(random) - 0.5;
    Turning turning(rate);
    turning.acts = kActs * share(random);
    for (int frame = 0; frame < 12; ++frame) {
      const double told = rate * (0.5 + share(random));
      const bool taken_out = share(random) < 0.5;
      const double level = turning.next(told, taken_out, kScan_s * (0.95 + 0.5 * share(random)));
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
    MotionInScan(&o, frames.settings, kAxes)
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
  EXPECT_NEAR(frames.added_to_yaw(with_rates(0.2, 0.0)), kActs * kScan_s * 0.2, 1e-6);
  EXPECT_NEAR(frames.added_to_yaw(with_rates(0.2, 0.0), 0.0, true), 0.0, 1e-6) << "taken out";
}

// Without a witness the level is the odometry's, which knows nothing.
TEST(MotionInScan, OnlyTheFrameBeforeIsAWitness) {
  const auto is_none = [](const std::function<void(Frames*)>& spoil, double since_s = 0.1) {
    Frames frames;
    frames.next(kHardlyKnown);
    frames.next(kHardlyKnown);
    spoil(&frames);
    return frames.added_to_yaw(kHardlyKnown, 0.0, false, since_s) > kRandom;
  };
  EXPECT_FALSE(is_none([](Frames*) {}));
  EXPECT_FALSE(is_none([](Frames*) {}, 0.14)) << "a little late";
  EXPECT_TRUE(is_none([](Frames* f) { f->own.forget(); }));
  EXPECT_TRUE(is_none([](Frames*) {}, 0.05)) << "a part of a scan later";
  EXPECT_TRUE(is_none([](Frames*) {}, 0.2)) << "a frame was lost, and another motion with it";
  EXPECT_TRUE(is_none([](Frames*) {}, 0.0)) << "under the same stamp";
  EXPECT_TRUE(is_none([](Frames* f) { f->measured.quantity[POSE_WALL_YAW].stale = true; })) << "a repeat";
  const auto after = [](double since_s) {
    return [since_s](Frames* f) { f->next(kHardlyKnown, 0.0, false, since_s); };
  };
  EXPECT_TRUE(is_none(after(0.5))) << "the change before was over a gap";
  EXPECT_TRUE(is_none(after(-3.0))) << "or over a clock that went back";
  const auto leave_out = [](Frames* f) {
    f->measured.quantity[POSE_WALL_YAW].measured = false;
    f->next(kHardlyKnown);
    f->measured.quantity[POSE_WALL_YAW].measured = true;
  };
  EXPECT_TRUE(is_none(leave_out));
}

// No sensor takes longer for a scan than the step to the next one, and none that spins longer than 0.2 s.
TEST(MotionInScan, AScanWithoutTimesTakesAsLongAsItsStep) {
  const Settings settings = test::settings_with();
  EXPECT_EQ(scan_in_time({0.09, 0.05}, {0.1}, settings).scan.whole_s, 0.09) << "by its times";
  EXPECT_EQ(scan_in_time({}, {0.07}, settings).scan.whole_s, 0.07);
  EXPECT_EQ(scan_in_time({}, {0.07}, settings).scan.mean_s, 0.035);
  for (const double since_s : {0.3, 1e9}) EXPECT_EQ(scan_in_time({}, {since_s}, settings).scan.whole_s, 0.2) << since_s;
  for (const double since_s : {0.0, -1.0})
    EXPECT_EQ(scan_in_time({}, {since_s}, settings).scan.whole_s, 0.2) << since_s;
}

// As far as it tells it for sure, and not where its level allows that nothing turns.
TEST(MotionInScan, WhatAnOdometryTellsIsLeftInAScanWithoutTimes) {
  for (const double level : {0.0, 0.1, 0.3, 2.0, kInfinite}) {
    Frames frames;
    Measurements before = frames.measured, m = frames.measured;
    const pose_wall_odometry turns = with_rates(0.3, level);
    for (Measurements* const measured : {&before, &m}) {
      MotionInScan(&turns, frames.settings, kAxes)
          .widen(false, scan_in_time({}, {kScan_s}, frames.settings), {}, frames.walls, &frames.own, measured);
    }
    const double sure = std::max(0.0, 0.3 - level);
    EXPECT_NEAR(m.quantity[POSE_WALL_YAW].shown_motion, kActs * kScan_s * sure, 1e-6) << level;
    EXPECT_EQ(added(m, POSE_WALL_YAW), 0.0) << "of the level that jumps are judged by";
  }
}

// Nothing stands beside a first scan: what the odometry leaves open may all be in it.
TEST(MotionInScan, OfAFirstScanWithoutTimesTheOdometryIsTheOnlyWitness) {
  double last = 0.0;
  for (const double level : {0.0, 0.1, 0.3, 2.0, kInfinite}) {
    Frames frames;
    Measurements m = frames.measured;
    const pose_wall_odometry turns = with_rates(0.3, level);
    MotionInScan(&turns, frames.settings, kAxes)
        .widen(false, scan_in_time({}, {0.0}, frames.settings), {}, frames.walls, &frames.own, &m);
    const Measurement& yaw = m.quantity[POSE_WALL_YAW];
    EXPECT_GE(yaw.shown_motion, kActs * frames.settings.scan_max * 0.3 - 1e-6) << "what it tells for sure, and more";
    EXPECT_TRUE(level == 0.0 || yaw.shown_motion > last) << level;
    EXPECT_EQ(added(m, POSE_WALL_YAW), 0.0) << "of the level that jumps are judged by";
    last = yaw.shown_motion;
  }
  EXPECT_EQ(last, kInfinite);
}

// A clock that jumped may hide a long gap: what came back to its place meanwhile proves no rest.
TEST(MotionInScan, AfterAJumpOfTheClockValuesNarrowNothing) {
  const pose_wall_odometry hardly = with_rates(0.0, 0.5);
  const auto added_by = [&](bool is_told) {
    Frames frames;
    Measurements last;
    for (int frame = 0; frame < 4; ++frame) {
      last = frames.measured;
      const ScanStep step{kScan_s, is_told || frame < 3};
      const ScanInTime time = scan_in_time({kScan_s, 0.5 * kScan_s}, step, frames.settings);
      MotionInScan(&hardly, frames.settings, kAxes).widen(true, time, {}, frames.walls, &frames.own, &last);
    }
    return added(last, POSE_WALL_YAW);
  };
  EXPECT_LT(added_by(true), 0.1 * added_by(false)) << "frame by frame the same values show that nothing turns";
  EXPECT_GT(added_by(false), 0.3 * kScan_s * 0.5 - 1e-3) << "what the odometry leaves open counts whole";
}

// As the key scan_max: 0 says.
TEST(MotionInScan, CloudsThatComeFreedOfMotionAreNotWidened) {
  Frames frames;
  frames.settings.scan_max = 0.0;
  for (const pose_wall_odometry* told : {&kHardlyKnown, static_cast<const pose_wall_odometry*>(nullptr)}) {
    for (int frame = 0; frame < 3; ++frame) {
      Measurements m = frames.measured;
      m.quantity[POSE_WALL_YAW].raw = 0.1 * frame;
      MotionInScan(told, frames.settings, kAxes)
          .widen(false, scan_in_time({}, {0.1}, frames.settings), {}, frames.walls, &frames.own, &m);
      for (const Measurement& q : m.quantity) EXPECT_EQ(q.shown_motion + q.protection[POSE_WALL_PART_AGE], 0.0);
    }
  }
}

// Frames of a machine that nobody tells of, with noise of one standard deviation of the random part.
struct Untold {
  Frames frames;
  std::mt19937 random{20261129};
  std::normal_distribution<double> noise{0.0, 1.0};
  double error_rad = 0.0;

  double added_to_yaw(double yaw_rad, double skew_rad, double since_s) {
    error_rad = skew_rad + noise(random) * frames.measured.quantity[POSE_WALL_YAW].sigma;
    Measurements m = frames.measured;
    m.quantity[POSE_WALL_YAW].raw = yaw_rad + error_rad;
    MotionInScan(nullptr, frames.settings, kAxes)
        .widen(false, scan_in_time({}, {since_s}, frames.settings), {}, frames.walls, &frames.own, &m);
    return m.quantity[POSE_WALL_YAW].shown_motion;
  }
};

// Slow turns hide in the noise, fast ones do not; frames may be lost, and scans be shorter than their step.
TEST(MotionInScan, ATurnThatNobodyTellsIsInTheLevelFromTheSecondFrameOn) {
  constexpr int kFrames = 200;  // judgement, 2026-11-29: of 54 turns, 10,800 draws of noise
  for (const double turn_in_scan : {0.2, 0.5, 1.0, 2.0, 5.0, 20.0}) {  // of the random part
    for (const double acts : {0.34, 0.5, kActs}) {
      for (const double since_s : {0.1, 0.15, 0.4}) {
        Untold turning;
        const double rate = turn_in_scan * kRandom / kScan_s;
        int beyond = 0;
        for (int frame = 0; frame < kFrames; ++frame) {
          const double level = kRandom + turning.added_to_yaw(frame * since_s * rate, acts * kScan_s * rate, since_s);
          if (frame > 0 && std::fabs(turning.error_rad) > level) ++beyond;
        }
        EXPECT_EQ(beyond, 0) << turn_in_scan << " " << acts << " " << since_s;
      }
    }
  }
}

// It stands, begins to turn within some frames, turns, and stops. What hides in the noise of a change is beyond the
// level by a part of that noise at most.
TEST(MotionInScan, ATurnThatBeginsIsInTheLevelWithoutAnOdometryToo) {
  constexpr double kHides = 0.5 * kRandom;  // measured, 2026-11-29: without it 2 of 400 frames are beyond
  for (const double turn_in_scan : {0.5, 2.0, 5.0, 20.0}) {  // of the random part
    for (const int begins_within : {1, 2, 5}) {
      Untold turning;
      double yaw_rad = 0.0, rate = 0.0;
      for (int frame = 0; frame < 400; ++frame) {
        const double most = turn_in_scan * kRandom / kScan_s, step = most / begins_within;
        const bool turns = frame % 20 >= 10;
        rate = turns ? std::min(most, rate + step) : std::max(0.0, rate - step);
        const double level = kRandom + turning.added_to_yaw(yaw_rad, kActs * kScan_s * rate, kScan_s);
        yaw_rad += kScan_s * rate;
        ASSERT_LE(std::fabs(turning.error_rad), level + kHides) << turn_in_scan << " " << begins_within << " " << frame;
      }
    }
  }
}

// Not as much as one that may just have begun.
TEST(MotionInScan, ASteadyTurnCostsItsShareOfAScan) {
  Untold turning;
  double most = 0.0;
  for (int frame = 0; frame < 100; ++frame) {
    const double turned = 10.0 * kRandom;
    const double level = turning.added_to_yaw(frame * turned, 0.5 * turned, kScan_s);
    if (frame > 2) most = std::max(most, level);
  }
  EXPECT_LT(most, (kActs * 10.0 + 2.0) * kRandom);
}

// The noise of a change is in a level already: a standing machine pays next to nothing.
TEST(MotionInScan, AStandingMachineThatNobodyTellsKeepsItsLevels) {
  Untold standing;
  double sum = 0.0;
  for (int frame = 0; frame < 1000; ++frame) sum += standing.added_to_yaw(0.0, 0.0, kScan_s);
  EXPECT_LT(sum / 1000, 0.02 * kRandom);
}

// Both ends of a wall on the same side of base: a turn shows less in their difference than in each of them.
TEST(MotionInScan, ATurnIsInDistancesWhereverTheyAreMeasured) {
  constexpr double kOffOfTurn = 1.26;  // of turn and lever: how far off a bent wall was at most
  const double ends_m[][2] = {{2.0, -2.0}, {8.0, 4.0}, {20.0, 18.0}, {-1.0, -6.0}};
  for (const auto& end_m : ends_m) {
    Frames frames;
    frames.settings.s_front = end_m[0];
    frames.settings.s_back = end_m[1];
    for (int frame = 0; frame < 6; ++frame) {
      Measurements m = frames.measured;
      const double turned_rad = 0.1 * kScan_s * frame, in_scan_rad = 0.1 * kScan_s;
      double error_m[2];
      for (std::uint32_t end = 0; end < 2; ++end) {
        error_m[end] = kOffOfTurn * in_scan_rad * end_m[end];
        m.quantity[POSE_WALL_D_RF + end].raw = turned_rad * end_m[end] + error_m[end];
      }
      MotionInScan(&kHardlyKnown, frames.settings, kAxes)
          .widen(false, {{kScan_s, 0.5 * kScan_s}, kScan_s}, {}, frames.walls, &frames.own, &m);
      for (std::uint32_t end = 0; end < 2; ++end) {
        EXPECT_GE(added(m, POSE_WALL_D_RF + end) + kRandom, std::fabs(error_m[end])) << end_m[end] << " m " << frame;
      }
    }
  }
}

// A period of four scans is the shortest that two changes show.
TEST(MotionInScan, AShakeOfFourScansIsInTheLevel) {
  constexpr double kTurns = 2.0 * 3.14159265358979;
  for (const double scans : {4.0, 5.0, 8.0, 20.0}) {
    for (double begin = 0.0; begin < 1.0; begin += 0.1) {
      Frames frames;
      double yaw_rad = 0.0;
      for (int frame = 0; frame < 30; ++frame) {
        const double rate = 0.3 * std::sin(kTurns * (begin + frame / scans));
        const double error_rad = kActs * kScan_s * rate;
        const double level = frames.added_to_yaw(kHardlyKnown, yaw_rad + error_rad);
        ASSERT_GE(level + kRandom, std::fabs(error_rad)) << scans << " scans from " << begin << " on, frame " << frame;
        yaw_rad += kScan_s * rate;
      }
    }
  }
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

TEST(MotionInScan, AWayAlongAWallAddsNothingToItsDistance) {
  pose_wall_odometry along_unknown = with_rates(0.0, 0.0), across_unknown = with_rates(0.0, 0.0);
  along_unknown.rate_level[0] = across_unknown.rate_level[1] = 5.0;
  Frames along, across;
  EXPECT_LT(added(along.next(along_unknown), POSE_WALL_D_LF), 1e-9);
  EXPECT_GT(added(across.next(across_unknown), POSE_WALL_D_LF), 0.3);
}

TEST(MotionInScan, IsTakenOutOnlyWhereThatNarrowsLevels) {
  Frames frames;
  frames.next(kHardlyKnown);
  const auto improves = [&](double turn, double level) {
    const pose_wall_odometry told = with_rates(turn, level);
    return MotionInScan(&told, frames.settings, kAxes).improves(frames.own);
  };
  EXPECT_TRUE(improves(0.5, 0.05)) << "a turn of 0.05 known to a tenth";
  EXPECT_FALSE(improves(0.5, 2.0)) << "a turn that may be none";
  EXPECT_TRUE(improves(0.0, 2.0)) << "nothing is taken out";
  frames.own.forget();
  EXPECT_FALSE(improves(0.5, 2.0)) << "and not after a frame without values";
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
