// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the refined floor's standard deviations are the spread that is seen over many noisy floors, and a floor that
// bends has a level that reaches its slope under the machine.

#include "stages/ground_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "estimation/protection.hpp"
#include "support/ground_fixture.hpp"

namespace pose_wall {
namespace {

FloorResult fit(test::GroundFixture* g, const Plane& start) {
  test::Placed<GroundScratch> scratch(g->points().set().capacity());
  return fit_floor(g->points().set(), g->points().all(), 3.0, start, g->settings(), Eigen::Vector3d::Zero(),
                   scratch.get());
}

Plane near_floor() {
  Plane p;
  p.n = Eigen::Vector3d(0.01, -0.01, 1.0).normalized();
  p.d = test::kFloorBelow_m - 0.01;
  return p;
}

// z^2 of 240 fits has a standard error of 0.09.
TEST(GroundFit, TheErrorsAreWhatTheStandardDeviationSays) {
  constexpr int kRuns = 240;
  test::Noise noise(1);
  double roll_z2 = 0.0, pitch_z2 = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    test::GroundFixture g;
    for (int i = 0; i < 2500; ++i) g.add(noise.uniform(-3, 3), noise.uniform(-2, 2), noise.normal(0.01));
    const FloorResult f = fit(&g, near_floor());
    ASSERT_TRUE(f.fit.found && !f.fit.refused);
    const RollPitch angles = roll_pitch_of_up(f.fit.plane.n);
    roll_z2 += std::pow(angles.roll_rad / f.roll_sigma_rad, 2) / kRuns;
    pitch_z2 += std::pow(angles.pitch_rad / f.pitch_sigma_rad, 2) / kRuns;
    EXPECT_NEAR(f.fit.plane.d, test::kFloorBelow_m, 0.002);
    EXPECT_NEAR(f.fit.rms_m, 0.01, 0.002);
  }
  RecordProperty("roll_z2", std::to_string(roll_z2));
  RecordProperty("pitch_z2", std::to_string(pitch_z2));
  EXPECT_GT(roll_z2, 0.4);
  EXPECT_LT(roll_z2, 1.6);
  EXPECT_GT(pitch_z2, 0.4);
  EXPECT_LT(pitch_z2, 1.6);
}

TEST(GroundFit, TheLevelOfABentFloorHoldsTheTiltUnderTheMachine) {
  test::GroundFixture g;
  test::Noise noise(2);
  // Seen ahead only, level under the machine and rising to 0.09 m: the plane through it is not the floor at u = 0.
  for (int i = 0; i < 4000; ++i) {
    const double x = noise.uniform(0, 3);
    g.add(x, noise.uniform(-2, 2), 0.01 * x * x + noise.normal(0.003));
  }
  const FloorResult f = fit(&g, near_floor());
  ASSERT_TRUE(f.fit.found);
  const double pitch = roll_pitch_of_up(f.fit.plane.n).pitch_rad;
  EXPECT_LE(std::fabs(pitch), f.pitch_bound_rad + protection_factor(5.0, f.dof) * f.pitch_sigma_rad);
}

TEST(GroundFit, TooFewPointsAreRefused) {
  test::GroundFixture g;
  for (int i = 0; i < 5; ++i) g.add(0.1 * i, 0.0, 0.0);
  const FloorResult f = fit(&g, near_floor());
  EXPECT_TRUE(f.fit.refused);
  EXPECT_FALSE(f.fit.found);
  EXPECT_NE(f.fit.reasons & POSE_WALL_R_FLOOR_THIN, 0U);
}

}  // namespace
}  // namespace pose_wall
