// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: of what is offered as much is taken as is asked for, of all, of every n-th, and of a list in place.

#include "base/containers/even_share.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace pose_wall {
namespace {

constexpr int kOffered = 10000;

TEST(EvenShare, TakesAsMuchAsIsAskedFor) {
  for (const std::uint32_t all : {21U, 40U, 60U, 200U, 5000U}) {
    EvenShare share(20, all);
    int taken = 0;
    for (int i = 0; i < kOffered; ++i) taken += share.takes() ? 1 : 0;
    EXPECT_NEAR(taken, kOffered * 20.0 / all, 3.0) << all;
  }
}

TEST(EvenShare, TakesAllOfFew) {
  for (std::uint32_t all = 0; all <= 20; ++all) {
    EvenShare share(20, all);
    for (int i = 0; i < 100; ++i) EXPECT_TRUE(share.takes()) << all;
  }
}

TEST(EvenShare, NeverTakesMoreThanThereIsRoomFor) {
  for (std::uint32_t all = 1; all < 2000; all += 7) {
    for (const std::uint32_t most : {1U, 8U, 100U, 1999U}) {
      std::uint32_t taken = 0, last = 0;
      for_even_share(all, most, [&](std::uint32_t k) {
        ASSERT_LT(k, all);
        ASSERT_TRUE(taken == 0 || k > last);
        last = k;
        ++taken;
      });
      ASSERT_LE(taken, most);
      ASSERT_GE(taken + 3, all < most ? all : most) << all;
    }
  }
}

TEST(EvenShare, ThinsAListToTheSameShare) {
  // Of 14, 15, 36 and 94 the share would be eleven.
  for (const std::uint32_t all : {0U, 1U, 9U, 10U, 11U, 14U, 15U, 36U, 94U, 1777U}) {
    constexpr std::uint32_t kMost = 10;
    std::vector<std::uint32_t> items(all), expected;
    for (std::uint32_t k = 0; k < all; ++k) items[k] = 3 * k;
    EvenShare share(kMost, all);
    for (std::uint32_t k = 0; k < all; ++k) {
      if (share.takes() && expected.size() < kMost) expected.push_back(3 * k);
    }
    const Span<std::uint32_t> kept = thinned(Span<std::uint32_t>(items.data(), all), kMost);
    EXPECT_EQ(std::vector<std::uint32_t>(kept.begin(), kept.end()), expected) << all;
    if (all == 14 || all == 15 || all == 36 || all == 94) {
      EXPECT_EQ(kept.size(), kMost) << all;
    }
  }
}

// Two layers, or the lines of a sensor, that come by turns: none of them goes short.
TEST(EvenShare, TakesAsMuchOfEveryNth) {
  for (int period = 2; period <= 34; ++period) {
    for (int phase = 0; phase < period; ++phase) {
      EvenShare share(1, 2);
      int taken = 0, offered = 0;
      for (int i = 0; i < kOffered; ++i) {
        const bool takes = share.takes();
        if (i % period != phase) continue;
        ++offered;
        taken += takes ? 1 : 0;
      }
      EXPECT_NEAR(taken, 0.5 * offered, 0.05 * offered + 2.0) << period << " from " << phase;
    }
  }
}

}  // namespace
}  // namespace pose_wall
