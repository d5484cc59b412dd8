// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the runs around a voxel hold every one within the reach once, and no more than lies about there.

#include "engine/cloud/voxel_columns.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "support/stage_fixtures.hpp"
#include "support/voxels.hpp"

namespace pose_wall {
namespace {

constexpr double kLeaf_m = 0.05;

struct ColumnVoxels {
  explicit ColumnVoxels(std::uint32_t capacity) : grid(capacity), points(capacity) { grid->begin(kLeaf_m, 50.0); }

  void add(double x, double y, double z) { ASSERT_TRUE(test::add_point(grid.get(), x, y, z)); }

  test::Placed<VoxelGrid> grid;
  test::Placed<PointSet> points;
};

void expect_all_within(double reach_m, ColumnVoxels* voxels, std::uint32_t every) {
  voxels->grid->extract(voxels->points.get());
  const PointSet& points = *voxels->points;
  VoxelColumns columns(voxels->grid.get(), reach_m);
  for (std::uint32_t i = 0; i < points.count; i += every) {
    std::vector<int> held(points.count);
    columns.for_each_run(i, [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t j = begin; j < end; ++j) ++held[j];
      return true;
    });
    for (std::uint32_t j = 0; j < points.count; ++j) {
      const double away_m = (points.at(i) - points.at(j)).norm();
      ASSERT_LE(held[j], 1) << "twice";
      if (away_m <= reach_m) {
        ASSERT_EQ(held[j], 1) << i << " and " << j << ", " << away_m << " m apart";
      }
    }
    ASSERT_EQ(held[i], 1);
  }
}

TEST(VoxelColumns, AroundAVoxelIsAllWithinTheReach) {
  for (const double reach_m : {0.1, 0.2, 0.37, 2.0}) {
    ColumnVoxels voxels(4000);
    test::Noise noise(7);
    for (int i = 0; i < 3000; ++i) voxels.add(noise.normal(0.8), noise.normal(0.8), noise.normal(0.8));
    expect_all_within(reach_m, &voxels, 1);
    expect_all_within(reach_m, &voxels, 37);
  }
}

// A shaft: thousands in a few columns.
TEST(VoxelColumns, OfATallColumnOnlyWhatIsAboutAsHigh) {
  ColumnVoxels voxels(20000);
  for (int z = 0; z < 1500; ++z) {
    for (int k = 0; k < 12; ++k) voxels.add(0.05 * (k % 4) + 0.01, 0.05 * (k / 4) + 0.01, 0.05 * z - 37.0);
  }
  voxels.grid->extract(voxels.points.get());
  VoxelColumns columns(voxels.grid.get(), 0.2);
  std::uint32_t most = 0;
  for (std::uint32_t i = 0; i < voxels.points->count; ++i) {
    std::uint32_t looked_at = 0;
    columns.for_each_run(i, [&](std::uint32_t begin, std::uint32_t end) {
      looked_at += end - begin;
      return true;
    });
    most = looked_at > most ? looked_at : most;
  }
  EXPECT_LE(most, 9U * 12U) << "four layers up and down";
}

// The lists of the last frame are another stage's by now.
TEST(VoxelColumns, OfAGridThatWasOnlyBegunThereAreNone) {
  ColumnVoxels voxels(100);
  for (int i = 0; i < 8; ++i) voxels.add(0.3 * i, 0.0, 0.0);
  voxels.grid->extract(voxels.points.get());
  ASSERT_EQ(voxels.grid->find_columns().size(), 9U);
  voxels.grid->begin(64.0, 50.0);
  const Span<const std::uint32_t> columns = voxels.grid->find_columns();
  ASSERT_EQ(columns.size(), 1U);
  EXPECT_EQ(columns[0], 0U);
}

TEST(VoxelColumns, TheConfigsExtremesAreWithinTheirReach) {
  double radius_most = 0.0, leaf_least = 0.0;
  for (std::uint32_t i = 0; i < pose_wall_config_key_count(); ++i) {
    pose_wall_key_info key;
    ASSERT_EQ(pose_wall_config_key(i, &key), POSE_WALL_OK);
    if (key.name == std::string("outlier_radius")) radius_most = key.maximum;
    if (key.name == std::string("voxel_leaf")) leaf_least = key.minimum;
  }
  ASSERT_GT(radius_most, 0.0);
  ASSERT_GT(leaf_least, 0.0);
  EXPECT_LE(std::ceil(radius_most / (VoxelKey::kColumnCells * leaf_least)), VoxelColumns::kReachMost);
}

TEST(VoxelColumns, EndWhereTheVisitorSaysSo) {
  ColumnVoxels voxels(100);
  for (int i = 0; i < 8; ++i) voxels.add(0.3 * i, 0.0, 0.0);
  voxels.grid->extract(voxels.points.get());
  VoxelColumns columns(voxels.grid.get(), 1.0);
  for (std::uint32_t i = 0; i < voxels.points->count; ++i) {
    int visits = 0;
    columns.for_each_run(i, [&](std::uint32_t begin, std::uint32_t end) {
      EXPECT_TRUE(begin <= i && i < end) << "its own column is the first";
      ++visits;
      return false;
    });
    EXPECT_EQ(visits, 1);
  }
}

}  // namespace
}  // namespace pose_wall
