// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: points of a slab, or of two, are visited once, in their order, whatever their number and wherever the blocks
// they lie in, with their distances, no further than the visitor wants, and none from behind the last one; and blocks
// that lie elsewhere are passed over.

#include "base/estimation/near_plane.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
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
    for_each_in(points.set(), Slab(plane, kAnyDepth_m, 0.3), [&](std::uint32_t i, float distance_m) {
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
    BoundedPoints& set = points.set();
    for (std::uint32_t i = 0; i < 8 + kFour; ++i) set.set(i, Eigen::Vector3d(0.1 * i, 2.0, 0.0), 1.0F);
    set.count = count;
    set.bound();
    std::uint32_t visited = 0;
    for_each_in(set, Slab(plane, 0.1), [&](std::uint32_t i, float) { EXPECT_EQ(i, visited++); });
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
  for_each_in(points.set(), Slab({Eigen::Vector3d::UnitZ(), 0.0}, kAnyDepth_m, 0.5), [&](std::uint32_t i, float) {
    EXPECT_EQ(i, 0U);
    ++visits;
  });
  EXPECT_EQ(visits, 1);
}

TEST(NearPlane, VisitsASlabWithItsLimits) {
  test::OwnedPoints points(8);
  for (const double z : {-0.3, -0.25, 0.0, 0.5, 0.51, 0.1}) points.add(1, 2, z);
  std::vector<std::uint32_t> visited;
  for_each_in(points.set(), Slab({Eigen::Vector3d::UnitZ(), 0.0}, -0.25, 0.5),
              [&](std::uint32_t i, float) { visited.push_back(i); });
  EXPECT_EQ(visited, (std::vector<std::uint32_t>{1, 2, 3, 5}));
}

// Clusters of all sizes, some of them a plane's own: each block has a box of its own.
test::OwnedPoints clusters(std::uint32_t count, test::Noise* noise) {
  test::OwnedPoints points(count);
  while (points.all().size() < count) {
    const Eigen::Vector3d middle(noise->uniform(-30, 30), noise->uniform(-4, 4), noise->uniform(-2, 2));
    const double size_m = std::pow(10.0, noise->uniform(-3, 0.7));
    for (int k = 0; k < 50 && points.all().size() < count; ++k) {
      points.add(middle + size_m * Eigen::Vector3d(noise->normal(1), noise->normal(1), noise->normal(0.3)));
    }
  }
  return points;
}

TEST(NearPlane, BlocksHideNoPoint) {
  test::Noise noise(5);
  for (int draw = 0; draw < 300; ++draw) {
    test::OwnedPoints points = clusters(static_cast<std::uint32_t>(noise.uniform(1, 700)), &noise);
    const BoundedPoints& set = points.set();
    const auto any_slab = [&] {
      const Eigen::Vector3d n(noise.normal(1), noise.normal(1), noise.normal(1));
      const double from_m = noise.uniform(-3, 3);
      return Slab({n.normalized(), noise.uniform(-5, 5)}, draw % 3 == 0 ? kAnyDepth_m : from_m, from_m + 0.4);
    };
    const Slab slab = any_slab(), other = any_slab();
    std::vector<std::uint32_t> in_slab, in_both, visited, visited_both;
    for_each_four_points(set, [&](std::uint32_t i, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
      const FourTruths held = counts & slab.holds(x, y, z), both = held & other.holds(x, y, z);
      for (std::uint32_t lane = 0; lane < kFour; ++lane) {
        if (held[lane] != 0) in_slab.push_back(i + lane);
        if (both[lane] != 0) in_both.push_back(i + lane);
      }
    });
    for_each_in(set, slab, [&](std::uint32_t i, float) { visited.push_back(i); });
    for_each_in_both(set, slab, other, [&](std::uint32_t i) { visited_both.push_back(i); });
    EXPECT_EQ(visited, in_slab) << draw;
    EXPECT_EQ(visited_both, in_both) << draw;
  }
}

// Rows of boxes are read four at a time: what lies behind the last is of another frame.
TEST(NearPlane, BlocksBehindTheLastDoNotCount) {
  for (const float left : {0.0F, std::nanf(""), 1e30F}) {
    for (std::uint32_t count = 1; count < 5 * BoundedPoints::kBlock; count += 13) {
      test::OwnedPoints points(6 * BoundedPoints::kBlock);
      for (std::uint32_t i = 0; i < count; ++i) points.add(1.0, 2.0, 0.0);
      BoundedPoints& set = points.set();
      for (Span<float>* row : {&set.centre_x, &set.centre_y, &set.centre_z, &set.half_x, &set.half_y, &set.half_z}) {
        for (std::uint32_t block = set.blocks(); block < row->size(); ++block) (*row)[block] = left;
      }
      std::uint32_t visited = 0;
      for_each_in(set, Slab({Eigen::Vector3d::UnitX(), -1.0}, 0.1), [&](std::uint32_t, float) { ++visited; });
      EXPECT_EQ(visited, count);
    }
  }
}

TEST(NearPlane, BlocksElsewhereArePassedOver) {
  test::OwnedPoints points(20 * BoundedPoints::kBlock);
  for (std::uint32_t i = 0; i < 20 * BoundedPoints::kBlock; ++i) points.add(i / BoundedPoints::kBlock, 0.1, 0.2);
  const Slab slab({Eigen::Vector3d::UnitX(), 0.0}, 6.5, 9.5);
  std::uint32_t begin = 0, end = 0;
  std::vector<std::uint32_t> begins;
  for (BlocksIn blocks(points.set(), slab); blocks.next(&begin, &end);) {
    EXPECT_EQ(end, begin + BoundedPoints::kBlock);
    begins.push_back(begin / BoundedPoints::kBlock);
  }
  EXPECT_EQ(begins, (std::vector<std::uint32_t>{7, 8, 9}));
}

TEST(NearPlane, WhoHasSeenEnoughIsShownNoMore) {
  test::OwnedPoints points(40);
  for (int i = 0; i < 37; ++i) points.add(i, 0, i % 3 == 0 ? 9.0 : 0.0);
  for (std::size_t enough = 1; enough <= 24; ++enough) {
    std::vector<std::uint32_t> visited;
    for_each_in_while(points.set(), Slab({Eigen::Vector3d::UnitZ(), 0.0}, kAnyDepth_m, 0.5),
                      [&](std::uint32_t i, float) {
                        visited.push_back(i);
                        return visited.size() < enough;
                      });
    ASSERT_EQ(visited.size(), enough);
    EXPECT_EQ(visited.back(), (enough - 1) / 2 * 3 + (enough - 1) % 2 + 1);
  }
}

}  // namespace
}  // namespace pose_wall
