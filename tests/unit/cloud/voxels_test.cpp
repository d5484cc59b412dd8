// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every point of a cloud has exactly one fate and is counted under it, and every return once by its direction;
// the extrinsic and the byte layout are applied; a cloud with more voxels than there is room for gets a larger leaf,
// the same for any order of its points.

#include "engine/cloud/voxels.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

#include "base/math/elementary.hpp"
#include "base/math/rotation.hpp"
#include "support/clouds.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

struct Voxels {
  VoxelResult result;
  std::vector<Eigen::Vector3d> points;
  std::uint64_t print = 0;
  std::uint32_t returns = 0;          // of all directions
  std::vector<std::uint32_t> filled;  // cells of directions, by their number
};

Extrinsic at_origin() {
  return {Eigen::Matrix3d::Identity(), Eigen::Vector3d::Zero()};
}

std::vector<std::uint32_t> filled_cells(const DirectionGrid& grid) {
  std::vector<std::uint32_t> cells;
  for (std::uint32_t row = 0; row < DirectionGrid::kRows; ++row) {
    for (std::uint32_t column = 0; column < DirectionGrid::kColumns; ++column) {
      if (grid.count(row, column) > 0) cells.push_back(row * DirectionGrid::kColumns + column);
    }
  }
  return cells;
}

Voxels voxels_of(const pose_wall_cloud& cloud, const Settings& settings, const Extrinsic& extrinsic = at_origin(),
                 const LeafMemory& last = {}, const Axes& axes = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()}) {
  test::Placed<VoxelGrid> grid(settings.points_max);
  test::Placed<ReturnsByDirection> returns;
  test::Placed<PointSet> out(settings.points_max);
  CloudPrint print;
  Voxels v;
  v.result =
      build_voxels(cloud, nullptr, settings, extrinsic, axes, last, grid.get(), {returns.get(), &print}, out.get());
  v.print = print.whole();
  v.filled = filled_cells(returns->all);
  for (std::uint32_t i = 0; i < out->count; ++i) v.points.push_back(out->at(i));
  for (std::uint32_t row = 0; row < DirectionGrid::kRows; ++row) {
    for (std::uint32_t column = 0; column < DirectionGrid::kColumns; ++column)
      v.returns += returns->all.count(row, column);
  }
  return v;
}

TEST(Voxel, EveryPointIsCountedOnce) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  const test::Points points = {
      {5, 0, 0},         {0, 5, 0},      {-5, 0, 0},     {0, -5, 0}, {5, 0.001F, 0},  // kept
      {kNan, 1, 1},      {1, -kInf, 1},  {1, 1, kInf},                                // not finite
      {0, 0, 0},         {-0.0F, 0, 0},                                               // a no-return
      {0, 0.29F, 0},     {0, -0.1F, 0},  {1e-30F, 0, 0},                              // near
      {0, 0, -4.5e-23F}, {0, 0, 8e-23F},                 // and squares that are hardly floats
      {30.1F, 0, 0},     {1e30F, 0, 0},  {0, 3e38F, 0},  // far
      {2, 2, 2},                                         // in the body box
  };
  const Settings settings = test::settings_with({{"body_box_1", "1.5 2.5 1.5 2.5 1.5 2.5"}});
  const Voxels v = voxels_of(test::cloud_of(points, 0), settings);
  const IngestCounts& c = v.result.counts;
  EXPECT_EQ(c.points_in, points.size());
  EXPECT_EQ(c.kept, 5U);
  EXPECT_EQ(c.dropped_not_finite, 3U);
  EXPECT_EQ(c.dropped_zero + c.dropped_near, 7U);
  EXPECT_EQ(c.dropped_zero, 2U);
  EXPECT_EQ(c.dropped_far, 3U);
  EXPECT_EQ(c.dropped_body, 1U);
  EXPECT_EQ(c.kept_by_quadrant[kAhead], 2U);
  EXPECT_EQ(c.kept_by_quadrant[kLeft], 1U);
  EXPECT_EQ(c.kept_by_quadrant[kBehind], 1U);
  EXPECT_EQ(c.kept_by_quadrant[kRight], 1U);
  EXPECT_EQ(c.near_by_quadrant[kLeft], 1U);
  EXPECT_EQ(c.near_by_quadrant[kRight], 1U);
  EXPECT_EQ(v.returns, c.points_in - c.dropped_not_finite - c.dropped_zero) << "a return, whatever became of it";
}

