// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the motion told for the next scan is that of the last step where it shows, and nothing where it does not.
// Its level holds the errors that the steps show, soon after these grow and not long after they end. Before anything is
// known it is the machine's limits, twice. The motion that is expected follows a stop after a gap at once, and hardly a
// step of a millisecond.

#include "motion/scan_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/expect.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall::motion {
namespace {

constexpr double kFactor = 4.89;  // of a risk of 1e-6
constexpr double kSigma = 0.002;  // of a step's rates
constexpr int kYaw = POSE_WALL_MOTION_YAW;

Six all(double number) {
  return Six::Constant(number);
}

Six noise_of(pose_wall::test::Noise* noise, double sigma) {
  Six out;
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) out[k] = noise->normal(sigma);
  return out;
}

TEST(ScanMotion, BeforeAStepOnlyTheLimitsAreKnown) {
  ScanMotion motion;
  motion.forget(2.0, 1.5);
  EXPECT_TRUE(motion.rate().isZero());
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) EXPECT_EQ(motion.level(kFactor)[k], k < 3 ? 4.0 : 3.0) << k;
}

// Steps of a standing machine are noise; a scan that they were taken out of would be bent by them.
TEST(ScanMotion, AStandingMachineIsLeftAlone) {
  pose_wall::test::Noise noise(1);
  ScanMotion motion;
  motion.forget(2.0, 1.5);
  int told = 0;
  for (int frame = 0; frame < 1000; ++frame) {
    motion.learn(noise_of(&noise, kSigma), all(kSigma * kSigma));
    told += motion.rate().isZero() ? 0 : 1;
    ASSERT_LT(motion.level(kFactor).maxCoeff(), 5.0 * kFactor * kSigma) << frame;
  }
  EXPECT_LE(told, 10) << "of a variance of 16 steps five deviations are rare";
}

// The same noise of a step is fifty times as fast after a fiftieth of the time.
TEST(ScanMotion, AStepOfMillisecondsTellsNoMotion) {
  constexpr double kFaster = 50.0;  // 2 ms instead of a tenth of a second
  pose_wall::test::Noise noise(8);
  ScanMotion motion;
  motion.forget(2.0, 1.5);
  for (int frame = 0; frame < 100; ++frame) motion.learn(noise_of(&noise, kSigma), all(kSigma * kSigma));
  const double level = motion.level(kFactor).maxCoeff();
  const double sigma = kFaster * kSigma;
  motion.learn(all(3.0 * sigma), all(sigma * sigma), 2.0 / (kFaster * kFaster));
  EXPECT_TRUE(motion.rate().isZero());
  EXPECT_LT(motion.level(kFactor).maxCoeff(), 1.5 * level);
}

TEST(ScanMotion, ASteadyTurnIsToldAndItsLevelIsThatOfTheNoise) {
  constexpr double kTurn = 0.1;  // rad/s: 6 degrees a second
  pose_wall::test::Noise noise(2);
  ScanMotion motion;
  motion.forget(2.0, 1.5);
  int outside = 0;
  for (int frame = 0; frame < 500; ++frame) {
    Six rate = noise_of(&noise, kSigma);
    rate[kYaw] += kTurn;
    motion.learn(rate, all(kSigma * kSigma));
    EXPECT_NEAR(motion.rate()[kYaw], kTurn, 6.0 * kSigma);
    outside += std::fabs(motion.rate()[kYaw] - kTurn) > motion.level(kFactor)[kYaw] ? 1 : 0;
    if (frame > 0) {
      EXPECT_LT(motion.level(kFactor)[kYaw], 4.0 * kFactor * kSigma) << frame;
    }
  }
  EXPECT_EQ(outside, 0);
}

