// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the scale is the standard deviation of Gaussian bulk, and outliers, NaN and emptiness do no harm to it.

#include "base/estimation/robust_scale.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

double scale_of(const std::vector<float>& residuals, double gate) {
  return robust_scale(Span<const float>(residuals.data(), static_cast<std::uint32_t>(residuals.size())), gate);
}

std::vector<float> gaussian(std::size_t count, double sigma) {
  test::Noise noise(1);
  std::vector<float> r(count);
  for (float& v : r) v = static_cast<float>(noise.normal(sigma));
  return r;
}

// The median of 20,000 has a standard error of 0.8 % of sigma here; a bin is 1/256 of the gate: 2 % of sigma.
TEST(RobustScale, IsTheStandardDeviationOfAGaussian) {
  for (const double sigma : {0.002, 0.01, 0.03}) {
    EXPECT_NEAR(scale_of(gaussian(20000, sigma), 5.0 * sigma) / sigma, 1.0, 0.04) << sigma;
  }
}

TEST(RobustScale, OutliersBeyondTheGateCountForNothing) {
  std::vector<float> r = gaussian(5000, 0.01);
  const double clean = scale_of(r, 0.1);
  for (int i = 0; i < 3000; ++i) r.push_back(i % 2 == 0 ? 1.0F : -30.0F);
  r.push_back(std::numeric_limits<float>::quiet_NaN());
  r.push_back(std::numeric_limits<float>::infinity());
  EXPECT_EQ(scale_of(r, 0.1), clean);
}

TEST(RobustScale, NothingInsideTheGateIsTheGate) {
  EXPECT_EQ(scale_of({}, 0.1), 0.1);
  EXPECT_EQ(scale_of({5.0F, -7.0F}, 0.1), 0.1);
}

TEST(RobustScale, AllZeroIsWithinTheFirstBin) {
  EXPECT_LE(scale_of(std::vector<float>(100, 0.0F), 0.1), 1.4826 * 0.1 / 256);
}

TEST(RobustScale, OneResidualIsItsOwnMedian) {
  EXPECT_NEAR(scale_of({0.05F}, 0.1), 1.4826 * 0.05, 1.4826 * 0.1 / 256);
}

}  // namespace
}  // namespace pose_wall
