// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: exactly the points with too few others within the radius go, counted by looking at all pairs.

#include "engine/cloud/outliers.hpp"

#include <gtest/gtest.h>

#include "base/estimation/near_plane.hpp"
#include "support/stage_fixtures.hpp"
#include "support/voxels.hpp"

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

struct Voxels {
  explicit Voxels(double leaf_m) : grid(600U), points(600U), keep(600, 0xEE) { grid->begin(leaf_m, 100.0); }

  void add(double x, double y, double z) { test::add_point(grid.get(), x, y, z); }
  std::uint32_t remove_outliers(const Settings& settings) {
    return pose_wall::remove_outliers(settings, grid.get(), Span<std::uint8_t>(keep.data(), 600), points.get(), &work);
  }

  Work work;
  test::Placed<VoxelGrid> grid;
  test::Placed<BoundedPoints> points;
  std::vector<std::uint8_t> keep;
};

TEST(Outliers, AreThoseThatAllPairsSay) {
  for (const char* needed : {"0", "1", "3", "8"}) {
    for (const char* radius : {"0.2", "0.5", "1.7"}) {
      const Settings settings = test::settings_with({{"outlier_min_neighbors", needed}, {"outlier_radius", radius}});
      Voxels voxels(0.02);
      test::Noise noise(1);
      for (int i = 0; i < 300; ++i) voxels.add(noise.normal(3), noise.normal(3), noise.normal(0.5));
      for (int i = 0; i < 300; ++i) voxels.add(5 + noise.normal(0.2), noise.normal(0.2), noise.normal(0.2));
      voxels.grid->extract(voxels.points.get());
      const std::uint32_t before = voxels.points->count;
      const std::vector<Eigen::Vector3d> expected =
          by_all_pairs(*voxels.points, settings.outlier_radius, settings.outlier_min_neighbors);
      const std::uint32_t removed = voxels.remove_outliers(settings);
      ASSERT_EQ(voxels.points->count, expected.size()) << needed << " within " << radius;
      std::uint32_t in_blocks = 0;
      for_each_in(*voxels.points, Slab(Plane{}, 1e3), [&](std::uint32_t, float) { ++in_blocks; });
      EXPECT_EQ(in_blocks, voxels.points->count) << "bounded, also where none are asked for";
      EXPECT_NEAR(voxels.points->centre_x[0], voxels.points->x[0], voxels.points->half_x[0] + 1e-4F);
      EXPECT_EQ(removed, before - expected.size());
      for (std::uint32_t i = 0; i < voxels.points->count; ++i) ASSERT_EQ(voxels.points->at(i), expected[i]) << "order";
    }
  }
}

TEST(Outliers, NothingIsLeftAlone) {
  Voxels voxels(0.05);
  voxels.grid->extract(voxels.points.get());
  EXPECT_EQ(voxels.remove_outliers(test::settings_with()), 0U);
}

// More than the list's neighbours can tell, and columns of more than a few.
TEST(Outliers, FiftyNeighboursInDenseRockAreCountedRight) {
  const Settings settings =
      test::settings_with({{"outlier_min_neighbors", "50"}, {"outlier_radius", "0.3"}, {"voxel_leaf", "0.02"}});
  Voxels voxels(0.02);
  test::Noise noise(3);
  for (int i = 0; i < 450; ++i) voxels.add(noise.normal(0.05), noise.normal(0.05), noise.normal(0.6));
  voxels.grid->extract(voxels.points.get());
  const std::vector<Eigen::Vector3d> expected = by_all_pairs(*voxels.points, 0.3, 50);
  ASSERT_GT(expected.size(), 100U);
  ASSERT_LT(expected.size(), voxels.points->count);
  voxels.remove_outliers(settings);
  ASSERT_EQ(voxels.points->count, expected.size());
  for (std::uint32_t i = 0; i < voxels.points->count; ++i) ASSERT_EQ(voxels.points->at(i), expected[i]);
}

// Where the leaf has grown, the radius of a finer one would leave every voxel alone.
TEST(Outliers, TheRadiusIsTwoLeavesAtLeast) {
  Voxels voxels(0.26);
  for (int i = 0; i < 100; ++i) voxels.add(0.26 * (i % 10) + 0.1, 0.26 * (i / 10) + 0.1, 0.1);
  voxels.add(10.0, 10.0, 0.1);
  voxels.grid->extract(voxels.points.get());
  EXPECT_EQ(voxels.remove_outliers(test::settings_with({{"outlier_radius", "0.02"}})), 1U);
  EXPECT_EQ(voxels.points->count, 100U);
}

}  // namespace
}  // namespace pose_wall
