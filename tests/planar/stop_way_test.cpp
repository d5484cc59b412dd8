// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The way of base against drawn truth: what it says to know of places and speeds must hold the truth.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "base/containers/arena.hpp"
#include "planar/encounter/draw.hpp"
#include "planar/stop/way.hpp"
#include "support/aligned_block.hpp"

namespace {

using namespace pose_wall::test;
using pose_wall::Arena;
using pose_wall::planar::between;
using pose_wall::planar::compose;
using pose_wall::planar::MeasuredMotion;
using pose_wall::planar::Pose2;
using pose_wall::planar::Way;

constexpr std::int64_t kBetweenFrames_ns = 100'000'000;
constexpr double kBetweenFrames_s = 0.1;
constexpr std::uint32_t kWayFirst_ms = 1'000'000;

class WayUnderTest {
 public:
  explicit WayUnderTest(double acceleration_m_s2 = 0.5) : block_(1U << 20U, Dirt::kRandom) {
    Arena arena(block_.data());
    way_.lay_out(arena);
    way_.open({acceleration_m_s2, kLever_m, 2.3, 5.0, Eigen::Vector2d::UnitX()});
  }
  static constexpr double kLever_m = 3.0;

  void go(const Pose2& step, double error_m) {
    ++frames_;
    way_.go(stamp_ns(frames_), ms(frames_), step, error_m);
  }
  static std::int64_t stamp_ns(int frame) { return 5'000'000'000 + frame * kBetweenFrames_ns; }
  static std::uint32_t ms(int frame) { return kWayFirst_ms + static_cast<std::uint32_t>(100 * frame); }
  int frames() const { return frames_; }
  std::uint32_t now_ms() const { return ms(frames_); }
  Way& way() { return way_; }

 private:
  AlignedBlock block_;
  Way way_;
  int frames_ = 0;
};

pose_wall_odometry odometry_at(const Pose2& at, double level_m, double level_rad, std::uint64_t run = 1) {
  pose_wall_odometry o{};
  o.run = run;
  o.position_m[0] = at.x_m, o.position_m[1] = at.y_m;
  o.quaternion[2] = std::sin(0.5 * at.yaw_rad), o.quaternion[3] = std::cos(0.5 * at.yaw_rad);
  o.along[0] = o.across[1] = 1.0;
  o.level[0] = o.level[1] = level_m, o.level[5] = level_rad;
  return o;
}

// As a float the sum would lose millimetres within a day without a given motion.
TEST(StopWay, DriftIsToldHoweverMuchHasAddedUp) {
  WayUnderTest test;
  for (int frame = 0; frame < 100000; ++frame) test.go(Pose2(), 1.0);
  for (int frame = 0; frame < 10; ++frame) test.go(Pose2(), 0.0);  // moments of a quarter second are not told apart
  const std::uint32_t then = test.now_ms();
  EXPECT_EQ(test.way().error_m(then), 0.0F);
  for (int frame = 0; frame < 100; ++frame) test.go(Pose2(), 0.0025);
  EXPECT_GE(test.way().error_m(then), 0.2499F);
  EXPECT_LT(test.way().error_m(then), 0.252F);
}

TEST(StopWay, WhatWasForgottenOrNeverWasIsNotKnown) {
  WayUnderTest test;
  for (int frame = 0; frame < 20; ++frame) test.go(Pose2(), 0.0);
  const std::uint32_t then = test.now_ms();
  test.go(Pose2(), 0.0);
  EXPECT_EQ(test.way().error_m(then), 0.0F);
  EXPECT_EQ(test.way().error_m(then + 500000), std::numeric_limits<float>::infinity());
  for (int frame = 0; frame < 5; ++frame) test.go(Pose2(), 0.0);  // moments of a quarter second are not told apart
  test.way().forget();
  test.go(Pose2(), 0.0);
  EXPECT_EQ(test.way().error_m(then), std::numeric_limits<float>::infinity());
}

TEST(StopWay, OdometriesThatAreNoneAreRefused) {
  WayUnderTest test;
  test.go(Pose2(), 0.0);
  const std::int64_t stamp_ns = WayUnderTest::stamp_ns(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto refused = [&](const auto& spoil) {
    pose_wall_odometry o = odometry_at(Pose2(), 0.01, 0.001);
    spoil(&o);
    return !test.way().note(o, stamp_ns);
  };
  EXPECT_TRUE(refused([](auto* o) { o->run = 0; }));
  EXPECT_TRUE(refused([&](auto* o) { o->position_m[1] = nan; }));
  EXPECT_TRUE(refused([](auto* o) { o->position_m[0] = 1e9; }));
  EXPECT_TRUE(refused([](auto* o) { o->quaternion[0] = 0.5; }));
  EXPECT_TRUE(refused([&](auto* o) { o->quaternion[3] = nan; }));
  EXPECT_TRUE(refused([](auto* o) { o->level[0] = -0.1; }));
  EXPECT_TRUE(refused([&](auto* o) { o->drift[5] = nan; }));
  EXPECT_TRUE(refused([&](auto* o) { o->drift_variance[2] = nan; }));
  EXPECT_FALSE(refused([](auto*) {}));
  EXPECT_FALSE(refused([](auto* o) { o->level[0] = std::numeric_limits<double>::infinity(); })) << "it tells nothing";
}

// A machine that drives about, with speeds that are off by up to a fifth, and an odometry that comes up to four frames
// late. It is missing for seconds, begins anew, and errs within its levels and drift.
class DrawnWay {
 public:
  explicit DrawnWay(std::uint64_t seed) : draw_(seed) {}

  void drive(int frames) {
    for (int k = 0; k < frames; ++k) frame();
  }
  int checked() const { return checked_; }
  int known() const { return known_; }
  double least_m() const { return least_m_; }

 private:
  void frame() {
    const double wish = draw_.happens(0.02) ? draw_.within(-0.5, 1.0) : wish_;
    wish_ = wish;
    const double change = kAcceleration * kBetweenFrames_s;
    const double before = speed_;
    speed_ += std::fmax(-change, std::fmin(change, wish_ - speed_));
    turn_ += std::fmax(-0.02, std::fmin(0.02, draw_.within(-0.1, 0.1) - turn_));
    const double mean = 0.5 * (before + speed_);
    truth_ = compose(truth_, {mean * kBetweenFrames_s, 0.0, turn_ * kBetweenFrames_s});
    const double told = mean * draw_.within(0.8, 1.2);
    test_.go({told * kBetweenFrames_s, 0.0, turn_ * kBetweenFrames_s}, 0.2 * std::fabs(mean) * kBetweenFrames_s + 1e-4);
    truths_.push_back(truth_);
    if (draw_.happens(0.01)) gap_ = 5 + static_cast<int>(draw_.below(40)), ++run_, drifted_ = Pose2(), drift_ = 0.0;
    if (gap_ > 0) --gap_;
    odometry();
    check();
  }

  void odometry() {
    const int late = static_cast<int>(draw_.below(5));
    const int of = test_.frames() - late;
    if (gap_ > 0 || of < 1) return;
    constexpr double kLevel_m = 0.03, kLevel_rad = 0.002, kDrift_m = 0.0005;
    drift_ += kDrift_m;
    drifted_.x_m += draw_.within(-0.9, 0.9) * kDrift_m;
    const double e = 0.9 * kLevel_m;
    const Pose2 seen = compose(compose(drifted_, truths_[static_cast<std::size_t>(of) - 1]),
                               {draw_.within(-e, e), draw_.within(-e, e) * 0.4, draw_.within(-0.0018, 0.0018)});
    pose_wall_odometry o = odometry_at(seen, kLevel_m, kLevel_rad, run_);
    o.drift[0] = drift_;
    EXPECT_TRUE(test_.way().note(o, WayUnderTest::stamp_ns(of)));
  }

  // Places around base, then and now: each was put down where base was thought to be.
  void check() {
    const Pose2 thought = test_.way().base();
    thoughts_.push_back(thought);
    for (const int back : {1, 5, 20, 80}) {
      const int then = test_.frames() - back;
      if (then < 1) continue;
      const auto index = static_cast<std::size_t>(then) - 1;
      const double error = static_cast<double>(test_.way().error_m(WayUnderTest::ms(then)));
      ++checked_;
      if (!(error < 0.3)) continue;
      ++known_;
      const Pose2 moved = between(truths_[index], truth_), told = between(thoughts_[index], thought);
      const Pose2 off = between(moved, told);
      const double off_m = std::hypot(off.x_m, off.y_m) + WayUnderTest::kLever_m * std::fabs(off.yaw_rad);
      least_m_ = std::fmin(least_m_, error - off_m);
    }
    const MeasuredMotion motion = test_.way().motion(WayUnderTest::stamp_ns(test_.frames()));
    if (!motion.is_known) return;
    EXPECT_LE(std::fabs(motion.speed_m_s - speed_), motion.speed_error_m_s) << test_.frames();
  }

  static constexpr double kAcceleration = 0.5;
  WayUnderTest test_{kAcceleration};
  Draw draw_;
  Pose2 truth_, drifted_;
  std::vector<Pose2> truths_, thoughts_;
  double speed_ = 0.0, turn_ = 0.0, wish_ = 0.0, drift_ = 0.0, least_m_ = 1.0;
  std::uint64_t run_ = 1;
  int gap_ = 0, checked_ = 0, known_ = 0;
};

TEST(StopWay, ErrorsHoldTheTruthWithALateOdometryThatComesAndGoes) {
  int known = 0, checked = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    DrawnWay way(seed);
    way.drive(600);
    EXPECT_GE(way.least_m(), 0.0) << seed;
    known += way.known(), checked += way.checked();
  }
  EXPECT_GT(known, checked / 2) << "bounds that are always wide hold nothing";
}

// By dead reckoning alone a fifth of the speed would be forgotten after 1.5 m.
TEST(StopWay, AnOdometryKeepsTheMemoryOfALongDrive) {
  for (const bool is_seen : {false, true}) {
    WayUnderTest test;
    test.go(Pose2(), 0.0);
    const std::uint32_t then = test.now_ms();
    Pose2 truth;
    for (int frame = 0; frame < 600; ++frame) {
      truth.x_m += 0.01;
      test.go({0.009, 0.0, 0.0}, 0.002);
      if (is_seen) {
        EXPECT_TRUE(test.way().note(odometry_at(truth, 0.02, 0.0), WayUnderTest::stamp_ns(test.frames())));
      }
    }
    EXPECT_EQ(test.way().error_m(then) < 0.3F, is_seen);
    if (is_seen) {
      EXPECT_NEAR(test.way().base().x_m, 6.0, 0.05);
    }
  }
}

TEST(StopWay, TheSpeedOfALongerWhileIsKnownBetterUntilTheDriveMayHaveChangedIt) {
  WayUnderTest slow(0.02), quick(2.0);
  for (WayUnderTest* const test : {&slow, &quick}) {
    for (int frame = 0; frame < 15; ++frame) {
      test->go({0.02, 0.0, 0.0}, 0.01);
      test->way().note(odometry_at({0.02 * frame, 0.0, 0.0}, 0.01, 0.001), WayUnderTest::stamp_ns(test->frames()));
    }
  }
  const MeasuredMotion a = slow.way().motion(WayUnderTest::stamp_ns(15));
  const MeasuredMotion b = quick.way().motion(WayUnderTest::stamp_ns(15));
  EXPECT_NEAR(a.speed_m_s, 0.2, 1e-9);
  EXPECT_LT(a.speed_error_m_s, 0.04) << "0.02 m in a second, and half a second's change";
  EXPECT_GT(b.speed_error_m_s, 0.2) << "the drive may have stopped meanwhile";
}

}  // namespace
