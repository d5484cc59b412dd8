// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the refined floor's standard deviations are the spread that is seen over many noisy floors, a floor that
// bends or waves has a level that says so, and a wall's foot does not tilt it; inliers are those within the radius; of
// many points no side goes short.

#include "engine/floor/fit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/estimation/protection.hpp"
#include "support/floor_fixture.hpp"

namespace pose_wall {
namespace {

FloorResult fit_within(test::FloorFixture* g, const PointSet& within, const Plane& start,
                       const Eigen::Vector3d& sensor_base_m = Eigen::Vector3d::Zero()) {
  test::Placed<FloorScratch> scratch(g->points().set().capacity());
  scratch->grid.find_open(g->points().set(), 15.0, sensor_base_m.z(), scratch->low, &scratch->open_base);
  return fit_floor(g->scene(sensor_base_m), {3.0, g->points().set(), within}, start, scratch.get());
}

FloorResult fit(test::FloorFixture* g, const Plane& start,
                const Eigen::Vector3d& sensor_base_m = Eigen::Vector3d::Zero()) {
  return fit_within(g, g->points().set(), start, sensor_base_m);
}

Plane near_floor() {
  Plane p;
  p.n = Eigen::Vector3d(0.01, -0.01, 1.0).normalized();
  p.d = test::kFloorBelow_m - 0.01;
  return p;
}

// z^2 of 240 fits has a standard error of 0.09.
TEST(FloorFit, TheErrorsAreWhatTheStandardDeviationSays) {
  constexpr int kRuns = 240;
  test::Noise noise(1);
  double roll_z2 = 0.0, pitch_z2 = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    test::FloorFixture g;
    for (int i = 0; i < 2500; ++i) g.add(noise.uniform(-3, 3), noise.uniform(-2, 2), noise.normal(0.01));
    const FloorResult f = fit(&g, near_floor());
    ASSERT_TRUE(f.fit.found && !f.fit.refused);
    const RollPitch angles = roll_pitch_of_up(f.fit.plane.n);
    roll_z2 += std::pow(angles.roll_rad / f.roll.sigma_rad, 2) / kRuns;
    pitch_z2 += std::pow(angles.pitch_rad / f.pitch.sigma_rad, 2) / kRuns;
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

TEST(FloorFit, TheLevelOfABentFloorHoldsTheTiltUnderTheMachine) {
  test::FloorFixture g;
  test::Noise noise(2);
  // Seen ahead only, level under the machine and rising to 0.09 m: the plane through it is not the floor at u = 0.
  for (int i = 0; i < 4000; ++i) {
    const double x = noise.uniform(0, 3);
    g.add(x, noise.uniform(-2, 2), 0.01 * x * x + noise.normal(0.003));
  }
  const FloorResult f = fit(&g, near_floor());
  ASSERT_TRUE(f.fit.found);
  const double pitch = roll_pitch_of_up(f.fit.plane.n).pitch_rad;
  EXPECT_LE(std::fabs(pitch), f.pitch.bound_rad.sum() + protection_factor(5.0, f.roll.dof) * f.pitch.sigma_rad);
}

TEST(FloorFit, TheFootOfAWallDoesNotTiltTheFloor) {
  test::FloorFixture g;
  test::Noise noise(3);
  for (int i = 0; i < 4000; ++i) g.add(noise.uniform(-3, 3), noise.uniform(-2, 2), noise.normal(0.005));
  // Rock on one side: its lowest points stand in the cell next to the one that it fills.
  for (int i = 0; i < 4000; ++i) g.add(noise.uniform(-3, 3), 2.0 + noise.normal(0.08), noise.uniform(0.0, 2.5));
  const FloorResult f = fit(&g, near_floor());
  ASSERT_TRUE(f.fit.found);
  EXPECT_LT(std::fabs(roll_pitch_of_up(f.fit.plane.n).roll_rad), 0.0005);
}

// Muck along one wall, too low to count as something that stands on the floor: its foot lies within the fit's gate.
TEST(FloorFit, TheFootOfALowHeapDoesNotTiltTheFloor) {
  for (const double height_m : {0.15, 0.22, 0.3}) {
    test::FloorFixture g;
    test::Noise noise(4);
    for (int i = 0; i < 6000; ++i) {
      const double x = noise.uniform(-3, 3), y = noise.uniform(-2.0, 2.6);
      const double heap_m = y > 1.9 ? (y - 1.9) / 0.7 * height_m : 0.0;
      g.add(x, y, heap_m + noise.normal(0.005));
    }
    const FloorResult f = fit(&g, near_floor());
    ASSERT_TRUE(f.fit.found) << height_m;
    EXPECT_LT(std::fabs(roll_pitch_of_up(f.fit.plane.n).roll_rad), 0.002) << height_m;
  }
}

// Dust hangs over the floor in few places and hides little of it from the fit.
TEST(FloorFit, SpecksOverTheFloorLeaveItToTheFit) {
  test::FloorFixture g;
  test::Noise noise(5);
  for (int i = 0; i < 6000; ++i) g.add(noise.uniform(-3, 3), noise.uniform(-2, 2), noise.normal(0.005));
  for (int i = 0; i < 20; ++i) g.add(noise.uniform(-3, 3), noise.uniform(-2, 2), noise.uniform(0.1, 0.9));
  const FloorResult f = fit(&g, near_floor());
  ASSERT_TRUE(f.fit.found);
  EXPECT_LT(std::fabs(roll_pitch_of_up(f.fit.plane.n).roll_rad), 0.0005);
  EXPECT_LT(f.roll.sigma_rad, 0.0005);
}

// Waves of 6 cm over 2 m: the plane through what is seen is off by up to a degree, and says so.
TEST(FloorFit, TheLevelOfAWavyFloorHoldsItsMeanPlane) {
  int outside = 0;
  for (std::uint32_t run = 0; run < 40; ++run) {
    test::FloorFixture g;
    test::Noise noise(100 + run);
    const double phase_x = noise.uniform(0, 6.28), phase_y = noise.uniform(0, 6.28);
    const double length_x = noise.uniform(1.5, 4.0), length_y = noise.uniform(1.5, 4.0);
    for (int i = 0; i < 4000; ++i) {
      const double x = noise.uniform(-3, 3), y = noise.uniform(-2, 2);
      const double wave = 0.06 * std::sin(6.28 * x / length_x + phase_x) * std::sin(6.28 * y / length_y + phase_y);
      g.add(x, y, wave + noise.normal(0.005));
    }
    const FloorResult f = fit(&g, near_floor());
    ASSERT_TRUE(f.fit.found);
    const RollPitch angles = roll_pitch_of_up(f.fit.plane.n);
    const double factor = protection_factor(5.0, f.roll.dof);
    outside += std::fabs(angles.roll_rad) > f.roll.bound_rad.sum() + factor * f.roll.sigma_rad ? 1 : 0;
    outside += std::fabs(angles.pitch_rad) > f.pitch.bound_rad.sum() + factor * f.pitch.sigma_rad ? 1 : 0;
  }
  EXPECT_EQ(outside, 0);
}

// The inliers are those within the radius, of the others none.
TEST(FloorFit, CountsTheInliersWithinTheRadius) {
  test::FloorFixture g;
  test::Noise noise(6);
  test::OwnedPoints within(4000);
  double squares = 0.0;
  for (std::uint32_t i = 0; i < 4000; ++i) {
    const double x = noise.uniform(-6, 6), y = noise.uniform(-2, 2),
                 z = noise.normal(std::hypot(x, y) < 3.0 ? 0.004 : 0.01);
    g.add(x, y, z);
    if (std::hypot(x, y) > 3.0) continue;
    const PointSet& all = g.points().set();
    within.add(all.at(i));
    squares += z * z;
  }
  const std::uint32_t count = within.set().count;
  const FloorResult f = fit_within(&g, within.set(), near_floor());
  ASSERT_TRUE(f.fit.found);
  EXPECT_EQ(f.fit.inliers, count);
  EXPECT_NEAR(f.fit.rms_m, std::sqrt(squares / count), 2e-4);
}

// A floor whose points come from one side to the other, as a sensor's do: not the first of them alone are fitted.
TEST(FloorFit, OfMoreThanAFitTakesNoSideGoesShort) {
  double sigma[2];
  for (const bool in_order : {false, true}) {
    std::vector<Eigen::Vector3d> points;
    test::Noise noise(4);
    for (int i = 0; i < 20000; ++i)
      points.emplace_back(noise.uniform(-2, 2), noise.uniform(-2, 2), noise.normal(0.005));
    const auto before = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.y() < b.y(); };
    if (in_order) std::sort(points.begin(), points.end(), before);
    test::FloorFixture g;
    for (const Eigen::Vector3d& p : points) g.add(p.x(), p.y(), p.z());
    const FloorResult f = fit(&g, near_floor());
    ASSERT_TRUE(f.fit.found && !f.fit.refused);
    sigma[in_order ? 1 : 0] = f.roll.sigma_rad;
  }
  EXPECT_LT(sigma[1], 1.5 * sigma[0]) << "on a strip of two fifths of the width it would be 2.4 times as much";
}

// More than a fit takes: an even share of them says the same, wherever the sensor is.
TEST(FloorFit, AnyCountOfPointsAndAnyPlaceOfTheSensor) {
  const double slope = 0.03;
  for (const int count : {2000, 8192, 8193, 20000}) {
    for (const Eigen::Vector3d& sensor : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(-1.5, 0.8, 0.6)}) {
      test::FloorFixture g;
      test::Noise noise(4);
      for (int i = 0; i < count; ++i) {
        const double x = noise.uniform(-2, 2), y = noise.uniform(-2, 2);
        g.add(x, y, slope * y + noise.normal(0.005));
      }
      const FloorResult f = fit(&g, near_floor(), sensor);
      ASSERT_TRUE(f.fit.found && !f.fit.refused) << count;
      EXPECT_EQ(f.fit.inliers, static_cast<std::uint32_t>(count));
      const Eigen::Vector3d up = Eigen::Vector3d(0.0, -slope, 1.0).normalized();
      EXPECT_LT((f.fit.plane.n - up).norm(), 5.0 * (f.roll.sigma_rad + f.pitch.sigma_rad)) << count;
      EXPECT_LT(f.roll.sigma_rad, 0.005 / std::sqrt(0.3 * count)) << "the points that were taken count";
    }
  }
}

TEST(FloorFit, TooFewPointsAreRefused) {
  test::FloorFixture g;
  for (int i = 0; i < 5; ++i) g.add(0.1 * i, 0.0, 0.0);
  const FloorResult f = fit(&g, near_floor());
  EXPECT_TRUE(f.fit.refused);
  EXPECT_FALSE(f.fit.found);
  EXPECT_NE(f.fit.reasons & POSE_WALL_R_FLOOR_THIN, 0U);
}

}  // namespace
}  // namespace pose_wall
