// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: centroids are right to a quantisation step, do not depend on the order of points, come out in the order of
// their cells, and a grid without room says so.

#include "engine/cloud/voxel_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <tuple>

#include "support/stage_fixtures.hpp"
#include "support/voxels.hpp"

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
};

constexpr double kReach_m = 200.0;

bool add(VoxelGrid* grid, const Xyz& p, std::uint32_t weight = kWeightOne) {
  return test::add_point(grid, p[0], p[1], p[2], weight);
}

Gridded gridded(const std::vector<Xyz>& points, double leaf, std::uint32_t capacity = 20000) {
  test::Placed<VoxelGrid> grid(capacity);
  test::Placed<PointSet> out(capacity);
  grid->begin(leaf, kReach_m);
  for (const Xyz& p : points) EXPECT_TRUE(add(grid.get(), p));
  grid->extract(out.get());
  Gridded g;
  for (std::uint32_t i = 0; i < out->count; ++i)
    g.centroids.push_back({out->x[i], out->y[i], out->z[i], out->weight[i]});
  return g;
}

// A step is a 1024th of the leaf: a mean is off by less, and by less than half of it where there are many points.
TEST(VoxelGrid, CentroidsAreMeansToHalfAStep) {
  const std::vector<Xyz> points = random_points(20000, 2.0, 1);
  constexpr double kLeaf = 0.25, kStep_m = kLeaf / 1024.0;
  using Cell = std::tuple<long, long, long>;
  const auto cell_of = [](const Xyz& p) {
    const auto cell = [](double c) { return std::lround(std::floor(c / kLeaf)); };
    return Cell(cell(p[0]), cell(p[1]), cell(p[2]));
  };
  std::map<Cell, std::array<double, 4>> expected;
  for (const Xyz& p : points) {
    // Borders are where the float says; 200 m are told to 8e-6.
    const auto near_border = [&](double c) { return std::fabs(c / kLeaf - std::round(c / kLeaf)) < 1e-3; };
    if (near_border(p[0]) || near_border(p[1]) || near_border(p[2])) continue;
    auto& sum = expected[cell_of(p)];
    for (std::size_t k = 0; k < 3; ++k) sum[k] += p[k];
    sum[3] += 1.0;
  }
  std::vector<Xyz> inside;
  for (const Xyz& p : points) {
    const auto near_border = [&](double c) { return std::fabs(c / kLeaf - std::round(c / kLeaf)) < 1e-3; };
    if (!near_border(p[0]) && !near_border(p[1]) && !near_border(p[2])) inside.push_back(p);
  }
  const Gridded g = gridded(inside, kLeaf);
  ASSERT_EQ(g.centroids.size(), expected.size());
  double off = 0.0;
  for (const std::array<float, 4>& c : g.centroids) {
    const auto& sum = expected.at(cell_of({c[0], c[1], c[2]}));
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_NEAR(c[k], sum[k] / sum[3], 0.6 * kStep_m);
      off += c[k] - sum[k] / sum[3];
    }
    ASSERT_EQ(static_cast<double>(c[3]), sum[3]);
  }
  EXPECT_LT(std::fabs(off / static_cast<double>(3 * expected.size())), 0.07 * kStep_m)
      << "cutting steps off moves nothing but what the float leaves of a step, a sixteenth";
}

