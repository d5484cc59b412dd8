// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the normal equations give back a plane exactly, sum rows of any design, and refuse points that span none.

#include "base/estimation/normal_equations.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr double kSpreadMin_m = 0.05;

TEST(NormalEquations, GiveBackAPlane) {
  test::Noise noise(1);
  NormalEquations equations;
  for (int i = 0; i < 100; ++i) {
    const double u = noise.uniform(-4, 4), v = noise.uniform(-1, 1);
    equations.add(u, v, 0.3 - 0.02 * u + 0.07 * v, noise.uniform(0.1, 2.0));
  }
  Eigen::Vector3d solution;
  ASSERT_TRUE(equations.solve(kSpreadMin_m, &solution));
  EXPECT_LT((solution - Eigen::Vector3d(0.3, -0.02, 0.07)).norm(), 1e-12);
}

TEST(NormalEquations, WeightsDecideBetweenTwoSurfaces) {
  NormalEquations equations;
  for (int u = -3; u <= 3; ++u) {
    for (int v = -3; v <= 3; ++v) {
      equations.add(u, v, 0.0, 3.0);
      equations.add(u, v, 1.0, 1.0);
    }
  }
  Eigen::Vector3d solution;
  ASSERT_TRUE(equations.solve(kSpreadMin_m, &solution));
  EXPECT_NEAR(solution[0], 0.25, 1e-12);
  EXPECT_EQ(equations.weight(), 49.0 * 4.0);
}

TEST(NormalEquations, SumRowsOfAnyDesign) {
  test::Noise noise(7);
  NormalEquations sums;
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_side = Eigen::Vector3d::Zero();
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d row(i % 2 == 0 ? 0.0 : 1.0, noise.uniform(-4, 4), noise.uniform(-1, 1));
    const double r = noise.normal(0.1), w = noise.uniform(0.5, 2.0);
    sums.add_row(row, r, w);
    information += w * row * row.transpose();
    right_side += w * row * r;
  }
  EXPECT_LT((sums.information() - information).norm(), 1e-12 * information.norm());
  EXPECT_LT((sums.right_side() - right_side).norm(), 1e-12 * right_side.norm());
}

TEST(NormalEquations, RefusePointsOnALineInAnyDirection) {
  for (double angle = 0.0; angle < 3.2; angle += 0.1) {
    NormalEquations equations;
    for (double s = -5.0; s <= 5.0; s += 0.01) {
      equations.add(std::cos(angle) * s + 3.0, std::sin(angle) * s - 2.0, 0.1 * s, 1.0);
    }
    Eigen::Vector3d solution(7, 7, 7);
    EXPECT_FALSE(equations.solve(kSpreadMin_m, &solution)) << angle;
    EXPECT_EQ(solution, Eigen::Vector3d(7, 7, 7));
    EXPECT_LT(equations.smaller_spread_m(), 1e-5);
  }
}

TEST(NormalEquations, RefuseNothingOnePointAndNaN) {
  Eigen::Vector3d solution;
  EXPECT_FALSE(NormalEquations().solve(kSpreadMin_m, &solution));
  NormalEquations one;
  one.add(1, 1, 1, 1);
  EXPECT_FALSE(one.solve(kSpreadMin_m, &solution));
  NormalEquations nan;
  for (int i = 0; i < 10; ++i) nan.add(i, i * i, 0.0, i == 5 ? std::nan("") : 1.0);
  EXPECT_FALSE(nan.solve(kSpreadMin_m, &solution));
}

TEST(NormalEquations, SpreadIsTheStandardDeviationAcross) {
  NormalEquations equations;
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (double a = -4.0; a <= 4.0; a += 0.5) {
    for (const double b : {-0.2, 0.2}) equations.add(c * a - s * b, s * a + c * b, 0.0, 1.0);
  }
  EXPECT_NEAR(equations.smaller_spread_m(), 0.2, 1e-9);
}

TEST(NormalEquations, TheMainDirectionLiesAlongThePoints) {
  for (const double angle : {-1.5, -0.7, 0.0, 0.3, 0.7854, 1.2, 1.5}) {
    NormalEquations equations;
    const double c = std::cos(angle), s = std::sin(angle);
    for (double a = -4.0; a <= 4.0; a += 0.5) {
      for (const double b : {-0.2, 0.2}) equations.add(3.0 + c * a - s * b, s * a + c * b - 2.0, 0.0, 1.0);
    }
    const Eigen::Vector2d along = equations.main_direction();
    EXPECT_NEAR(std::fabs(along.x() * c + along.y() * s), 1.0, 1e-9) << angle;
    EXPECT_NEAR(along.squaredNorm(), 1.0, 1e-12) << angle;
  }
  NormalEquations point;
  point.add(1.0, 1.0, 0.0, 1.0);
  EXPECT_EQ(point.main_direction(), Eigen::Vector2d(1.0, 0.0)) << "no direction of its own";
}

}  // namespace
}  // namespace pose_wall
