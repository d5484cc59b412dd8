// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every point is in its own cell, and all points within one edge are in the 27 cells around.

#include "containers/cell_index.hpp"

#include <gtest/gtest.h>

#include <set>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

TEST(CellIndex, FindsAllNeighboursWithinAnEdge) {
  constexpr std::uint32_t kCount = 800;
  constexpr double kEdge = 0.3;
  test::OwnedPoints points(kCount);
  test::Noise noise(1);
  for (std::uint32_t i = 0; i < kCount; ++i) {
    points.add(noise.uniform(-1, 1), noise.uniform(-1, 1), noise.uniform(-1, 1));
  }
  test::Placed<CellIndex> cells(kCount);
  for (int round = 0; round < 2; ++round) cells->build(points.set(), kEdge);
  const PointSet& set = points.set();
  for (std::uint32_t i = 0; i < kCount; i += 7) {
    std::set<std::uint32_t> found;
    const std::int32_t cx = cells->cell(set.x[i]), cy = cells->cell(set.y[i]), cz = cells->cell(set.z[i]);
    for (std::int32_t dx = -1; dx <= 1; ++dx) {
      for (std::int32_t dy = -1; dy <= 1; ++dy) {
        for (std::int32_t dz = -1; dz <= 1; ++dz) {
          for (const std::uint32_t j : cells->points_in(cx + dx, cy + dy, cz + dz)) {
            EXPECT_TRUE(found.insert(j).second) << "a point in two cells";
          }
        }
      }
    }
    for (std::uint32_t j = 0; j < kCount; ++j) {
      const bool near = (set.at(i) - set.at(j)).norm() <= kEdge;
      EXPECT_TRUE(!near || found.count(j) == 1);
    }
  }
  EXPECT_EQ(cells->points_in(1000, 0, 0).size(), 0U);
}

TEST(CellIndex, BesideAPointAreThoseOfItsCell) {
  test::OwnedPoints points(300);
  test::Noise noise(2);
  for (int i = 0; i < 300; ++i) points.add(noise.uniform(-1, 1), noise.uniform(-1, 1), noise.uniform(-1, 1));
  test::Placed<CellIndex> cells(300U);
  cells->build(points.set(), 0.4);
  const PointSet& set = points.set();
  for (std::uint32_t i = 0; i < 300; ++i) {
    const Span<const std::uint32_t> beside = cells->points_beside(i);
    const auto in_cell = cells->points_in(cells->cell(set.x[i]), cells->cell(set.y[i]), cells->cell(set.z[i]));
    EXPECT_EQ(beside.data(), in_cell.data());
    EXPECT_EQ(beside.size(), in_cell.size());
    EXPECT_GE(beside.size(), 1U);
  }
}

TEST(CellIndex, EmptyCloud) {
  test::OwnedPoints points(4);
  test::Placed<CellIndex> cells(4U);
  cells->build(points.set(), 1.0);
  EXPECT_EQ(cells->points_in(0, 0, 0).size(), 0U);
}

TEST(CellIndex, FullToTheLastCell) {
  test::OwnedPoints points(64);
  for (int i = 0; i < 64; ++i) points.add(i + 0.5, 0.5, 0.5);
  test::Placed<CellIndex> cells(64U);
  cells->build(points.set(), 1.0);
  for (int i = 0; i < 64; ++i) {
    ASSERT_EQ(cells->points_in(i, 0, 0).size(), 1U);
    EXPECT_EQ(cells->points_in(i, 0, 0)[0], static_cast<std::uint32_t>(i));
  }
}

}  // namespace
}  // namespace pose_wall
