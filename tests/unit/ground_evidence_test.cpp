// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: open ground is told from walls and heaps, its area is measured in plan, and a reflection is recognised by the
// rays that pass through the floor above it.

#include "stages/ground_evidence.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/ground_fixture.hpp"

namespace pose_wall {
namespace {

const Axes kAhead_x{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};

struct Open {
  explicit Open(test::GroundFixture* g) : indices(g->points().set().capacity()) {
    count = grid->find_open(g->points().set(), 15.0, 0.0,
                            Span<std::uint32_t>(indices.data(), static_cast<std::uint32_t>(indices.size())));
  }
  Span<const std::uint32_t> span() const { return Span<const std::uint32_t>(indices.data(), count); }
  test::Placed<FloorGrid> grid;
  std::vector<std::uint32_t> indices;
  std::uint32_t count = 0;
};

Plane level_at(double height_above_floor) {
  Plane p;
  p.d = test::kFloorBelow_m - height_above_floor;
  return p;
}

TEST(FloorGrid, FloorIsOpenAndWallsAreNot) {
  test::GroundFixture g;
  g.add_level({-6, 6, -2.0, 2.0}, 0.0);
  const std::uint32_t floor_points = g.points().set().count;
  g.add_wall(2.5);
  Open open(&g);
  std::uint32_t of_floor = 0;
  for (const std::uint32_t i : open.span()) of_floor += i < floor_points ? 1U : 0U;
  EXPECT_GT(of_floor, 0.95 * floor_points);
  EXPECT_LT(open.count - of_floor, 0.1 * (g.points().set().count - floor_points));
}

TEST(FloorGrid, AreaIsMeasuredInPlan) {
  test::GroundFixture g;
  g.add_level({-3, 3, -2.0, 2.0}, 0.0);
  Open open(&g);
  open.grid->mark(g.points().set(), open.span(), level_at(0.0), 0.03);
  const FloorEvidence e = open.grid->evidence(kAhead_x);
  EXPECT_NEAR(e.area_m2, 24.0, 3.0);  // a cell of a quarter of a metre more on each edge
  EXPECT_GE(e.score_m2, e.area_m2);
  EXPECT_NEAR(e.across_spread_m, 4.0 / std::sqrt(12.0), 0.1);
  EXPECT_TRUE(open.grid->marked_near(1.0, 1.0));
  EXPECT_FALSE(open.grid->marked_near(10.0, 1.0));
  EXPECT_FALSE(open.grid->marked_near(1e6, -1e6));
  open.grid->mark(g.points().set(), open.span(), level_at(0.5), 0.03);
  EXPECT_EQ(open.grid->evidence(kAhead_x).area_m2, 0.0);
}

bool more_is_below(test::GroundFixture* g, double height_above_floor, double share) {
  Open open(g);
  const Plane plane = level_at(height_above_floor);
  open.grid->mark(g->points().set(), open.span(), plane, 0.03);
  return has_much_below(*open.grid, plane, g->points().set(), 15.0, Eigen::Vector3d::Zero(), share);
}

TEST(FloorGrid, WhatLiesBelowAPlaneSpeaksAgainstItUnlessItIsAReflection) {
  test::GroundFixture floor;
  floor.add_level({-3, 3, -2.0, 2.0}, 0.0);
  EXPECT_FALSE(more_is_below(&floor, 0.0, 0.0));
  EXPECT_TRUE(more_is_below(&floor, 1.0, 0.99)) << "a plane without points of its own";
  EXPECT_FALSE(more_is_below(&floor, 1.0, 1.0)) << "there is no more than all";
  test::GroundFixture deck;  // beside floor that is seen past its edge
  deck.add_level({-1, 1, -2.0, 2.0}, 0.8);
  deck.add_level({-8, -2, -2.0, 2.0}, 0.0);
  deck.add_level({2, 8, -2.0, 2.0}, 0.0);
  EXPECT_TRUE(more_is_below(&deck, 0.8, 0.5));
  test::GroundFixture wet;
  wet.add_level({-6, 6, -2.0, 2.0}, 0.0, 0.005, 0.15);
  wet.add_level({-4, 4, -1.5, 1.5}, -1.0, 0.005, 0.15);
  EXPECT_FALSE(more_is_below(&wet, 0.0, 0.05));
  test::GroundFixture none;
  EXPECT_FALSE(more_is_below(&none, 0.0, 0.0));
}

TEST(FloorGrid, AReflectionIsSeenThroughTheFloor) {
  test::GroundFixture g;
  g.add_level({-6, 6, -2.0, 2.0}, 0.0, 0.005, 0.15);
  g.add_level({-4, 4, -1.5, 1.5}, -1.0, 0.005, 0.15);
  Open open(&g);
  open.grid->mark(g.points().set(), open.span(), level_at(0.0), 0.03);
  const Eigen::Vector3d sensor = Eigen::Vector3d::Zero();
  EXPECT_GT(share_seen_through(*open.grid, level_at(0.0), level_at(-1.0), g.points().set(), open.span(), sensor, 0.03),
            0.9);
  // And the floor is not seen through the reflection.
  open.grid->mark(g.points().set(), open.span(), level_at(-1.0), 0.03);
  EXPECT_LT(share_seen_through(*open.grid, level_at(-1.0), level_at(0.0), g.points().set(), open.span(), sensor, 0.03),
            0.1);
}

TEST(FloorGrid, PointsFarOutsideAndOddHeightsDoNoHarm) {
  test::GroundFixture g;
  for (const double far : {-450.0, -20.5, 20.5, 450.0}) {
    g.add(far, 0.0, 0.0);
    g.add(0.0, far, 0.0);
    g.add(0.0, 0.0, far);
  }
  Open open(&g);
  open.grid->mark(g.points().set(), open.span(), level_at(0.0), 0.03);
  EXPECT_LE(open.grid->evidence(kAhead_x).area_m2, 1.0);
}

}  // namespace
}  // namespace pose_wall