TEST(VoxelGrid, CentroidsComeInTheOrderOfTheirKeys) {
  test::Placed<VoxelGrid> grid(20000U);
  test::Placed<PointSet> out(20000U);
  constexpr double kLeaf = 0.1;
  grid->begin(kLeaf, kReach_m);
  for (const Xyz& p : random_points(15000, 3.0, 8)) EXPECT_TRUE(add(grid.get(), p));
  grid->extract(out.get());
  const std::array<std::int32_t, 3> first = test::cell_of(grid->key_in_order(0));
  for (std::uint32_t i = 1; i < out->count; ++i) {
    ASSERT_LT(grid->key_in_order(i - 1), grid->key_in_order(i));
    const std::array<std::int32_t, 3> cell = test::cell_of(grid->key_in_order(i));
    ASSERT_NEAR(out->x[i] - out->x[0], kLeaf * (cell[0] - first[0]), kLeaf) << "the key is that of the centroid";
    ASSERT_NEAR(out->y[i] - out->y[0], kLeaf * (cell[1] - first[1]), kLeaf);
    ASSERT_NEAR(out->z[i] - out->z[0], kLeaf * (cell[2] - first[2]), kLeaf);
  }
  const Span<const std::uint32_t> begins = grid->find_columns();
  ASSERT_EQ(begins[0], 0U);
  ASSERT_EQ(begins[begins.size() - 1], out->count);
  for (std::uint32_t c = 0; c + 1 < begins.size(); ++c) {
    const std::uint64_t column = VoxelKey::column_of(grid->key_in_order(begins[c]));
    ASSERT_LT(begins[c], begins[c + 1]);
    ASSERT_EQ(VoxelKey::column_of(grid->key_in_order(begins[c + 1] - 1)), column);
    if (begins[c + 1] < out->count) {
      ASSERT_LT(column, VoxelKey::column_of(grid->key_in_order(begins[c + 1])));
    }
  }
}

TEST(VoxelGrid, AsTheyCameAreTheSameCentroidsInTheOrderOfTheirFirstPoints) {
  test::Placed<VoxelGrid> grid(20000U);
  test::Placed<PointSet> sorted(20000U), came(20000U);
  const std::vector<Xyz> points = random_points(15000, 1.0, 9);
  grid->begin(0.1, kReach_m);
  for (const Xyz& p : points) EXPECT_TRUE(add(grid.get(), p));
  grid->extract(sorted.get());
  grid->extract_as_they_came(came.get());
  const auto all_of = [](const PointSet& set) {
    std::vector<std::array<float, 4>> all;
    for (std::uint32_t i = 0; i < set.count; ++i) all.push_back({set.x[i], set.y[i], set.z[i], set.weight[i]});
    std::sort(all.begin(), all.end());
    return all;
  };
  EXPECT_EQ(all_of(*came), all_of(*sorted));
  std::uint32_t next = 0;
  test::Placed<VoxelGrid> alone(20000U);
  alone->begin(0.1, kReach_m);
  for (const Xyz& p : points) {
    if (alone->count() == came->count) break;
    EXPECT_TRUE(add(alone.get(), p));
    if (alone->count() == next) continue;  // a cell that was there
    for (int k = 0; k < 3; ++k) {
      const float centre = k == 0 ? came->x[next] : (k == 1 ? came->y[next] : came->z[next]);
      EXPECT_NEAR(centre, p[static_cast<std::size_t>(k)], 0.101) << next;
    }
    ++next;
  }
  EXPECT_EQ(next, came->count);
}

TEST(VoxelGrid, OrderOfPointsDoesNotMatterToASingleBit) {
  std::vector<Xyz> points = random_points(15000, 3.0, 2);
  const Gridded before = gridded(points, 0.05 * 3.7);
  std::mt19937 random(9);
  for (int round = 0; round < 3; ++round) {
    std::shuffle(points.begin(), points.end(), random);
    const Gridded after = gridded(points, 0.05 * 3.7);
    EXPECT_EQ(after.centroids, before.centroids);
  }
}

TEST(VoxelGrid, EveryCentroidLiesWithinOneLeafOfItsPoints) {
  // Leaves that do not divide a metre, far from the origin, where borders are easily rounded to the wrong side.
  for (const double leaf : {0.01, 0.037, 0.05, 0.1, 0.3, 7.0}) {
    for (const Xyz& p : random_points(300, 190.0, 4)) {
      const Gridded g = gridded({p}, leaf, 10);
      ASSERT_EQ(g.centroids.size(), 1U);
      // Half a step, and the float's own grid: steps are counted over up to 550 m, to 6.1e-5.
      for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(g.centroids[0][k], p[k], 0.5 * leaf / 1024.0 + 7e-5) << leaf;
    }
  }
}

