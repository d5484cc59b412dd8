// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a key tells its cell, keys are in the order of columns and heights, and a column's keys are a run.

#include "engine/cloud/voxel_key.hpp"

#include <gtest/gtest.h>

#include <random>

#include "support/voxels.hpp"

namespace pose_wall {
namespace {

constexpr std::int32_t kLastCell = (1 << 21) - 1;

TEST(VoxelKey, TellsItsCell) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::int32_t> draw(0, kLastCell);
  for (int i = 0; i < 10000; ++i) {
    VoxelKey::FourCells cells{};
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      cells.x[lane] = draw(random);
      cells.y[lane] = draw(random);
      cells.z[lane] = draw(random);
    }
    std::uint64_t keys[kFour];
    VoxelKey::of_four(cells, keys);
    const VoxelKey::FourCells back = VoxelKey::cells_of(keys);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      ASSERT_EQ(back.x[lane], cells.x[lane]);
      ASSERT_EQ(back.y[lane], cells.y[lane]);
      ASSERT_EQ(back.z[lane], cells.z[lane]);
      ASSERT_EQ(VoxelKey::z_of(keys[lane]), static_cast<std::uint32_t>(cells.z[lane]));
      ASSERT_EQ(keys[lane], test::key_of(cells.x[lane], cells.y[lane], cells.z[lane])) << "each lane for itself";
    }
  }
  EXPECT_EQ(test::key_of(0, 0, 0), 0U);
  EXPECT_EQ(test::key_of(kLastCell, kLastCell, kLastCell), (1ULL << 63) - 1);
}

TEST(VoxelKey, IsInTheOrderOfColumnsAndHeights) {
  EXPECT_LT(test::key_of(3, kLastCell, kLastCell), test::key_of(4, 0, 0)) << "columns along x come first";
  EXPECT_LT(test::key_of(3, 3, kLastCell), test::key_of(0, 4, 0)) << "then along y";
  EXPECT_LT(test::key_of(3, 3, 7), test::key_of(0, 0, 8)) << "within a column the lower one";
  EXPECT_LT(test::key_of(1, 3, 7), test::key_of(2, 0, 7)) << "and at the same height by x";
  EXPECT_LT(test::key_of(1, 2, 7), test::key_of(1, 3, 7));
}

TEST(VoxelKey, OfAColumnTheLeastAndTheNextBoundARun) {
  const std::uint64_t column = VoxelKey::column_at(17, 29);
  EXPECT_EQ(VoxelKey::x_of_column(column), 17U);
  EXPECT_EQ(VoxelKey::y_of_column(column), 29U);
  for (std::int32_t x = 60; x < 80; ++x) {
    for (std::int32_t y = 108; y < 128; ++y) {
      for (std::int32_t z = 40; z < 50; ++z) {
        const std::uint64_t key = test::key_of(x, y, z);
        const bool in_run = key >= VoxelKey::least_of(column, 43) && key < VoxelKey::least_of(column, 47);
        const bool in_column = x / 4 == 17 && y / 4 == 29;
        ASSERT_EQ(VoxelKey::column_of(key) == column, in_column);
        ASSERT_EQ(in_run, in_column && z >= 43 && z < 47);
      }
    }
  }
}

}  // namespace
}  // namespace pose_wall
