// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what a pose is worth grows with the way and never shrinks by it; a turn that is off becomes a place that is
// off with the length of its lever; what slipped and what was lost adds to the levels in full.

#include "motion/travel.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace pose_wall::motion {
namespace {

constexpr double kFactor = 5.0;
const Eigen::Matrix3d kStraight = Eigen::Matrix3d::Identity();  // into a road along the map's x

SixBySix only(int k, double sigma) {
  SixBySix C = SixBySix::Zero();
  C(k, k) = sigma * sigma;
  return C;
}

Pieces along(double m) {
  Pieces pieces;
  pieces.add(m, Eigen::Vector3d::UnitX());
  return pieces;
}

Bounds bounds_of(const Travel& travel, double slipping_m = 0.0) {
  return travel.bounds(SixBySix::Zero(), along(slipping_m), kFactor);
}

// By how much a variance grew.
double grown(const Travel& travel, const Bounds& before, int k) {
  const double now = bounds_of(travel).sigma[k];
  return now * now - before.sigma[k] * before.sigma[k];
}

TEST(Travel, CountsTheWayAndTheWayBack) {
  Travel travel;
  travel.go({3.0, 0.0, 0.0}, kStraight);
  travel.go({-1.0, 0.0, 0.0}, kStraight);
  EXPECT_DOUBLE_EQ(travel.along_m(), 2.0);
  travel.reset();
  EXPECT_EQ(travel.along_m(), 0.0);
}

// Across by yaw, up by pitch: L times the angle.
TEST(Travel, ATurnThatIsOffBecomesAPlaceThatIsOff) {
  const struct {
    int turn, place;
  } levers[] = {{POSE_WALL_MOTION_YAW, POSE_WALL_MOTION_ACROSS}, {POSE_WALL_MOTION_PITCH, POSE_WALL_MOTION_UP}};
  for (const auto& lever : levers) {
    Travel travel;
    const Bounds fresh = bounds_of(travel);
    travel.take_in(SixBySix::Zero(), 9);
    const Bounds floor = bounds_of(travel);
    Travel turned;
    turned.take_in(only(lever.turn, 0.01), 9);
    const Bounds before = bounds_of(turned);
    const double variance = before.sigma[lever.turn] * before.sigma[lever.turn] -
                            fresh.sigma[lever.turn] * fresh.sigma[lever.turn];  // of the map's turn
    turned.go({10.0, 0.0, 0.0}, kStraight);
    EXPECT_NEAR(grown(turned, before, lever.place), 100.0 * variance, 1e-9 + 1e-6 * 100.0 * variance);
    EXPECT_NEAR(grown(turned, before, lever.turn), 0.0, 1e-15);
    turned.go({-10.0, 0.0, 0.0}, kStraight);
    EXPECT_NEAR(grown(turned, before, lever.place), 0.0, 1e-12) << "back where it was";
    EXPECT_GT(before.sigma[lever.turn], floor.sigma[lever.turn]);
  }
}

// Ground that is seen 9 m behind alone: what pitches the machine lifts it, so height is as doubtful as pitch.
TEST(Travel, APlaceThatHangsOnATurnIsDoubtedWithIt) {
  constexpr double kLever_m = 9.0, kPitch_rad = 0.001, kOwn_m = 0.0005;  // as of a VLP-16 before a face
  SixBySix C = only(POSE_WALL_MOTION_PITCH, kPitch_rad);
  C(POSE_WALL_MOTION_UP, POSE_WALL_MOTION_UP) = std::pow(kLever_m * kPitch_rad, 2) + kOwn_m * kOwn_m;
  C(POSE_WALL_MOTION_UP, POSE_WALL_MOTION_PITCH) = -kLever_m * kPitch_rad * kPitch_rad;
  C(POSE_WALL_MOTION_PITCH, POSE_WALL_MOTION_UP) = C(POSE_WALL_MOTION_UP, POSE_WALL_MOTION_PITCH);
  const Six level = Travel().level_of(C, Pieces{}, kFactor);
  EXPECT_GT(level[POSE_WALL_MOTION_UP], 0.99 * kLever_m * level[POSE_WALL_MOTION_PITCH]);
  const Six apart = Travel().level_of(only(POSE_WALL_MOTION_UP, kLever_m * kPitch_rad), Pieces{}, kFactor);
  EXPECT_LT(apart[POSE_WALL_MOTION_UP], 1.01 * kFactor * kLever_m * kPitch_rad) << "a height of its own is not";
  EXPECT_LT(level[POSE_WALL_MOTION_ACROSS], 0.01) << "nor is what hangs on another turn";
}

// Two keyframes on the way: the first turn has the whole lever, the second one half of it.
TEST(Travel, LeversAddUpKeyframeByKeyframe) {
  Travel once, twice;
  once.take_in(only(POSE_WALL_MOTION_YAW, 0.01), 9);
  const double turn2 = std::pow(bounds_of(once).sigma[POSE_WALL_MOTION_YAW], 2) -
                       std::pow(bounds_of(Travel()).sigma[POSE_WALL_MOTION_YAW], 2);
  twice.take_in(only(POSE_WALL_MOTION_YAW, 0.01), 9);
  twice.go({5.0, 0.0, 0.0}, kStraight);
  const Bounds before = bounds_of(twice);
  twice.take_in(only(POSE_WALL_MOTION_YAW, 0.01), 9);
  const double by_keyframe = grown(twice, before, POSE_WALL_MOTION_ACROSS);
  const double start = std::pow(bounds_of(once).sigma[POSE_WALL_MOTION_ACROSS], 2);
  twice.go({5.0, 0.0, 0.0}, kStraight);
  const double across2 = std::pow(bounds_of(twice).sigma[POSE_WALL_MOTION_ACROSS], 2);
  EXPECT_NEAR(across2, start + by_keyframe + (100.0 + 25.0) * turn2, 1e-6 * across2);
}

TEST(Travel, LevelsGrowWithTheWay) {
  Travel travel;
  SixBySix C = SixBySix::Identity() * 1e-6;
  Bounds before = bounds_of(travel);
  for (int i = 0; i < 200; ++i) {
    travel.go({0.2, 0.0, 0.0}, kStraight);
    travel.take_in(C, 9);
    const Bounds now = bounds_of(travel);
    for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
      ASSERT_GT(now.sigma[k], before.sigma[k]) << k;
      ASSERT_GT(now.level[k], before.level[k]) << k;
      ASSERT_GE(now.level[k], now.sigma[k]) << k;
    }
    before = now;
  }
}

