// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a cloud that comes again is known, and as old as its first copy, whatever came in between, as long as fewer
// than kCount others did; one that is new pushes out the oldest; a clock that went back gives an age below zero; no
// stamp overflows.

#include "cloud/seen_clouds.hpp"

#include <gtest/gtest.h>

namespace pose_wall {
namespace {

constexpr std::int64_t kSecond_ns = 1000000000;

TEST(SeenClouds, ANewOneIsNoRepeat) {
  SeenClouds seen;
  for (std::uint64_t k = 1; k <= 20; ++k) EXPECT_FALSE(seen.keep(k, 0).is_one) << k;
}

TEST(SeenClouds, IsAsOldAsItsFirstCopy) {
  SeenClouds seen;
  seen.keep(7, kSecond_ns);
  for (int k = 2; k <= 10; ++k) {
    const Repeat repeat = seen.keep(7, k * kSecond_ns);
    EXPECT_TRUE(repeat.is_one);
    EXPECT_DOUBLE_EQ(repeat.age_s, k - 1.0);
  }
}

TEST(SeenClouds, BuffersThatAreHandedOutByTurnsAreKnownAgain) {
  for (std::uint32_t buffers = 1; buffers <= SeenClouds::kCount + 1; ++buffers) {
    SeenClouds seen;
    for (std::uint32_t k = 0; k < 3 * buffers; ++k) {
      const bool known = k >= buffers && buffers <= SeenClouds::kCount;
      EXPECT_EQ(seen.keep(1 + k % buffers, k * kSecond_ns).is_one, known) << buffers << " buffers, frame " << k;
    }
  }
}

TEST(SeenClouds, AClockThatWentBackGivesAnAgeBelowZero) {
  SeenClouds seen;
  seen.keep(7, kSecond_ns);
  EXPECT_LT(seen.keep(7, 0).age_s, 0.0);
  EXPECT_GT(seen.keep(7, INT64_MAX).age_s, 0.0);
  EXPECT_LT(seen.keep(7, INT64_MIN).age_s, 0.0);
}

}  // namespace
}  // namespace pose_wall
