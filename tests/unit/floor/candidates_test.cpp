// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: hypotheses for the floor lie below the sensor by an allowed height and tilt, lead with the floor, differ from
// each other and are bounded in number.

#include "engine/floor/candidates.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/floor_fixture.hpp"

namespace pose_wall {
namespace {

Plane at(double height, double tilt = 0.0) {
  return Plane{Eigen::Vector3d(std::sin(tilt), 0.0, std::cos(tilt)), height};
}

TEST(FloorSearch, WhatMayBeAFloor) {
  const Settings s =
      test::settings_with({{"ground_height_min", "0.5"}, {"ground_height_max", "3.0"}, {"ground_tilt_max_deg", "30"}});
  const FloorLimits limits(s);
  const Eigen::Vector3d sensor(0, 0, 0.2);
  EXPECT_TRUE(may_be_floor(at(1.4), limits, sensor));
  EXPECT_TRUE(may_be_floor(at(0.31), limits, sensor)) << "the sensor's height counts, not the origin's";
  EXPECT_FALSE(may_be_floor(at(0.29), limits, sensor));
  EXPECT_FALSE(may_be_floor(at(2.9), limits, sensor));
  EXPECT_FALSE(may_be_floor(at(-1.4), limits, sensor));
  EXPECT_TRUE(may_be_floor(at(1.4, 0.5), limits, sensor));
  EXPECT_FALSE(may_be_floor(at(1.4, 0.55), limits, sensor));
  EXPECT_FALSE(may_be_floor(at(1.4).flipped(), limits, sensor));
  EXPECT_FALSE(may_be_floor(at(std::nan("")), limits, sensor));
  EXPECT_FALSE(may_be_floor(at(1.4, std::nan("")), limits, sensor));
}

TEST(FloorSearch, SameFloorIsLocal) {
  EXPECT_TRUE(same_floor(at(1.4), at(1.45)));
  EXPECT_FALSE(same_floor(at(1.4), at(1.5)));
  EXPECT_FALSE(same_floor(at(1.4), at(1.4, 0.1))) << "0.2 m apart at 2 m";
  EXPECT_EQ(same_floor(at(1.4), at(1.4, 0.02)), same_floor(at(1.4, 0.02), at(1.4)));
}

TEST(FloorSearch, TheFloorLeadsAndTheWorkIsBounded) {
  test::FloorFixture g({{"ground_iterations", "100"}});
  g.add_road();
  test::Placed<PointSet> subset(kSubsetPoints);
  FloorShortlist list;
  Random random(1);
  std::vector<std::uint32_t> low;
  for (std::uint32_t i = 0; i < g.points().set().count; ++i) {
    if (g.points().set().z[i] < -1.0F) low.push_back(i);
  }
  const FloorDraw in{g.points().set(), Span<const std::uint32_t>(low.data(), static_cast<std::uint32_t>(low.size()))};
  const std::uint32_t scored = search_floor(g.scene(), in, &random, subset.get(), &list);
  EXPECT_LE(scored, 100U);
  ASSERT_GT(list.count(), 0U);
  EXPECT_NEAR(list[0].plane.d, test::kFloorBelow_m, 0.05);
  for (std::uint32_t i = 1; i < list.count(); ++i) {
    EXPECT_GE(list[i].cost, list[i - 1].cost);
    for (std::uint32_t j = 0; j < i; ++j) EXPECT_FALSE(same_floor(list[i].plane, list[j].plane));
  }
}

TEST(FloorSearch, TooFewLowPointsGiveNothing) {
  test::FloorFixture g;
  g.add_road();
  test::Placed<PointSet> subset(kSubsetPoints);
  FloorShortlist list;
  Random random(1);
  const FloorDraw in{g.points().set(), {}};
  EXPECT_EQ(search_floor(g.scene(), in, &random, subset.get(), &list), 0U);
  EXPECT_EQ(list.count(), 0U);
}

}  // namespace
}  // namespace pose_wall
