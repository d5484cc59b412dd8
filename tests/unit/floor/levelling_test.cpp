// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the level frame's heights are heights above the floor plane, and the wall band is cut by them.

#include "engine/floor/levelling.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/math/rotation.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

Axes ahead_is_x() {
  return {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
}

Plane tilted_floor() {
  Plane floor;
  floor.n = Eigen::Vector3d(0.2, -0.3, 1.0).normalized();
  floor.d = 1.4;
  return floor;
}

TEST(Level, HeightAboveTheFloorIsZMinusFloorZ) {
  const Plane floor = tilted_floor();
  const Levelling level = levelling_by(floor, ahead_is_x());
  test::Noise noise(1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d p(noise.normal(5), noise.normal(5), noise.normal(5));
    const double height = (level.R_level_base * p).z() - level.floor_z_level_m;
    EXPECT_NEAR(height, floor.signed_distance(p), 1e-12);
  }
  EXPECT_EQ(level.roll_rad, roll_pitch_of_up(floor.n).roll_rad);
  EXPECT_EQ(level.pitch_rad, roll_pitch_of_up(floor.n).pitch_rad);
}

TEST(Level, TheBandIsCutByHeightAboveTheTiltedFloor) {
  const Settings settings = test::settings_with({{"wall_z_min", "0.5"}, {"wall_z_max", "1.5"}});
  const Plane floor = tilted_floor();
  const Levelling level = levelling_by(floor, ahead_is_x());
  test::OwnedPoints points(4000);
  test::Noise noise(2);
  std::uint32_t inside = 0;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d p(noise.uniform(-9, 9), noise.uniform(-9, 9), noise.uniform(-4, 4));
    points.add(p);
    const double height = floor.signed_distance(p);
    inside += height >= 0.5 && height <= 1.5 ? 1U : 0U;
  }
  test::Placed<VoxelGrid> grid(4000U);
  test::Placed<BoundedPoints> band(4000U), beyond(kBeyondMax);
  cut_wall_band(points.set(), level, settings, grid.get(), band.get(), beyond.get());
  float weight = 0.0F;
  for (std::uint32_t i = 0; i < band->count; ++i) {
    const double height = band->at(i).z() - level.floor_z_level_m;
    ASSERT_GE(height, 0.5 - 1e-4);
    ASSERT_LE(height, 1.5 + 1e-4);
    weight += band->weight[i];
  }
  for (std::uint32_t i = 0; i < beyond->count; ++i) {
    const double height = beyond->at(i).z() - level.floor_z_level_m;
    ASSERT_TRUE(height < 0.5 + 1e-4 || height > 1.5 - 1e-4);
    ASSERT_EQ(beyond->weight[i], 1.0F);
  }
  for (const BoundedPoints* part : {band.get(), beyond.get()}) {
    for (std::uint32_t i = 0; i < part->count; ++i) {
      const std::uint32_t block = i / BoundedPoints::kBlock;
      ASSERT_LE(std::fabs(part->x[i] - part->centre_x[block]), part->half_x[block] + 1e-4F) << "bounded";
    }
  }
  EXPECT_NEAR(3.0 * beyond->count, 4000.0 - static_cast<double>(weight), 3.0) << "one of three outside the band";
  // Floats on the border may fall to either side.
  EXPECT_NEAR(weight, static_cast<float>(inside), 2.0F);
}

// Fours lie partly in the band, each point has its own weight, and what lies behind the last is anything.
TEST(Level, EachOfFourIsCutForItself) {
  for (std::uint32_t n = 1; n <= 9; ++n) {
    test::Placed<PointSet> points(n);
    points->count = n;
    double expected = 0.0;
    for (std::uint32_t i = 0; i < n; ++i) {
      const bool in_band = i % 3 != 1;
      points->set(i, {1.0 + i, 0.0, in_band ? 0.0 : 5.0}, 1.0F + static_cast<float>(i));
      if (in_band) expected += 1.0 + i;
    }
    for (std::uint32_t i = n; i < n + kFour; ++i) {
      points->x[i] = points->y[i] = points->weight[i] = std::nanf("");
      points->z[i] = 0.0F;
    }
    test::Placed<VoxelGrid> grid(n);
    test::Placed<BoundedPoints> band(n), beyond(kBeyondMax);
    Plane floor;
    floor.d = 1.0;
    cut_wall_band(*points, levelling_by(floor, ahead_is_x()), test::settings_with({}), grid.get(), band.get(),
                  beyond.get());
    double weight = 0.0;
    for (std::uint32_t i = 0; i < band->count; ++i) {
      weight += static_cast<double>(band->weight[i]);
      EXPECT_NEAR(band->weight[i], band->x[i], 1e-3F) << "its own weight";
    }
    EXPECT_EQ(weight, expected) << n;
    EXPECT_EQ(band->count, n - (n + 1) / 3) << n;
  }
}

TEST(Level, WeightsPassTheSecondVoxels) {
  test::OwnedPoints points(2);
  points.add(2.0, 2.0, 0.0, 3.0F);
  points.add(2.01, 2.01, 0.01, 5.0F);
  test::Placed<VoxelGrid> grid(2U);
  test::Placed<BoundedPoints> band(2U), beyond(kBeyondMax);
  Plane floor;
  floor.d = 1.0;
  cut_wall_band(points.set(), levelling_by(floor, ahead_is_x()), test::settings_with({{"wall_voxel_leaf", "0.5"}}),
                grid.get(), band.get(), beyond.get());
  EXPECT_EQ(beyond->count, 0U);
  ASSERT_EQ(band->count, 1U);
  EXPECT_EQ(band->weight[0], 8.0F);
  EXPECT_NEAR(band->x[0], 2.00625F, 1e-4F);
}

}  // namespace
}  // namespace pose_wall