TEST(Voxel, PointsAreMovedToBase) {
  const Extrinsic extrinsic{rotation_zyx(0.1, -0.2, 2.0), Eigen::Vector3d(1.0, -2.0, 0.5)};
  const Eigen::Vector3d lidar(4.0, 3.0, -1.0);
  const test::Points points = {{4, 3, -1}};
  const Voxels v = voxels_of(test::cloud_of(points, 0), test::settings_with(), extrinsic);
  ASSERT_EQ(v.points.size(), 1U);
  const Eigen::Vector3d expected = extrinsic.R_base_lidar * lidar + extrinsic.sensor_base_m;
  EXPECT_LT((v.points[0] - expected).norm(), 1e-4);  // quantised to 0.05 mm
}

TEST(Voxel, DirectionsAreThoseOfTheSensorHoweverItIsMounted) {
  const Extrinsic extrinsic{rotation_zyx(0.1, -0.2, 2.0), Eigen::Vector3d(1.0, -2.0, 0.5)};
  test::Placed<DirectionGrid> expected;
  expected->clear();
  expected->add(DirectionRows().cell_of(Directions::cell_of({4.0, 3.0, -1.0})), 1);
  const Voxels v = voxels_of(test::cloud_of({{4, 3, -1}}, 0), test::settings_with(), extrinsic);
  EXPECT_EQ(v.returns, 1U);
  EXPECT_EQ(v.filled, filled_cells(*expected));
}

// Ahead, left, behind and right are the machine's, whichever axis of base points ahead and however the sensor hangs;
// and seen from the sensor, wherever it is.
TEST(Voxel, QuadrantsAreTheMachinesWhateverItsAxes) {
  const Extrinsic mounts[] = {at_origin(),
                              {rotation_zyx(0.3, -0.2, 2.0), Eigen::Vector3d(1.0, -2.0, 0.5)},
                              {rotation_zyx(kPi, 0.1, -0.7), Eigen::Vector3d(-0.5, 0.3, 1.0)}};
  for (const char* forward : {"+X", "-X", "+Y", "-Y"}) {
    const Eigen::Vector3d along = forward[1] == 'X' ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
    const Eigen::Vector3d ahead = forward[0] == '+' ? along : Eigen::Vector3d(-along);
    const Axes axes{ahead, Eigen::Vector3d::UnitZ().cross(ahead)};
    for (const Extrinsic& mount : mounts) {
      test::Noise noise(7);
      test::Points points;
      std::uint32_t kept[kQuadrants] = {}, near[kQuadrants] = {};
      while (points.size() < 2000) {
        const std::array<float, 3> p = {static_cast<float>(noise.uniform(-9.0, 9.0)),
                                        static_cast<float>(noise.uniform(-9.0, 9.0)),
                                        static_cast<float>(noise.uniform(-3.0, 3.0))};
        const Eigen::Vector3d ray = Eigen::Vector3f(p[0], p[1], p[2]).cast<double>();
        const Eigen::Vector3d ray_base = mount.R_base_lidar * ray;
        const double to_front = ray_base.dot(axes.forward_base), to_left = ray_base.dot(axes.left_base);
        const bool on_a_border = std::fabs(std::fabs(to_front) - std::fabs(to_left)) < 1e-4;
        if (on_a_border || std::fabs(ray.norm() - 4.0) < 1e-4) continue;
        const std::uint32_t along_it = to_front > 0.0 ? kAhead : kBehind, across_it = to_left > 0.0 ? kLeft : kRight;
        const std::uint32_t quadrant = std::fabs(to_left) > std::fabs(to_front) ? across_it : along_it;
        ++(ray.norm() < 4.0 ? near : kept)[quadrant];
        points.push_back({p[0], p[1], p[2]});
      }
      const Settings settings = test::settings_with({{"range_min", "4"}, {"forward_axis", forward}});
      const Voxels v = voxels_of(test::cloud_of(points, 0), settings, mount, {}, axes);
      for (std::uint32_t q = 0; q < kQuadrants; ++q) {
        EXPECT_EQ(v.result.counts.kept_by_quadrant[q], kept[q]) << forward << " " << q;
        EXPECT_EQ(v.result.counts.near_by_quadrant[q], near[q]) << forward << " " << q;
        EXPECT_GT(kept[q], 100U) << forward << " " << q;
        EXPECT_GT(near[q], 20U) << forward << " " << q;
      }
    }
  }
}

