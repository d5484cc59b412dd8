// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the two scores are what their formulas say, worked out by hand and by expectation maximisation on the points
// themselves, and rank a plane with inliers before one without.

#include "base/estimation/mlesac.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr double kSigma = 0.02, kSpan = 4.0;

// Points at given heights over z = 0.
test::OwnedPoints at_heights(const std::vector<double>& heights) {
  test::OwnedPoints points(static_cast<std::uint32_t>(heights.size()) + 1);
  for (std::size_t i = 0; i < heights.size(); ++i) points.add(0.1 * static_cast<double>(i), 0.0, heights[i]);
  return points;
}

double cost_at(const std::vector<double>& heights, double threshold, double too_much = 1e300) {
  test::Placed<PointSet> points(static_cast<std::uint32_t>(heights.size()) + 1);
  points->count = 0;
  for (const double h : heights) points->set(points->count++, Eigen::Vector3d(0, 0, h), 1.0F);
  return truncated_cost(*points, Plane{}, threshold, too_much);
}

TEST(TruncatedCost, ByHand) {
  // min(r^2, t^2) / t^2 with t = 0.1: 0, 0.25, 1, 1.
  EXPECT_NEAR(cost_at({0.0, 0.05, 0.1, -0.5}, 0.1), 2.25 / 4, 1e-6);
  EXPECT_NEAR(cost_at({0.0, 0.0, 0.0}, 0.1), 0.0, 1e-12);
  EXPECT_NEAR(cost_at({9.0, -9.0}, 0.1), 1.0, 1e-6);
}

TEST(TruncatedCost, NoPointsAreNoEvidence) {
  EXPECT_EQ(cost_at({}, 0.1), 1.0);
}

TEST(TruncatedCost, CountsThatFillNoLaneAreCountedTheSame) {
  for (int n = 1; n < 40; ++n) {
    std::vector<double> heights(static_cast<std::size_t>(n), 0.05);
    ASSERT_NEAR(cost_at(heights, 0.1), 0.25, 1e-6) << n;
  }
}

// An upright plane is asked without heights: the cost is what it is by all three coordinates, for any count.
TEST(TruncatedCost, OfAnUprightPlaneHeightsPlayNoPart) {
  test::Noise noise(7);
  Plane upright{Eigen::Vector3d(0.6, -0.8, 0.0), 0.3}, leaning = upright;
  leaning.n.z() = 1e-30;  // the general way
  for (std::uint32_t n = 1; n < 300; n += 7) {
    test::Placed<PointSet> points(n);
    points->count = 0;
    double expected = 0.0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const Eigen::Vector3d p(noise.uniform(-0.5, 0.5), noise.uniform(0, 0.8), noise.normal(3.0));
      points->set(points->count++, p, 1.0F);
      const double share = upright.signed_distance(p) / 0.2;
      expected += share * share < 1.0 ? share * share : 1.0;
    }
    for (std::uint32_t i = n; i < n + kFour; ++i) points->x[i] = points->y[i] = points->z[i] = std::nanf("");
    EXPECT_NEAR(truncated_cost(*points, upright, 0.2, 1e300), expected / n, 1e-5) << n;
    EXPECT_NEAR(truncated_cost(*points, leaning, 0.2, 1e300), expected / n, 1e-5) << n;
    points->z[n / 2] = std::nanf("");
    EXPECT_NEAR(truncated_cost(*points, upright, 0.2, 1e300), expected / n, 1e-5) << "not even read";
  }
}

// Who has lost need not be told by how much; who costs less by more than chance is told exactly.
TEST(TruncatedCost, EndsEarlyOnlyForWhatCostsTooMuch) {
  test::Noise noise(4);
  for (const double spread : {0.02, 0.1, 1.0}) {
    std::vector<double> heights(300);
    for (double& h : heights) h = noise.normal(spread);
    const double exact = cost_at(heights, 0.1);
    for (const double too_much : {0.5 * exact, 0.999 * exact}) {
      EXPECT_EQ(cost_at(heights, 0.1, too_much), too_much) << spread;
    }
    EXPECT_EQ(cost_at(heights, 0.1, 1.001 * exact), exact) << spread;
  }
}

// A mean of costs is told by the first of them to what chance leaves open: three standard errors.
TEST(TruncatedCost, WhatIsSurelyLostIsNotLookedAtToTheEnd) {
  std::vector<double> heights(512, 0.0);
  for (std::size_t i = 0; i < 128; ++i)
    heights[i] = 9.0;  // of which the order is no chance: all that is off comes first
  EXPECT_NEAR(cost_at(heights, 0.1), 0.25, 1e-6);
  EXPECT_EQ(cost_at(heights, 0.1, 0.9), 0.9) << "128 of 128 are off";
  test::Noise noise(11);
  int wrong = 0;
  for (int time = 0; time < 300; ++time) {
    for (double& h : heights) h = noise.uniform(0, 1) < 0.8 ? 9.0 : 0.0;
    wrong += cost_at(heights, 0.1, 0.85) == 0.85 && cost_at(heights, 0.1) < 0.84 ? 1 : 0;
  }
  EXPECT_LE(wrong, 3) << "of 300";
  wrong = 0;
  for (int time = 0; time < 300; ++time) {
    for (double& h : heights) h = noise.uniform(0, 1) < 0.96 ? 9.0 : 0.0;
    wrong += cost_at(heights, 0.1, 0.98) == 0.98 && cost_at(heights, 0.1) < 0.975 ? 1 : 0;
  }
  EXPECT_LE(wrong, 3) << "of 300, where the first points are often all off";
}

