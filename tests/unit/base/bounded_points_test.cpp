// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: each block's box holds its points and is no larger than they need, whatever lies behind the last point; a row
// that is shortened is bounded anew.

#include "base/containers/bounded_points.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

struct Row {
  const Span<float>& of_points;
  const Span<float>& centre;
  const Span<float>& half;
};

void expect_tight(const BoundedPoints& points) {
  constexpr float kRounding_m = 1e-5F;
  for (const Row& row : {Row{points.x, points.centre_x, points.half_x}, Row{points.y, points.centre_y, points.half_y},
                         Row{points.z, points.centre_z, points.half_z}}) {
    for (std::uint32_t block = 0; block < points.blocks(); ++block) {
      float most = 0.0F;
      for (std::uint32_t i = block * BoundedPoints::kBlock; i < (block + 1) * BoundedPoints::kBlock; ++i) {
        if (i >= points.count) break;
        const float off = std::fabs(row.of_points[i] - row.centre[block]);
        most = off > most ? off : most;
      }
      EXPECT_NEAR(most, row.half[block], kRounding_m) << block << " of " << points.count;
    }
  }
}

TEST(BoundedPoints, BoxesAreThoseOfTheirPoints) {
  test::Noise noise(1);
  for (const std::uint32_t count : {0U, 1U, 2U, 3U, 4U, 5U, 31U, 32U, 33U, 63U, 65U, 200U}) {
    test::Placed<BoundedPoints> points(count + 1);
    const auto far_away = [&](std::uint32_t i) { points->set(i, Eigen::Vector3d(-900, 900, 900), 1.0F); };
    for (std::uint32_t i = 0; i < count + 1 + kFour; ++i) far_away(i);
    for (std::uint32_t i = 0; i < count; ++i) {
      points->set(i, Eigen::Vector3d(noise.uniform(-30, 30), noise.uniform(2, 5), noise.normal(0.01)), 1.0F);
    }
    points->count = count;
    points->bound();
    EXPECT_EQ(points->blocks(), (count + BoundedPoints::kBlock - 1) / BoundedPoints::kBlock);
    expect_tight(*points);
  }
}

TEST(BoundedPoints, BoundedAnew) {
  test::Noise noise(2);
  test::OwnedPoints points(100);
  for (int i = 0; i < 100; ++i) points.add(noise.uniform(-1, 1), noise.uniform(-1, 1), i < 40 ? 0.0 : 50.0);
  BoundedPoints& set = points.set();
  expect_tight(set);
  EXPECT_GT(set.half_z[1], 20.0F);
  set.count = 40;
  set.bound();
  expect_tight(set);
  EXPECT_EQ(set.half_z[1], 0.0F);
}

}  // namespace
}  // namespace pose_wall