TEST(Voxel, RangeIsFromTheSensorAndBoxesAreInBase) {
  const Extrinsic far_away{Eigen::Matrix3d::Identity(), Eigen::Vector3d(15.0, 0.0, 0.0)};
  const test::Points points = {{0.2F, 0, 0}, {29, 0, 0}, {-14, 0, 0}};
  const Settings settings = test::settings_with({{"body_box_1", "0.5 1.5 -1 1 -1 1"}});
  const IngestCounts c = voxels_of(test::cloud_of(points, 0), settings, far_away).result.counts;
  EXPECT_EQ(c.dropped_near, 1U);
  EXPECT_EQ(c.kept, 1U);
  EXPECT_EQ(c.dropped_body, 1U);  // at 1 m in base
}

// Evenly over a box around the origin, by half its sides.
test::Points scattered(std::uint32_t seed, int count, double along_m, double up_m) {
  test::Noise noise(seed);
  test::Points points;
  for (int i = 0; i < count; ++i) {
    const double x = noise.uniform(-along_m, along_m), y = noise.uniform(-along_m, along_m);
    points.push_back({static_cast<float>(x), static_cast<float>(y), static_cast<float>(noise.uniform(-up_m, up_m))});
  }
  return points;
}

TEST(Voxel, AnyLayoutGivesTheSameVoxels) {
  const test::Points points = scattered(1, 3000, 9, 2);
  const Voxels expected = voxels_of(test::cloud_of(points, 0), test::settings_with());
  for (const bool float64 : {false, true}) {
    for (const bool big_endian : {false, true}) {
      for (const std::uint32_t offset : {0U, 5U, 18U}) {
        // With four bytes behind z four floats of a point are read at once, four points at a time: rows end within one.
        for (const std::uint32_t extra : {0U, 3U, 4U}) {
          const test::EncodedCloud e = test::encode(points, {float64, big_endian, offset, 0, extra, 40, 7}, 0);
          ASSERT_NE(e.cloud.width % kFour, 0U);
          const Voxels voxels = voxels_of(e.cloud, test::settings_with());
          EXPECT_EQ(voxels.print, expected.print) << offset << " " << extra;
          EXPECT_EQ(voxels.points, expected.points) << offset << " " << extra;
        }
      }
    }
  }
}

// The leaf that a cloud settles at when it comes again and again.
LeafMemory settled_for(const test::Points& points, const Settings& settings) {
  LeafMemory leaf;
  for (int cloud = 0; cloud < 5; ++cloud) {
    leaf = voxels_of(test::cloud_of(points, 0), settings, at_origin(), leaf).result.leaf;
  }
  return leaf;
}

TEST(Voxel, TooManyVoxelsGrowTheLeafWhateverTheOrder) {
  test::Points points = scattered(2, 40000, 3, 1);
  const Settings settings = test::settings_with({{"points_max", "5000"}});
  const Voxels first = voxels_of(test::cloud_of(points, 0), settings);
  EXPECT_TRUE(first.result.fits);
  EXPECT_GT(first.result.leaf_m, settings.voxel_leaf);
  EXPECT_LE(first.points.size(), 5000U);
  const LeafMemory settled = settled_for(points, settings);
  EXPECT_GT(voxels_of(test::cloud_of(points, 0), settings, at_origin(), settled).points.size(), 2000U)
      << "grown further than needed";
  EXPECT_EQ(first.result.counts.points_in, 40000U) << "each point is counted once, however many passes there are";
  EXPECT_EQ(first.returns, 40000U);
  test::shuffle(&points, 1);
  const Voxels second = voxels_of(test::cloud_of(points, 0), settings);
  EXPECT_EQ(second.points, first.points);
  EXPECT_EQ(second.result.leaf_m, first.result.leaf_m);
}