TEST(VoxelGrid, OverflowIsToldAndKnownCellsStillTakePoints) {
  test::Placed<VoxelGrid> grid(4U);
  grid->begin(1.0, kReach_m);
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(add(grid.get(), {i + 0.5, 0.5, 0.5}));
  EXPECT_FALSE(add(grid.get(), {9.5, 0.5, 0.5}));
  EXPECT_TRUE(add(grid.get(), {2.6, 0.5, 0.5}));
  EXPECT_EQ(grid->count(), 4U);
}

TEST(VoxelGrid, WeightsPullTheCentroid) {
  test::Placed<VoxelGrid> grid(4U);
  test::Placed<PointSet> out(4U);
  grid->begin(1.0, kReach_m);
  add(grid.get(), {0.25, 0.5, 0.5}, 3 * kWeightOne);
  add(grid.get(), {0.75, 0.5, 0.5});
  grid->extract(out.get());
  EXPECT_NEAR(out->x[0], 0.375F, 1e-3F);
  EXPECT_EQ(out->weight[0], 4.0F);
}

TEST(VoxelGrid, BeginForgetsTheLastFrame) {
  test::Placed<VoxelGrid> grid(100U);
  test::Placed<PointSet> out(100U);
  grid->begin(1.0, kReach_m);
  add(grid.get(), {0.5, 0.5, 0.5});
  grid->begin(1.0, kReach_m);
  add(grid.get(), {0.25, 0.25, 0.25});
  grid->extract(out.get());
  ASSERT_EQ(out->count, 1U);
  EXPECT_NEAR(out->x[0], 0.25F, 1e-3F);
  grid->begin(1.0, kReach_m);
  grid->extract(out.get());
  EXPECT_EQ(out->count, 0U);
}

// Four at a time is as one by one, each with its own weight.
TEST(VoxelGrid, FourPointsAreSplitAsEachIs) {
  test::Placed<VoxelGrid> together(100U), one_by_one(100U);
  test::Placed<PointSet> a(100U), b(100U);
  const FourFloats x{-3.2F, 0.1F, 0.15F, 190.0F}, y{5.0F, -0.1F, -0.12F, -190.0F}, z{0.0F, 0.3F, 0.31F, 2.0F};
  const FourWords weights{1, 16, 7, 1U << 22};
  for (auto* grid : {together.get(), one_by_one.get()}) grid->begin(0.25, kReach_m);
  std::uint64_t keys[kFour];
  VoxelGrid::Sums sums[kFour];
  together->split(x, y, z, weights, keys, sums);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    EXPECT_TRUE(VoxelGrid::Filling(together.get()).add(keys[lane], sums[lane]));
    EXPECT_TRUE(add(one_by_one.get(), {x[lane], y[lane], z[lane]}, weights[lane]));
  }
  together->extract(a.get());
  one_by_one->extract(b.get());
  ASSERT_EQ(a->count, 3U) << "the second and the third share a voxel";
  ASSERT_EQ(b->count, 3U);
  for (std::uint32_t i = 0; i < 3; ++i) {
    EXPECT_EQ(a->x[i], b->x[i]);
    EXPECT_EQ(a->y[i], b->y[i]);
    EXPECT_EQ(a->z[i], b->z[i]);
    EXPECT_EQ(a->weight[i], b->weight[i]);
    if (a->weight[i] != 23.0F / kWeightOne) continue;
    const float share = 16.0F / 23.0F, step_m = 0.25F / 1024.0F;
    EXPECT_NEAR(a->x[i], share * x[1] + (1.0F - share) * x[2], step_m);
    EXPECT_NEAR(a->y[i], share * y[1] + (1.0F - share) * y[2], step_m);
    EXPECT_NEAR(a->z[i], share * z[1] + (1.0F - share) * z[2], step_m);
  }
}