TEST(Travel, WhatSlippedAddsToTheLevelAlongInFull) {
  Travel travel;
  const double before = bounds_of(travel).level[POSE_WALL_MOTION_ALONG];
  EXPECT_NEAR(bounds_of(travel, 0.3).level[POSE_WALL_MOTION_ALONG], before + 0.3, 1e-12) << "and may be told again";
  EXPECT_NEAR(bounds_of(travel).level[POSE_WALL_MOTION_ALONG], before, 1e-12);
  travel.slip(along(0.3), 0.0);
  EXPECT_NEAR(bounds_of(travel).level[POSE_WALL_MOTION_ALONG], before + 0.3, 1e-12);
  travel.slip(along(0.2), 0.0);
  EXPECT_NEAR(bounds_of(travel).level[POSE_WALL_MOTION_ALONG], before + 0.5, 1e-12);
  EXPECT_GE(bounds_of(travel).sigma[POSE_WALL_MOTION_ALONG], 0.5 / std::sqrt(3.0)) << "even within its bounds";
}

// In a hall the axis that surfaces hold least turns, and what slipped along the old one is across the new one.
TEST(Travel, WhatSlippedStaysWhereItSlippedWhenTheRoadTurns) {
  Eigen::Matrix3d to_the_left;
  to_the_left << 0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  Travel travel;
  travel.take_in(only(POSE_WALL_MOTION_ALONG, 0.02), 9);
  const Bounds before = bounds_of(travel);
  travel.slip(along(0.3), 0.0);
  travel.go(Eigen::Vector3d::Zero(), to_the_left);
  const Bounds now = bounds_of(travel);
  EXPECT_NEAR(now.level[POSE_WALL_MOTION_ACROSS], before.level[POSE_WALL_MOTION_ALONG] + 0.3, 1e-12);
  EXPECT_NEAR(now.level[POSE_WALL_MOTION_ALONG], before.level[POSE_WALL_MOTION_ACROSS], 1e-12);
  EXPECT_NEAR(bounds_of(travel, 0.1).level[POSE_WALL_MOTION_ACROSS], now.level[POSE_WALL_MOTION_ACROSS] + 0.1, 1e-12);
}

// Whatever errors have in common, no axis has a negative variance of them.
TEST(Travel, ACovarianceTurnsWithTheAxes) {
  constexpr double kAlong = 4e-4, kAcross = 1e-4, kOfBoth = 1.9e-4;  // 2 and 1 cm, correlated by 0.95
  SixBySix C = SixBySix::Zero();
  C(POSE_WALL_MOTION_ALONG, POSE_WALL_MOTION_ALONG) = kAlong;
  C(POSE_WALL_MOTION_ACROSS, POSE_WALL_MOTION_ACROSS) = kAcross;
  C(POSE_WALL_MOTION_ALONG, POSE_WALL_MOTION_ACROSS) = C(POSE_WALL_MOTION_ACROSS, POSE_WALL_MOTION_ALONG) = kOfBoth;
  for (int k = 0; k <= 36; ++k) {
    const Eigen::Matrix3d now = turn_by(Eigen::Vector3d(0.0, 0.0, 0.1 * k)).transpose();
    const SixBySix there = turned(C, kStraight, now);
    EXPECT_NEAR(there.trace(), C.trace(), 1e-12);
    EXPECT_GT((there.topLeftCorner<2, 2>().determinant()), 0.0);
    EXPECT_LT((turned(there, now, kStraight) - C).norm(), 1e-12) << k;
  }
  Eigen::Matrix3d to_the_left;
  to_the_left << 0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, 1.0;
  EXPECT_NEAR(turned(C, kStraight, to_the_left)(POSE_WALL_MOTION_ACROSS, POSE_WALL_MOTION_ACROSS), kAlong, 1e-12);
}

