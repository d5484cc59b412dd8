// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: spans and point sets borrow, and copy what they say.

#include "base/containers/point_set.hpp"

#include <gtest/gtest.h>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

TEST(Span, BorrowsWithoutOwning) {
  int numbers[] = {1, 2, 3, 4};
  const Span<int> span(numbers, 4);
  span[2] = 7;
  EXPECT_EQ(numbers[2], 7);
  EXPECT_EQ(span.first(2).size(), 2U);
  const Span<const int> constant = span;
  int sum = 0;
  for (const int n : constant) sum += n;
  EXPECT_EQ(sum, 14);
  EXPECT_EQ(Span<int>().size(), 0U);
}

TEST(PointSet, SetCopyAndReadBack) {
  test::OwnedPoints points(3);
  points.add(1.5, -2.25, 3.75, 4.0F);
  points.add(0.0, 0.0, 0.0);
  PointSet& set = points.set();
  set.copy(1, 0);
  EXPECT_EQ(set.at(1), Eigen::Vector3d(1.5, -2.25, 3.75));
  EXPECT_EQ(set.weight[1], 4.0F);
  EXPECT_EQ(set.capacity(), 3U);
  EXPECT_EQ(set.count, 2U);
}

TEST(PointSet, FourAtATimeAreAllOfThemOnce) {
  for (std::uint32_t count = 0; count < 14; ++count) {
    test::OwnedPoints points(count + 1);
    for (std::uint32_t i = 0; i < count; ++i) points.add(i + 0.25, -2.0 * i, 100.0 + i);
    std::uint32_t next = 0;
    for_each_four_points(points.set(),
                         [&](std::uint32_t i, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
                           ASSERT_EQ(i, next);
                           for (std::uint32_t lane = 0; lane < kFour; ++lane) {
                             ASSERT_EQ(counts[lane] != 0, i + lane < count);
                             if (counts[lane] == 0) continue;
                             EXPECT_EQ(x[lane], points.set().x[next]);
                             EXPECT_EQ(y[lane], points.set().y[next]);
                             EXPECT_EQ(z[lane], points.set().z[next++]);
                           }
                         });
    EXPECT_EQ(next, count);
  }
}

}  // namespace
}  // namespace pose_wall