// Sums are kept within their words: what would make it more than a quarter of a million points is left out.
TEST(VoxelGrid, MorePointsThanACellCounts) {
  test::Placed<VoxelGrid> grid(4U);
  test::Placed<PointSet> out(4U);
  grid->begin(1.0, kReach_m);
  for (int i = 0; i < 300000; ++i) add(grid.get(), {0.999, 0.999, 0.999});
  grid->extract(out.get());
  ASSERT_EQ(out->count, 1U);
  EXPECT_NEAR(out->x[0], 0.999F, 1e-3F);
  EXPECT_EQ(out->weight[0], 262144.0F);
  grid->begin(1.0, kReach_m);
  add(grid.get(), {0.25, 0.25, 0.25});
  add(grid.get(), {0.75, 0.75, 0.75}, VoxelGrid::kWeightMost);
  grid->extract(out.get());
  EXPECT_EQ(out->weight[0], 1.0F) << "all of it or nothing";
  grid->begin(1.0, kReach_m);
  add(grid.get(), {0.75, 0.75, 0.75}, VoxelGrid::kWeightMost);
  grid->extract(out.get());
  EXPECT_EQ(out->weight[0], 262144.0F) << "as much as there is room for";
  EXPECT_NEAR(out->z[0], 0.75F, 1e-3F);
}

// Middles of cells of 0.25 m whose keys begin at three neighbouring slots of the table for so many.
std::vector<Xyz> points_of_few_slots(std::uint32_t capacity) {
  constexpr double kEdge_m = 0.25;  // of a float's exact values: no middle is rounded into the next cell
  constexpr std::int32_t kReach = 100, kOrigin = 1365;  // cells; the first cell of a grid that reaches 200 m
  std::uint32_t bits = 1;
  while ((1U << bits) < 2 * capacity) ++bits;
  std::vector<Xyz> points;
  for (std::int32_t x = -kReach; x < kReach; ++x) {
    for (std::int32_t y = -kReach; y < kReach; ++y) {
      for (std::int32_t z = -4; z < 12 && points.size() < capacity; ++z) {
        const std::uint64_t key = test::key_of(x + kOrigin, y + kOrigin, z + kOrigin);
        if (((key * 0x9E3779B97F4A7C15ULL) >> (64 - bits)) / 3 != 100) continue;
        points.push_back({(x + 0.5) * kEdge_m, (y + 0.5) * kEdge_m, (z + 0.5) * kEdge_m});
      }
    }
  }
  return points;
}

// Cells that crowd in one table and in another do not give the same centroids, in the same order.
TEST(VoxelGrid, CrowdingChangesNothing) {
  constexpr std::uint32_t kRoom = 500;
  std::vector<Xyz> points = points_of_few_slots(kRoom);
  ASSERT_EQ(points.size(), kRoom);
  std::shuffle(points.begin(), points.end(), std::mt19937(3));
  const std::vector<Xyz> once = points;
  for (const Xyz& p : once) points.push_back({p[0] + 0.03, p[1] - 0.05, p[2] + 0.07});
  const auto gridded_in = [&](std::uint32_t capacity, bool in_order, VoxelGrid* grid) {
    test::Placed<PointSet> out(capacity);
    grid->begin(0.25, kReach_m);
    for (const Xyz& p : points) EXPECT_TRUE(add(grid, p));
    in_order ? grid->extract(out.get()) : grid->extract_as_they_came(out.get());
    std::vector<std::array<float, 4>> centroids;
    for (std::uint32_t i = 0; i < out->count; ++i) {
      centroids.push_back({out->x[i], out->y[i], out->z[i], out->weight[i]});
    }
    return centroids;
  };
  constexpr std::uint32_t kMuchRoom = 400000;
  test::Placed<VoxelGrid> crowded(kRoom), wide(kMuchRoom);
  for (const bool in_order : {true, false}) {
    const auto here = gridded_in(kRoom, in_order, crowded.get()), there = gridded_in(kMuchRoom, in_order, wide.get());
    ASSERT_EQ(here.size(), kRoom);
    EXPECT_EQ(here, there);
    EXPECT_GT(crowded->crowding(), 3 * kRoom) << "or they do not crowd";
    EXPECT_LT(wide->crowding(), kRoom / 10);
  }
  const auto as_they_came = gridded_in(kRoom, false, crowded.get());
  for (std::uint32_t i = 0; i < kRoom; ++i) {
    for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(as_they_came[i][k], once[i][k], 0.125);
  }
}

}  // namespace
}  // namespace pose_wall