// Pieces in several directions: never less than the truth, which may add up all of them.
TEST(Travel, PiecesOfAWayAreBoundedInEveryDirection) {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int run = 0; run < 100; ++run) {
    Pieces pieces;
    std::vector<Eigen::Vector3d> all;
    for (int k = 0; k < 6; ++k) {
      all.push_back({normal(random), normal(random), normal(random)});
      pieces.add(all.back().norm(), all.back().normalized());
    }
    const Eigen::Vector3d direction = Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
    double worst = 0.0, length = 0.0;
    for (const Eigen::Vector3d& piece : all) worst += std::fabs(piece.dot(direction)), length += piece.norm();
    EXPECT_GE(pieces.towards(direction), worst * (1.0 - 1e-12));
    EXPECT_LE(pieces.towards(direction), length * (1.0 + 1e-12));
  }
}

// Surfaces of another place slope otherwise: by the unevenness, with the way as lever.
TEST(Travel, ASlipOnUnevenGroundWidensTheOthersToo) {
  Travel travel;
  const Bounds before = bounds_of(travel);
  travel.slip(along(0.5), 0.01);
  for (const int k : {POSE_WALL_MOTION_ROLL, POSE_WALL_MOTION_PITCH, POSE_WALL_MOTION_YAW}) {
    EXPECT_NEAR(grown(travel, before, k), 1e-4, 1e-12);
  }
  for (const int k : {POSE_WALL_MOTION_ACROSS, POSE_WALL_MOTION_UP}) {
    EXPECT_NEAR(grown(travel, before, k), 0.25 * 1e-4, 1e-12);
  }
}

TEST(Travel, WhatWasLostAddsToEveryLevelInFull) {
  Travel travel;
  const Bounds before = bounds_of(travel);
  travel.lose(0.2, 0.05);
  travel.lose(0.3, 0.01);
  const Bounds now = bounds_of(travel);
  for (int k = 0; k < POSE_WALL_MOTION_DIRECTIONS; ++k) {
    EXPECT_NEAR(now.level[k], before.level[k] + (k >= POSE_WALL_MOTION_ROLL ? 0.06 : 0.5), 1e-12) << k;
  }
  travel.reset();
  EXPECT_EQ(bounds_of(travel).level, before.level);
}

// A turn that was lost has a lever as well: what lies ahead of it is off by the way times the turn.
TEST(Travel, ATurnThatWasLostBecomesAPlaceThatIsLost) {
  Travel travel;
  travel.lose(0.0, 0.1);
  const double before = bounds_of(travel).level[POSE_WALL_MOTION_ACROSS];
  travel.go({10.0, 0.0, 0.0}, kStraight);
  EXPECT_GE(bounds_of(travel).level[POSE_WALL_MOTION_ACROSS], before + 10.0 * 0.1 * 0.99);
}

TEST(Travel, AStepIsWorthItsTwoEndsAndItsSlip) {
  const Bounds still = Travel().of_step(SixBySix::Zero(), SixBySix::Zero(), Pieces{}, kFactor);
  const Bounds both = Travel().of_step(only(1, 0.03), only(1, 0.04), Pieces{}, kFactor);
  const double floor2 = still.sigma[1] * still.sigma[1];
  EXPECT_NEAR(both.sigma[1] * both.sigma[1], floor2 + 0.0025, 1e-12) << "3, 4, 5";
  EXPECT_NEAR(both.level[1], kFactor * both.sigma[1], 1e-12);
  const Bounds slipped = Travel().of_step(SixBySix::Zero(), SixBySix::Zero(), along(0.2), kFactor);
  EXPECT_NEAR(slipped.level[POSE_WALL_MOTION_ALONG], still.level[POSE_WALL_MOTION_ALONG] + 0.2, 1e-12);
  EXPECT_EQ(slipped.level[POSE_WALL_MOTION_ACROSS], still.level[POSE_WALL_MOTION_ACROSS]);
}

// The map is the mean of its scans: of two, the second's error is half of the map's.
TEST(Travel, AYoungMapKeepsMoreOfAScansError) {
  const double along_m = 0.01;
  double before = INFINITY;
  for (const std::uint32_t keyframes : {2U, 3U, 10U}) {
    Travel travel;
    travel.take_in(only(POSE_WALL_MOTION_ALONG, along_m), keyframes);
    const double sigma = travel.bounds(SixBySix::Zero(), Pieces{}, 5.0).sigma[POSE_WALL_MOTION_ALONG];
    EXPECT_LT(sigma, before);
    before = sigma;
    EXPECT_NEAR(sigma, along_m * std::max(0.3, 1.0 / keyframes), 1e-4);
  }
}

}  // namespace
}  // namespace pose_wall::motion
