// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: four floats together are what they are one by one, and a part of four leaves the rest zero.

#include "base/simd/four_floats.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pose_wall {
namespace {

TEST(FourFloats, LoadsFromAnyPlace) {
  const float from[6] = {0.5F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F};
  const FourFloats four = load_four(from + 1);  // not on a border of 16 bytes
  for (std::uint32_t lane = 0; lane < kFour; ++lane) EXPECT_EQ(four[lane], from[1 + lane]);
}

TEST(FourFloats, SmallerLaneByLane) {
  const FourFloats a{1.0F, -1.0F, 0.0F, std::numeric_limits<float>::infinity()};
  const FourFloats smaller = smaller_of(a, all_four(0.5F));
  const float expected[kFour] = {0.5F, -1.0F, 0.0F, 0.5F};
  for (std::uint32_t lane = 0; lane < kFour; ++lane) EXPECT_EQ(smaller[lane], expected[lane]);
}

TEST(FourFloats, SumInDoubles) {
  EXPECT_EQ(sum_of_lanes(FourFloats{1e8F, 1.0F, -1e8F, 1.0F}), 2.0);
}

TEST(FourFloats, SumsOfFourAtOnceEachInItsLane) {
  const FourFloats sums = four_sums_of_lanes(FourFloats{1.0F, 2.0F, 3.0F, 4.0F}, FourFloats{}, all_four(-0.5F),
                                             FourFloats{1e3F, 1e2F, 10.0F, 1.0F});
  const float expected[kFour] = {10.0F, 0.0F, -2.0F, 1111.0F};
  for (std::uint32_t lane = 0; lane < kFour; ++lane) EXPECT_EQ(sums[lane], expected[lane]);
}

TEST(FourFloats, RowsBecomeColumns) {
  const FourWords rows[kFour] = {{0, 1, 2, 3}, {10, 11, 12, 13}, {20, 21, 22, 23}, {30, 31, 32, 33}};
  FourWords columns[kFour];
  transpose(rows[0], rows[1], rows[2], rows[3], columns);
  for (std::uint32_t row = 0; row < kFour; ++row) {
    for (std::uint32_t column = 0; column < kFour; ++column) EXPECT_EQ(columns[column][row], rows[row][column]);
  }
}

TEST(FourFloats, CutOffRootMagnitudeAnyAndStore) {
  const FourFloats four{2.9F, -2.9F, 0.25F, 9.0F};
  const std::int32_t cut[kFour] = {2, -2, 0, 9};
  const float sizes[kFour] = {2.9F, 2.9F, 0.25F, 9.0F};
  float stored[kFour];
  store_four(magnitude_of(four), stored);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    EXPECT_EQ(cut_off(four)[lane], cut[lane]);
    EXPECT_EQ(stored[lane], sizes[lane]);
    EXPECT_EQ(root_of(magnitude_of(four))[lane], std::sqrt(sizes[lane]));
  }
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    FourFloats one{};
    one[lane] = -1.0F;
    EXPECT_TRUE(any_of(one < FourFloats{}));
  }
  EXPECT_FALSE(any_of(four < all_four(-3.0F)));
}

TEST(FourFloats, LargerLaneByLaneAndLargestOfAll) {
  const FourFloats larger = larger_of(FourFloats{1.0F, -1.0F, 0.0F, 7.0F}, all_four(0.5F));
  const float expected[kFour] = {1.0F, 0.5F, 0.5F, 7.0F};
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    EXPECT_EQ(larger[lane], expected[lane]);
    FourFloats four = all_four(-3.0F);
    four[lane] = -2.0F;
    EXPECT_EQ(largest_of(four), -2.0F);
  }
}

TEST(FourFloats, EachFourIsVisitedOnceAndTheLastOnesCountAsFarAsTheyGo) {
  for (std::uint32_t count = 0; count < 14; ++count) {
    std::uint32_t next = 0;
    for_each_four(count, [&](std::uint32_t k, FourTruths counts) {
      EXPECT_EQ(k % kFour, 0U);
      for (std::uint32_t lane = 0; lane < kFour; ++lane) {
        EXPECT_EQ(counts[lane] != 0, k + lane < count);
        if (counts[lane] == 0) continue;
        EXPECT_EQ(k + lane, next);
        ++next;
      }
    });
    EXPECT_EQ(next, count);
  }
}

}  // namespace
}  // namespace pose_wall
