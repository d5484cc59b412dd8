// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a crossing lies on the plane and on its ray, and a column that is said to look away has none.

#include "engine/walls/doubts/sight_lines.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/math/rotation.hpp"
#include "support/band_fixture.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kLineRows = DirectionGrid::kRows, kLineColumns = DirectionGrid::kColumns;

// A wall to the left that leans, seen by a lidar that is turned in any way.
struct Look {
  explicit Look(test::Noise* noise) {
    band.mount_lidar(rotation_zyx(noise->uniform(-0.5, 0.5), noise->uniform(-0.4, 0.4), noise->uniform(-3.1, 3.1)));
    wall.n = Eigen::Vector3d(noise->uniform(-0.2, 0.2), -1.0, noise->uniform(-0.2, 0.2)).normalized();
    wall.d = noise->uniform(0.5, 6.0);
    along_level = along_of(wall, Eigen::Vector3d::UnitX());
  }
  test::BandFixture band;
  Plane wall;
  Eigen::Vector3d along_level;
};

Eigen::Vector3d ray_level(const WallScene& scene, std::uint32_t row, std::uint32_t column) {
  const double up = scene.returns_lidar.rows.up(row), flat = std::sqrt(1.0 - up * up);
  const Directions::Column c = Directions::column(column);
  return scene.extrinsic.R_base_lidar * Eigen::Vector3d(c.x * flat, c.y * flat, up);
}

TEST(SightLines, ACrossingLiesOnThePlaneAndOnItsRay) {
  test::Noise noise(1);
  std::uint32_t near = 0;
  for (int draw = 0; draw < 5; ++draw) {
    Look look(&noise);
    const WallScene scene = look.band.scene();
    const SightLines lines(scene, look.wall, look.along_level);
    for (std::uint32_t row = 0; row < kLineRows; ++row) {
      for (std::uint32_t column = 0; column < kLineColumns; ++column) {
        const SightLines::Crossing c = lines.at(row, column);
        if (!c.near) continue;
        ++near;
        const Eigen::Vector3d ray = ray_level(scene, row, column);
        const double range_m = -look.wall.signed_distance(scene.sensor_level_m) / look.wall.n.dot(ray);
        ASSERT_GT(range_m, 0.0);
        ASSERT_LE(range_m, SightLines::kReach_m + 1e-9);
        const Eigen::Vector3d place = scene.sensor_level_m + range_m * ray;
        ASSERT_NEAR(c.z_level_m, place.z(), 1e-9);
        ASSERT_NEAR(c.along_m, look.along_level.dot(place - scene.sensor_level_m), 1e-9);
      }
    }
  }
  EXPECT_GT(near, kLineRows * kLineColumns / 2);
}

TEST(SightLines, AColumnThatLooksAwayHasNoCrossing) {
  test::Noise noise(2);
  std::uint32_t away = 0;
  constexpr std::uint32_t kLooks = 20;
  for (std::uint32_t draw = 0; draw < kLooks; ++draw) {
    Look look(&noise);
    const WallScene scene = look.band.scene();
    const SightLines lines(scene, look.wall, look.along_level);
    for (std::uint32_t column = 0; column < kLineColumns; ++column) {
      if (lines.looks_towards(column)) continue;
      ++away;
      for (std::uint32_t row = 0; row < kLineRows; ++row) ASSERT_FALSE(lines.at(row, column).near) << row;
    }
  }
  EXPECT_GT(away, kLooks * kLineColumns / 8) << "or nothing was tested";
}

}  // namespace
}  // namespace pose_wall
