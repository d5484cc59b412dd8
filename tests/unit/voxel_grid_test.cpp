// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: centroids are right to a quantisation step, do not depend on the order of points, come out in the order of
// their cells, and a grid without room says so.

#include "containers/voxel_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <tuple>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

using Xyz = std::array<double, 3>;

std::vector<Xyz> random_points(std::size_t count, double reach, std::uint32_t seed) {
  test::Noise noise(seed);
  std::vector<Xyz> points(count);
  for (Xyz& p : points) {
    for (double& c : p) c = noise.uniform(-reach, reach);
  }
  return points;
}

struct Gridded {
  std::vector<std::array<float, 4>> centroids;
  std::uint64_t fingerprint = 0;
};

Gridded gridded(const std::vector<Xyz>& points, double leaf, std::uint32_t capacity = 20000) {
  test::Placed<VoxelGrid> grid(capacity);
  test::Placed<PointSet> out(capacity);
  grid->reset();
  grid->begin(leaf);
  for (const Xyz& p : points) EXPECT_TRUE(grid->add(p[0], p[1], p[2], kWeightOne));
  grid->extract(out.get());
  Gridded g;
  for (std::uint32_t i = 0; i < out->count; ++i)
    g.centroids.push_back({out->x[i], out->y[i], out->z[i], out->weight[i]});
  g.fingerprint = grid->fingerprint();
  return g;
}

// Quantisation to 2^-14 m is at most 0.031 mm per point and so per mean; floats at 30 m add 0.001 mm.
TEST(VoxelGrid, CentroidsAreMeansToThreeHundredthsOfAMillimetre) {
  const std::vector<Xyz> points = random_points(20000, 2.0, 1);
  constexpr double kLeaf = 0.25;  // whole steps, so that the cells' borders are exactly there
  std::map<std::tuple<long, long, long>, std::array<double, 4>> expected;
  for (const Xyz& p : points) {
    const auto cell = [&](double c) { return std::lround(std::floor(std::floor(c * 16384 + 0.5) / 16384 / kLeaf)); };
    auto& sum = expected[{cell(p[0]), cell(p[1]), cell(p[2])}];
    for (std::size_t k = 0; k < 3; ++k) sum[k] += p[k];
    sum[3] += 1.0;
  }
  const Gridded g = gridded(points, kLeaf);
  ASSERT_EQ(g.centroids.size(), expected.size());
  std::size_t i = 0;
  for (const auto& [cell, sum] : expected) {  // a map is in the order of x, y, z: so are the centroids
    for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(g.centroids[i][k], sum[k] / sum[3], 3.2e-5);
    ASSERT_EQ(static_cast<double>(g.centroids[i][3]), sum[3]);
    ++i;
  }
}

TEST(VoxelGrid, OrderOfPointsDoesNotMatterToASingleBit) {
  std::vector<Xyz> points = random_points(15000, 3.0, 2);
  const Gridded before = gridded(points, 0.05 * 3.7);
  std::mt19937 random(9);
  for (int round = 0; round < 3; ++round) {
    std::shuffle(points.begin(), points.end(), random);
    const Gridded after = gridded(points, 0.05 * 3.7);
    EXPECT_EQ(after.centroids, before.centroids);
    EXPECT_EQ(after.fingerprint, before.fingerprint);
  }
}

TEST(VoxelGrid, AnotherCloudHasAnotherFingerprint) {
  std::vector<Xyz> points = random_points(1000, 1.0, 3);
  const std::uint64_t before = gridded(points, 0.1).fingerprint;
  points[500][2] += 0.001;
  EXPECT_NE(gridded(points, 0.1).fingerprint, before);
  points.pop_back();
  EXPECT_NE(gridded(points, 0.1).fingerprint, before);
}

TEST(VoxelGrid, EveryCentroidLiesWithinOneLeafOfItsPoints) {
  // Leaves that do not divide a metre, far from the origin, where borders are easily rounded to the wrong side.
  for (const double leaf : {0.01, 0.037, 0.05, 0.1, 0.3, 7.0}) {
    for (const Xyz& p : random_points(300, 190.0, 4)) {
      const Gridded g = gridded({p}, leaf, 10);
      ASSERT_EQ(g.centroids.size(), 1U);
      // Half a step, and the float's own grid at 190 m: 8e-6.
      for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(g.centroids[0][k], p[k], 4.5e-5) << leaf;
    }
  }
}

TEST(VoxelGrid, OverflowIsToldAndKnownCellsStillTakePoints) {
  test::Placed<VoxelGrid> grid(4U);
  grid->reset();
  grid->begin(1.0);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(grid->add(i + 0.5, 0.5, 0.5, kWeightOne));
  EXPECT_FALSE(grid->add(9.5, 0.5, 0.5, kWeightOne));
  EXPECT_TRUE(grid->add(2.6, 0.5, 0.5, kWeightOne));
  EXPECT_EQ(grid->count(), 4U);
}

TEST(VoxelGrid, WeightsPullTheCentroid) {
  test::Placed<VoxelGrid> grid(4U);
  test::Placed<PointSet> out(4U);
  grid->reset();
  grid->begin(1.0);
  grid->add(0.25, 0.5, 0.5, 3 * kWeightOne);
  grid->add(0.75, 0.5, 0.5, kWeightOne);
  grid->extract(out.get());
  EXPECT_NEAR(out->x[0], 0.375F, 3.2e-5F);
  EXPECT_EQ(out->weight[0], 4.0F);
}

TEST(VoxelGrid, BeginForgetsTheLastFrame) {
  test::Placed<VoxelGrid> grid(100U);
  test::Placed<PointSet> out(100U);
  grid->reset();
  grid->begin(1.0);
  grid->add(0.5, 0.5, 0.5, kWeightOne);
  grid->begin(1.0);
  grid->add(0.25, 0.25, 0.25, kWeightOne);
  grid->extract(out.get());
  ASSERT_EQ(out->count, 1U);
  EXPECT_EQ(out->x[0], 0.25F);
  grid->begin(1.0);
  grid->extract(out.get());
  EXPECT_EQ(out->count, 0U);
}

}  // namespace
}  // namespace pose_wall
