// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: for any number of rows the factor times itself is the matrix, a right side comes out as what the factor takes
// to it, what lies above the diagonal plays no part, and a matrix that is not positive definite is told.

#include "base/estimation/panel_cholesky.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <vector>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

using test::Noise;

// Correlated and well conditioned, as patches of a floor are.
Eigen::MatrixXd covariance(int rows, Noise* noise) {
  const Eigen::MatrixXd b = Eigen::MatrixXd::NullaryExpr(rows, rows, [&] { return noise->normal(1.0); });
  return b * b.transpose() / rows + 0.1 * Eigen::MatrixXd::Identity(rows, rows);
}

// The lower triangle; what is above it is garbage.
void fill(const Eigen::MatrixXd& m, PanelCholesky* cholesky) {
  const auto rows = static_cast<std::uint32_t>(m.rows());
  for (std::uint32_t p = 0; p < PanelCholesky::panels_of(rows); ++p) {
    for (std::uint32_t column = 0; column < 4 * p + 4; ++column) {
      for (std::uint32_t k = 0; k < 4; ++k) {
        const std::uint32_t row = 4 * p + k;
        float value = row == column ? 1.0F : 0.0F;
        if (row < rows && column < rows) value = static_cast<float>(m(row, column));
        if (column > row) value = std::numeric_limits<float>::quiet_NaN();
        cholesky->panel(p)[4 * column + k] = value;
      }
    }
  }
}

class EveryCount : public ::testing::TestWithParam<int> {};

TEST_P(EveryCount, FactorAndRightSidesAreThoseOfEigen) {
  const int rows = GetParam();
  Noise noise(static_cast<std::uint32_t>(rows));
  const Eigen::MatrixXd m = covariance(rows, &noise);
  test::Placed<PanelCholesky> cholesky;
  fill(m, cholesky.get());
  const auto count = static_cast<std::uint32_t>(rows);
  ASSERT_TRUE(cholesky->factor(count));

  const Eigen::MatrixXd lower = Eigen::LLT<Eigen::MatrixXd>(m).matrixL();
  const Eigen::MatrixXd right = Eigen::MatrixXd::NullaryExpr(rows, 4, [&] { return noise.normal(1.0); });
  std::vector<float> sides(PanelCholesky::kPanel, 0.0F);
  for (int row = 0; row < rows; ++row) {
    for (int k = 0; k < 4; ++k) sides[static_cast<std::size_t>(4 * row + k)] = static_cast<float>(right(row, k));
  }
  cholesky->solve(count, sides.data());
  const Eigen::MatrixXd expected = lower.triangularView<Eigen::Lower>().solve(right);
  for (int row = 0; row < rows; ++row) {
    EXPECT_NEAR(static_cast<double>(cholesky->inverse_pivot(static_cast<std::uint32_t>(row))), 1.0 / lower(row, row),
                1e-4);
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(static_cast<double>(sides[static_cast<std::size_t>(4 * row + k)]), expected(row, k), 1e-3)
          << "row " << row << " side " << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(PanelCholesky, EveryCount, ::testing::Values(1, 2, 3, 4, 5, 7, 8, 31, 64, 77, 95, 96));

TEST(PanelCholesky, WhatIsNotPositiveDefiniteIsTold) {
  Noise noise(1);
  for (const double pivot : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    for (const int at : {0, 5, 10}) {
      Eigen::MatrixXd m = Eigen::MatrixXd::Identity(11, 11);
      m(at, at) = pivot;
      test::Placed<PanelCholesky> cholesky;
      fill(m, cholesky.get());
      EXPECT_FALSE(cholesky->factor(11)) << pivot << " at " << at;
    }
  }
}

}  // namespace
}  // namespace pose_wall
