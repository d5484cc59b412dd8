// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: exactly the points with too few others within the radius go, counted by looking at all pairs.

#include "stages/outliers.hpp"

#include <gtest/gtest.h>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

std::vector<Eigen::Vector3d> by_all_pairs(const PointSet& points, double radius, std::uint32_t needed) {
  std::vector<Eigen::Vector3d> kept;
  for (std::uint32_t i = 0; i < points.count; ++i) {
    std::uint32_t others = 0;
    for (std::uint32_t j = 0; j < points.count; ++j) {
      if (j != i && (points.at(i) - points.at(j)).norm() <= radius) ++others;
    }
    if (others >= needed) kept.push_back(points.at(i));
  }
  return kept;
}

TEST(Outliers, AreThoseThatAllPairsSay) {
  for (const char* needed : {"0", "1", "3", "8"}) {
    for (const char* radius : {"0.2", "0.5", "1.7"}) {
      const Settings settings = test::settings_with({{"outlier_min_neighbors", needed}, {"outlier_radius", radius}});
      test::OwnedPoints points(600);
      test::Noise noise(1);
      for (int i = 0; i < 300; ++i) points.add(noise.normal(3), noise.normal(3), noise.normal(0.5));
      for (int i = 0; i < 300; ++i) points.add(5 + noise.normal(0.2), noise.normal(0.2), noise.normal(0.2));
      const std::vector<Eigen::Vector3d> expected =
          by_all_pairs(points.set(), settings.outlier_radius, settings.outlier_min_neighbors);
      test::Placed<CellIndex> cells(600U);
      std::vector<std::uint8_t> keep(600, 0xEE);
      const std::uint32_t removed =
          remove_outliers(settings, 0.01, cells.get(), Span<std::uint8_t>(keep.data(), 600), &points.set());
      ASSERT_EQ(points.set().count, expected.size()) << needed << " within " << radius;
      EXPECT_EQ(removed, 600 - expected.size());
      for (std::uint32_t i = 0; i < points.set().count; ++i) ASSERT_EQ(points.set().at(i), expected[i]) << "order";
    }
  }
}

TEST(Outliers, NothingIsLeftAlone) {
  test::OwnedPoints points(4);
  test::Placed<CellIndex> cells(4U);
  std::vector<std::uint8_t> keep(4);
  EXPECT_EQ(
      remove_outliers(test::settings_with(), 0.05, cells.get(), Span<std::uint8_t>(keep.data(), 4), &points.set()), 0U);
}

}  // namespace
}  // namespace pose_wall
