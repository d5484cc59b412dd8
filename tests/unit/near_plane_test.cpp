// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: points up to a distance or within a slab are visited once, in their order, whatever their number, with their
// distances, no further than the visitor wants, and none from behind the last one.

#include "estimation/near_plane.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <vector>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

TEST(NearPlane, VisitsWhatLiesOnAPlaneOrBehindIt) {
  const Plane plane{Eigen::Vector3d(0.1, -0.99, 0.05).normalized(), 2.5};
  for (const std::uint32_t count : {0U, 1U, 2U, 3U, 4U, 5U, 7U, 8U, 500U}) {
    test::OwnedPoints points(count + 1);
    test::Noise noise(count + 1);
    for (std::uint32_t i = 0; i < count; ++i) {
      points.add(noise.uniform(-9, 9), noise.uniform(-9, 9), noise.uniform(-2, 2));
    }
    std::vector<std::uint32_t> expected, visited;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (plane.signed_distance(points.set().at(i)) <= 0.3) expected.push_back(i);
    }
    for_each_up_to(points.set(), plane, 0.3, [&](std::uint32_t i, float distance_m) {
      visited.push_back(i);
      EXPECT_NEAR(distance_m, plane.signed_distance(points.set().at(i)), 1e-5);
    });
    EXPECT_EQ(visited, expected) << count;
  }
}

// Rows go on behind the last point, and what lies there may lie on the plane as well.
TEST(NearPlane, WhatLiesBehindTheLastPointIsNotVisited) {
  const Plane plane{Eigen::Vector3d(0.0, -1.0, 0.0), 2.0};
  for (std::uint32_t count = 0; count < 9; ++count) {
    test::OwnedPoints points(8);
    PointSet& set = points.set();
    for (std::uint32_t i = 0; i < 8 + kFour; ++i) set.set(i, Eigen::Vector3d(0.1 * i, 2.0, 0.0), 1.0F);
    set.count = count;
    std::uint32_t visited = 0;
    for_each_between(set, plane, -0.1, 0.1, [&](std::uint32_t i, float) { EXPECT_EQ(i, visited++); });
    EXPECT_EQ(visited, count);
  }
}

TEST(NearPlane, ASlabHoldsBothSidesAndAnEmptyOneNothing) {
  const Plane plane{Eigen::Vector3d(0.0, -1.0, 0.0), 2.0};
  const FourFloats x{}, y{1.5F, 1.75F, 2.25F, 2.5F}, z{};
  const FourTruths held = Slab(plane, 0.25).holds(x, y, z), nothing = Slab::empty().holds(x, y, z);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    EXPECT_EQ(held[lane] != 0, lane == 1 || lane == 2) << lane;
    EXPECT_EQ(nothing[lane], 0) << lane;
  }
}

TEST(NearPlane, TheLimitItselfIsWithin) {
  test::OwnedPoints points(2);
  points.add(0, 0, 0.5);
  points.add(0, 0, 0.75);
  int visits = 0;
  for_each_up_to(points.set(), Plane{Eigen::Vector3d::UnitZ(), 0.0}, 0.5, [&](std::uint32_t i, float) {
    EXPECT_EQ(i, 0U);
    ++visits;
  });
  EXPECT_EQ(visits, 1);
}

TEST(NearPlane, VisitsASlabWithItsLimits) {
  test::OwnedPoints points(8);
  for (const double z : {-0.3, -0.25, 0.0, 0.5, 0.51, 0.1}) points.add(1, 2, z);
  std::vector<std::uint32_t> visited;
  for_each_between(points.set(), Plane{Eigen::Vector3d::UnitZ(), 0.0}, -0.25, 0.5,
                   [&](std::uint32_t i, float) { visited.push_back(i); });
  EXPECT_EQ(visited, (std::vector<std::uint32_t>{1, 2, 3, 5}));
}

TEST(NearPlane, WhoHasSeenEnoughIsShownNoMore) {
  test::OwnedPoints points(40);
  for (int i = 0; i < 37; ++i) points.add(i, 0, i % 3 == 0 ? 9.0 : 0.0);
  for (std::size_t enough = 1; enough <= 24; ++enough) {
    std::vector<std::uint32_t> visited;
    for_each_up_to_while(points.set(), Plane{Eigen::Vector3d::UnitZ(), 0.0}, 0.5, [&](std::uint32_t i, float) {
      visited.push_back(i);
      return visited.size() < enough;
    });
    ASSERT_EQ(visited.size(), enough);
    EXPECT_EQ(visited.back(), (enough - 1) / 2 * 3 + (enough - 1) % 2 + 1);
  }
}

}  // namespace
}  // namespace pose_wall