// The mixture of a half-Gaussian of |r| and a uniform density, by EM on the points, without bins.
MlesacScore reference(const std::vector<double>& residuals) {
  const auto ratio = [](double r) {
    return std::exp(-0.5 * r * r / (kSigma * kSigma)) * std::sqrt(2.0 / M_PI) / kSigma * kSpan;
  };
  const double n = static_cast<double>(residuals.size());
  double share = 0.5;
  for (int round = 0; round < 100; ++round) {
    double inside = 0.0;
    for (const double r : residuals) inside += share * ratio(r) / (share * ratio(r) + 1.0 - share);
    share = inside / n;
  }
  double log_likelihood = 0.0;
  for (const double r : residuals) log_likelihood += std::log(share * ratio(r) + 1.0 - share);
  return {-log_likelihood / n, share};
}

// Bins of an eighth of sigma change the density at a point by up to a quarter at four sigma, by less than 1 % on the
// average; eight rounds of EM leave less than that.
TEST(Mlesac, FollowsExpectationMaximisationOnThePoints) {
  test::Noise noise(1);
  for (const double inliers : {0.1, 0.3, 0.6, 0.95}) {
    std::vector<double> residuals(4000);
    for (std::size_t i = 0; i < residuals.size(); ++i) {
      const bool in = static_cast<double>(i) < inliers * 4000.0;
      residuals[i] = in ? noise.normal(kSigma) : noise.uniform(-kSpan, kSpan);
    }
    test::OwnedPoints points = at_heights(residuals);
    const MlesacScore got = mlesac_score(points.set(), Plane{}, kSigma, kSpan);
    const MlesacScore expected = reference(residuals);
    EXPECT_NEAR(got.inlier_share, expected.inlier_share, 0.02) << inliers;
    EXPECT_NEAR(got.cost, expected.cost, 0.02 + 0.02 * std::fabs(expected.cost)) << inliers;
    EXPECT_LT(got.cost, 0.0) << inliers;
  }
}

TEST(Mlesac, AllOnThePlaneByHand) {
  test::OwnedPoints points = at_heights(std::vector<double>(100, 0.0));
  const MlesacScore got = mlesac_score(points.set(), Plane{}, kSigma, kSpan);
  // ln of the density at 0 over the uniform one: ln(0.7979 / 0.02 * 4) = 5.07, first bin's centre: -0.002.
  EXPECT_NEAR(got.cost, -5.07, 0.01);
  EXPECT_NEAR(got.inlier_share, 1.0, 1e-3);
}

TEST(Mlesac, NothingNearThePlaneIsNoEvidence) {
  test::OwnedPoints far = at_heights(std::vector<double>(100, 1.0));
  EXPECT_GE(mlesac_score(far.set(), Plane{}, kSigma, kSpan).cost, 0.0);
  test::OwnedPoints none = at_heights({});
  const MlesacScore empty = mlesac_score(none.set(), Plane{}, kSigma, kSpan);
  EXPECT_EQ(empty.cost, 0.0);
  EXPECT_EQ(empty.inlier_share, 0.0);
}

// What lies behind the last point of a row is read with it, and counts for nothing.
TEST(Mlesac, AnyCountOfPointsIsTheirOwn) {
  for (std::uint32_t count = 1; count <= 9; ++count) {
    test::OwnedPoints points = at_heights(std::vector<double>(count, 0.0));
    for (const float behind : {0.0F, 5.0F, std::numeric_limits<float>::quiet_NaN()}) {
      PointSet& set = points.set();
      for (std::uint32_t k = count; k % kFour != 0; ++k) set.x[k] = set.y[k] = set.z[k] = behind;
      const MlesacScore got = mlesac_score(set, Plane{}, kSigma, kSpan);
      EXPECT_NEAR(got.cost, -5.07, 0.01) << count << " " << behind;
      EXPECT_NEAR(got.inlier_share, 1.0, 1e-3) << count << " " << behind;
    }
  }
}

TEST(Mlesac, ThePlaneBesideThePointsScoresWorse) {
  test::Noise noise(2);
  std::vector<double> heights(1000);
  for (double& h : heights) h = noise.normal(kSigma);
  test::OwnedPoints points = at_heights(heights);
  double last = -1e9;
  for (const double off : {0.0, 0.02, 0.04, 0.08}) {
    const double cost = mlesac_score(points.set(), Plane{Eigen::Vector3d::UnitZ(), -off}, kSigma, kSpan).cost;
    EXPECT_GT(cost, last) << off;
    last = cost;
  }
}

}  // namespace
}  // namespace pose_wall
