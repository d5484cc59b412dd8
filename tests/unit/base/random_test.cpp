// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the generator is SplitMix64 as published, and below() keeps its bound and is even.

#include "base/math/random.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pose_wall {
namespace {

TEST(Random, GivesThePublishedNumbers) {
  // First outputs of SplitMix64 for seed 1234567, as in the reference implementation of Vigna.
  Random random(1234567);
  EXPECT_EQ(random.next(), 6457827717110365317ULL);
  EXPECT_EQ(random.next(), 3203168211198807973ULL);
  EXPECT_EQ(random.next(), 9817491932198370423ULL);
}

TEST(Random, BelowStaysBelow) {
  Random random(3);
  for (const std::uint32_t bound : {1U, 2U, 3U, 1000U, 0xFFFFFFFFU}) {
    for (int i = 0; i < 1000; ++i) ASSERT_LT(random.below(bound), bound);
  }
}

TEST(Random, BelowIsEven) {
  Random random(4);
  constexpr std::uint32_t kBound = 10;
  constexpr int kDraws = 100000;
  std::vector<int> seen(kBound);
  for (int i = 0; i < kDraws; ++i) ++seen[random.below(kBound)];
  // Standard deviation of a count: sqrt(n p (1 - p)) = 95; five of them.
  for (const int count : seen) EXPECT_NEAR(count, kDraws / 10, 475);
}

}  // namespace
}  // namespace pose_wall