TEST(Voxel, WhatTheLastCloudNeededIsTriedFirstAndGivesTheSame) {
  const test::Points points = scattered(2, 40000, 3, 1);
  const Settings settings = test::settings_with({{"points_max", "5000"}});
  const LeafMemory settled = settled_for(points, settings);
  const Voxels first = voxels_of(test::cloud_of(points, 0), settings, at_origin(), settled);
  const Voxels second = voxels_of(test::cloud_of(points, 0), settings, at_origin(), first.result.leaf);
  EXPECT_EQ(second.result.leaf_m, first.result.leaf_m);
  EXPECT_EQ(second.points, first.points);
  EXPECT_GT(second.result.leaf_m, settings.voxel_leaf);
  EXPECT_EQ(second.result.counts.points_in, 40000U);
  EXPECT_EQ(second.returns, 40000U);
  // Where there is much less, the leaf is what it would have been, by the second cloud at the latest.
  const test::Points few = scattered(3, 600, 3, 1);
  const Voxels between = voxels_of(test::cloud_of(few, 0), settings, at_origin(), first.result.leaf);
  EXPECT_LT(between.result.leaf_m, first.result.leaf_m);
  const Voxels after = voxels_of(test::cloud_of(few, 0), settings, at_origin(), between.result.leaf);
  EXPECT_EQ(after.result.leaf_m, settings.voxel_leaf);
}

// Large voxels of points that fill the air would lie in layers, each like a floor.
TEST(Voxel, WherePointsFillTheAirThereAreNoVoxels) {
  const test::Points points = scattered(3, 40000, 20, 2.5);
  const Settings settings = test::settings_with({{"points_max", "5000"}});
  const Voxels v = voxels_of(test::cloud_of(points, 0), settings);
  EXPECT_FALSE(v.result.fits);
  EXPECT_GT(v.result.leaf_m, settings.voxel_leaf);
  EXPECT_TRUE(v.points.empty());
  EXPECT_LE(v.result.leaf_m, 0.26);
  EXPECT_EQ(v.result.counts.points_in, 40000U);
}

TEST(Voxel, AnEmptyCloudHasNoVoxels) {
  const Settings settings = test::settings_with();
  const Voxels v = voxels_of(test::cloud_of({}, 0), settings);
  EXPECT_TRUE(v.points.empty());
  EXPECT_EQ(v.result.counts.points_in, 0U);
  EXPECT_EQ(v.returns, 0U);
  EXPECT_LE(v.result.leaf_m, settings.voxel_leaf);
}

// Brightness shifts a centroid and nothing else: no point goes for being dark.
TEST(Voxel, IntensityWeighsButNeverDrops) {
  struct Point {
    float x, y, z, intensity;
  };
  const Point points[] = {
      {0.51F, 0.52F, 0.52F, 1000.0F}, {0.511F, 0.52F, 0.52F, 0.0F}, {3, 3, 1, -5.0F}, {4, 4, 1, std::nanf("")}};
  pose_wall_cloud cloud;
  pose_wall_cloud_xyz32(&cloud, points, 4, sizeof(Point), 0);
  cloud.intensity = {12, POSE_WALL_FIELD_FLOAT32};
  const Voxels plain = voxels_of(cloud, test::settings_with());
  const Voxels weighted = voxels_of(cloud, test::settings_with({{"intensity_weight", "1.0"}}));
  ASSERT_EQ(plain.points.size(), 3U);
  ASSERT_EQ(weighted.points.size(), 3U);
  EXPECT_NEAR(plain.points[0].x(), 0.5105, 1e-4);
  EXPECT_LT(weighted.points[0].x(), 0.5103);
}

}  // namespace
}  // namespace pose_wall
