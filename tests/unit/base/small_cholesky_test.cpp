// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what is solved gives back the right-hand side, over all scales a fit meets, as Eigen's own does; what is not
// positive definite is told.

#include "base/estimation/small_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

// Normal equations of a quadratic over a wall: from ones to products of fourth powers of metres.
Matrix6 of_a_wall(test::Noise* noise, double length_m) {
  Matrix6 m = Matrix6::Zero();
  for (int k = 0; k < 60; ++k) {
    const double u = noise->uniform(-0.5, 0.5) * length_m, v = noise->uniform(-1.0, 1.0);
    Vector6 a;
    a << 1.0, u, v, u * u, u * v, v * v;
    m += noise->uniform(1.0, 1e4) * a * a.transpose();
  }
  return m;
}

TEST(SmallCholesky, SolvesWhatFitsAsk) {
  test::Noise noise(8);
  for (const double length_m : {2.0, 10.0, 40.0}) {
    for (int time = 0; time < 20; ++time) {
      const Matrix6 m = of_a_wall(&noise, length_m);
      Vector6 expected;
      for (int k = 0; k < 6; ++k) expected[k] = noise.uniform(-1, 1);
      const SmallCholesky<6> solver(m);
      ASSERT_TRUE(solver.solved());
      const Vector6 x = solver.solve(m * expected), by_eigen = m.inverse() * (m * expected);
      EXPECT_LT((x - expected).norm(), 1e-7) << length_m;
      EXPECT_LT((x - by_eigen).norm(), 1e-6) << length_m;
    }
  }
}

TEST(SmallCholesky, AloneAndByHand) {
  EXPECT_EQ(SmallCholesky<1>(SmallCholesky<1>::Matrix(4.0)).solve(SmallCholesky<1>::Vector(8.0))[0], 2.0);
  Eigen::Matrix2d m;
  m << 4.0, 2.0, 2.0, 5.0;
  EXPECT_LT((SmallCholesky<2>(m).solve({8.0, 16.0}) - Eigen::Vector2d(0.5, 3.0)).norm(), 1e-15);
}

TEST(SmallCholesky, TellsWhatIsNotPositiveDefinite) {
  const double kNan = std::numeric_limits<double>::quiet_NaN();
  Eigen::Matrix3d twice = Eigen::Matrix3d::Ones(), minus = Eigen::Matrix3d::Identity();
  minus(1, 1) = -1.0;
  Eigen::Matrix3d unknown = Eigen::Matrix3d::Identity();
  unknown(2, 0) = kNan;
  EXPECT_TRUE(SmallCholesky<3>(Eigen::Matrix3d::Identity()).solved());
  EXPECT_FALSE(SmallCholesky<3>(Eigen::Matrix3d::Zero()).solved());
  EXPECT_FALSE(SmallCholesky<3>(twice).solved());
  EXPECT_FALSE(SmallCholesky<3>(minus).solved());
  EXPECT_FALSE(SmallCholesky<3>(unknown).solved());
  EXPECT_FALSE(SmallCholesky<3>(Eigen::Matrix3d::Constant(kNan)).solved());
}

}  // namespace
}  // namespace pose_wall
