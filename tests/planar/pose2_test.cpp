// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "place/pose2.hpp"

#include <gtest/gtest.h>

namespace {

using pose_wall::kPi;
using namespace pose_wall::planar;

TEST(Pose2, AQuarterTurnToTheLeftThenAStepForwardGoesAlongY) {
  const Pose2 there = compose({1.0, 2.0, kPi / 2.0}, {3.0, 0.0, 0.0});
  EXPECT_NEAR(there.x_m, 1.0, 1e-12);
  EXPECT_NEAR(there.y_m, 5.0, 1e-12);
  EXPECT_NEAR(there.yaw_rad, kPi / 2.0, 1e-12);
}

TEST(Pose2, BetweenUndoesCompose) {
  const Pose2 a{3.0, -4.0, 2.9}, step{0.7, -0.2, 0.8};
  const Pose2 back = between(a, compose(a, step));
  EXPECT_NEAR(back.x_m, step.x_m, 1e-12);
  EXPECT_NEAR(back.y_m, step.y_m, 1e-12);
  EXPECT_NEAR(back.yaw_rad, step.yaw_rad, 1e-12);
  const Pose2 home = compose(a, inverse(a));
  EXPECT_NEAR(home.x_m, 0.0, 1e-12);
  EXPECT_NEAR(home.y_m, 0.0, 1e-12);
  EXPECT_NEAR(home.yaw_rad, 0.0, 1e-12);
}

TEST(Pose2, AnglesAreWrappedIntoOneTurn) {
  EXPECT_NEAR(wrapped(3.0 * kPi), kPi, 1e-12);
  EXPECT_NEAR(wrapped(-3.5 * kPi), 0.5 * kPi, 1e-12);
  EXPECT_NEAR(wrapped(100.0 * kPi + 0.25), 0.25, 1e-9);
  EXPECT_GT(wrapped(-kPi), 0.0);
}

}  // namespace
