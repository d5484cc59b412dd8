// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the factor of a level is the quantile of the risk that was stated, never smaller, and stretched for a
// standard deviation that is known from few pieces only.

#include "base/estimation/protection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pose_wall {
namespace {

// By the C library.
double normal_beyond(double sigmas) {
  return std::erfc(sigmas / std::sqrt(2.0));
}

TEST(Protection, TheShareBeyondIsThatOfTheNormalDistributionAndNeverLess) {
  for (double sigmas = 1.0; sigmas < 30.0; sigmas += 0.01) {
    const double more = share_beyond(sigmas) / normal_beyond(sigmas) - 1.0;
    EXPECT_GE(more, -1e-12) << sigmas;
    EXPECT_LT(more, sigmas < 2.0 ? 0.02 : (sigmas < 5.0 ? 0.0031 : 1e-4)) << sigmas;
  }
  EXPECT_LT(share_beyond(36.9), 1e-290);
  for (const double far : {37.0, 1e3, 1e300, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(share_beyond(far), 0.0) << far;
  }
}

// Of tables of the normal distribution, on both sides.
TEST(Protection, TheFactorIsTheQuantileOfTheRisk) {
  const struct {
    double risk, sigmas;
  } known[] = {{1e-2, 2.575829}, {1e-3, 3.290527}, {1e-4, 3.890592}, {1e-5, 4.417173},   {5.733031e-7, 5.0},
               {1e-6, 4.891638}, {1e-7, 5.326724}, {1e-8, 5.730729}, {1.973175e-9, 6.0}, {1e-9, 6.109410}};
  for (const auto& row : known) {
    EXPECT_NEAR(sigmas_at_risk(row.risk), row.sigmas, 1e-3) << row.risk;
    EXPECT_GE(sigmas_at_risk(row.risk), row.sigmas - 1e-6) << row.risk << ": never narrower than stated";
  }
  EXPECT_NEAR(sigmas_at_risk(1e-6), 4.891638, 1e-4);
}

TEST(Protection, ASmallerRiskAlwaysHasAWiderLevel) {
  double last = sigmas_at_risk(0.5);
  for (double risk = 0.4; risk > 1e-12; risk *= 0.9) {
    const double sigmas = sigmas_at_risk(risk);
    EXPECT_GT(sigmas, last) << risk;
    EXPECT_NEAR(normal_beyond(sigmas) / risk, 1.0, risk > 0.02 ? 0.15 : 0.003) << risk;
    last = sigmas;
  }
}

// Student's t quantiles beyond Phi(2), from tables: t(0.97725; dof).
TEST(Protection, StretchesTheNormalQuantileToStudents) {
  EXPECT_NEAR(protection_factor(2.0, 10.0), 2.28, 0.06);
  EXPECT_NEAR(protection_factor(2.0, 30.0), 2.09, 0.01);
  EXPECT_NEAR(protection_factor(5.0, 1e9), 5.0, 1e-6);
  for (double dof = 1.0; dof < 100.0; dof += 1.0) {
    EXPECT_GT(protection_factor(5.0, dof), protection_factor(5.0, dof + 1.0));
    EXPECT_GT(protection_factor(5.0, dof), 5.0);
  }
}

}  // namespace
}  // namespace pose_wall