// The machine stands for long, then turns, then stands again.
TEST(ScanMotion, ATurnIsToldSoonAfterItBeginsAndEnds) {
  pose_wall::test::Noise noise(3);
  ScanMotion motion;
  motion.forget(2.0, 1.5);
  const auto go = [&](double turn, int frames) {
    for (int frame = 0; frame < frames; ++frame) {
      Six rate = noise_of(&noise, kSigma);
      rate[kYaw] += turn;
      motion.learn(rate, all(kSigma * kSigma));
    }
  };
  go(0.0, 40);
  go(0.17, 3);
  EXPECT_NEAR(motion.rate()[kYaw], 0.17, 6.0 * kSigma);
  go(0.17, 20);
  EXPECT_LT(motion.level(kFactor)[kYaw], 0.17) << "the jerk is over";
  go(0.0, 3);
  EXPECT_NEAR(motion.rate()[kYaw], 0.0, 6.0 * kSigma);
  go(0.0, 100);
  EXPECT_EQ(motion.rate()[kYaw], 0.0);
  EXPECT_LT(motion.level(kFactor)[kYaw], 5.0 * kFactor * kSigma);
}

// Each next step is what the last one was told for; only the very first is nobody's fault, since machines are heavy.
TEST(ScanMotion, AChangingMotionIsWithinTheLevel) {
  ScanMotion motion;
  motion.forget(2.0, 1.5);
  for (int frame = 0; frame < 40; ++frame) motion.learn(all(0.0), all(kSigma * kSigma));
  double rate = 0.0;
  int outside = 0;
  for (int frame = 0; frame < 20; ++frame) {  // 5 degrees a second more each second
    const double next = rate + 0.00873;
    Six step = all(0.0);
    step[kYaw] = next;
    if (frame > 0 && std::fabs(next - motion.rate()[kYaw]) > motion.level(kFactor)[kYaw]) ++outside;
    motion.learn(step, all(kSigma * kSigma));
    rate = next;
  }
  EXPECT_LE(outside, 2);
  EXPECT_EQ(motion.rate()[kYaw], rate);
}

TEST(ScanMotion, SlipAlongStaysAlong) {
  ScanMotion motion;
  motion.forget(2.0, 1.5);
  for (int frame = 0; frame < 20; ++frame) {
    motion.learn(all(0.0), all(kSigma * kSigma));
    motion.set_along(0.3, 2.0);
  }
  EXPECT_EQ(motion.rate()[POSE_WALL_MOTION_ALONG], 0.3);
  EXPECT_GE(motion.level(kFactor)[POSE_WALL_MOTION_ALONG], 4.0);
  for (int k = POSE_WALL_MOTION_ACROSS; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    EXPECT_LT(motion.level(kFactor)[k], kFactor * kSigma) << k;
  }
}

constexpr double kBetween_s = 0.1;  // of a sensor with 10 scans a second

// Learns steps along its road.
class Machine {
 public:
  Machine() {
    last_.frames = 10;
    last_.axes.along = Eigen::Vector3d::UnitX();
    model_.reset(settings_);
  }
  // noise_m: by which the alignment errs.
  void drive(double speed_m_s, double dt_s, double noise_m = 0.0) {
    MotionStep step;
    step.s = dt_s;
    step.m.x() = speed_m_s * dt_s + noise_m;
    step.variance.fill(1e-6);
    step.is_along_known = true;
    model_.learn(last_, last_.axes, settings_, step, dt_s);
  }
  double expected_m_s() const { return model_.twist().velocity_m_s.x(); }

 private:
  MotionSettings settings_;
  Course last_;
  MotionModel model_;
};

TEST(MotionModel, AfterAGapItFollowsAStopAtOnce) {
  Machine machine;
  for (int frame = 0; frame < 20; ++frame) machine.drive(1.0, kBetween_s);
  EXPECT_NEAR(machine.expected_m_s(), 1.0, 1e-3);
  machine.drive(1.0, 5.0);
  for (int frame = 0; frame < 6; ++frame) machine.drive(0.0, kBetween_s);
  EXPECT_LT(machine.expected_m_s(), 0.05) << "half of what is left in each frame";
}

TEST(MotionModel, AStepOfAMillisecondMovesItHardly) {
  constexpr double kNoise_m = 0.002;  // as two looks at smooth walls differ
  Machine machine;
  for (int frame = 0; frame < 20; ++frame) machine.drive(0.0, kBetween_s);
  machine.drive(0.0, 0.001, kNoise_m);
  EXPECT_LT(std::fabs(machine.expected_m_s()), 0.01) << "2 mm in a millisecond are 2 m/s";
}

}  // namespace
}  // namespace pose_wall::motion
