// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: ranks and shares of a histogram of distances agree with the sorted distances to half a bin; what is negative
// or no number is not counted, what is far counts as 10 m.

#include "estimation/distances.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr double kHalfBin_m = 0.025 + 1e-9;

TEST(Distances, RanksAreThoseOfTheSortedDistances) {
  test::Noise noise(1);
  std::vector<double> sorted;
  Distances distances;
  for (int i = 0; i < 1000; ++i) {
    sorted.push_back(noise.uniform(0.0, 9.9));
    distances.add(sorted.back());
  }
  std::sort(sorted.begin(), sorted.end());
  EXPECT_EQ(distances.count(), 1000U);
  for (std::uint32_t rank = 1; rank <= 1000; ++rank) {
    ASSERT_NEAR(distances.at_rank(rank), sorted[rank - 1], kHalfBin_m) << rank;
  }
  for (const double share : {0.1, 0.5, 0.8, 0.95, 1.0}) {
    EXPECT_EQ(distances.at_share(share), distances.at_rank(static_cast<std::uint32_t>(share * 1000)));
  }
}

TEST(Distances, OneAmongManyDoesNotMoveAShare) {
  Distances distances;
  for (int i = 0; i < 99; ++i) distances.add(1.0);
  distances.add(9.0);
  EXPECT_NEAR(distances.at_share(0.95), 1.0, kHalfBin_m);
  EXPECT_NEAR(distances.at_share(1.0), 9.0, kHalfBin_m);
}

TEST(Distances, WhatIsNoDistanceIsNotCounted) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  Distances distances;
  for (const double none : {-1e-9, -3.0, -kInf, std::numeric_limits<double>::quiet_NaN()}) distances.add(none);
  EXPECT_EQ(distances.count(), 0U);
  for (const double far_m : {10.0, 250.0, 1e300, kInf}) distances.add(far_m);
  EXPECT_EQ(distances.count(), 4U);
  EXPECT_NEAR(distances.at_rank(1), 10.0, 0.05);
  EXPECT_NEAR(distances.at_share(1.0), 10.0, 0.05);
}

TEST(Distances, EmptyIsNought) {
  const Distances none;
  EXPECT_EQ(none.count(), 0U);
  EXPECT_NEAR(none.at_share(0.5), 0.0, kHalfBin_m);
}

}  // namespace
}  // namespace pose_wall
