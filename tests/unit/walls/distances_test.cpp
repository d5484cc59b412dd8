// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: ranks and shares of a histogram of distances agree with the sorted distances to half a bin, of a single one
// as of many; what is negative or no number is not counted, what is far counts as 10 m.

#include "engine/walls/sample/distances.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr double kHalfBin_m = 0.025 + 1e-9;

struct RandomDistances {
  explicit RandomDistances(std::uint32_t count) {
    test::Noise noise(count);
    for (std::uint32_t i = 0; i < count; ++i) {
      sorted.push_back(noise.uniform(0.0, 9.9));
      distances.add(sorted.back());
    }
    std::sort(sorted.begin(), sorted.end());
  }
  std::vector<double> sorted;
  Distances distances;
};

TEST(Distances, RanksAreThoseOfTheSortedDistances) {
  const RandomDistances of(1000);
  EXPECT_EQ(of.distances.count(), 1000U);
  for (std::uint32_t rank = 1; rank <= 1000; ++rank) {
    ASSERT_NEAR(of.distances.at_rank(rank), of.sorted[rank - 1], kHalfBin_m) << rank;
  }
}

// The least of the sorted distances that at least the share of them does not exceed.
TEST(Distances, SharesAreThoseOfTheSortedDistances) {
  for (const std::uint32_t count : {2U, 3U, 7U, 19U, 101U, 1000U}) {
    const RandomDistances of(count);
    for (const double share : {0.01, 0.125, 0.25, 0.5, 0.75, 0.8, 0.95, 1.0}) {
      std::uint32_t rank = 1;
      while (rank < share * count) ++rank;
      EXPECT_NEAR(of.distances.at_share(share), of.sorted[rank - 1], kHalfBin_m) << share << " of " << count;
    }
  }
}

TEST(Distances, EveryShareOfASingleOneIsThatOne) {
  Distances distances;
  distances.add(5.0);
  for (const double share : {0.01, 0.5, 0.8, 1.0}) EXPECT_NEAR(distances.at_share(share), 5.0, 0.05) << share;
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
