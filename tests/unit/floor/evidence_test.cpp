// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: open ground is told from walls and heaps, its area is measured in plan, and a reflection is recognised by the
// rays that pass through the floor above it.

#include "engine/floor/evidence.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "support/floor_fixture.hpp"

namespace pose_wall {
namespace {

const Axes kAhead_x{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};

struct Open {
  explicit Open(test::FloorFixture* g) : points(g->points().set().capacity()) {
    std::vector<std::uint32_t> places(g->points().set().capacity() + kFour);
    const auto count = static_cast<std::uint32_t>(places.size());
    grid->find_open(g->points().set(), 15.0, 0.0, Span<std::uint32_t>(places.data(), count), points.get());
  }
  const PointSet& set() const { return *points; }
  const FloorGrid& grid_of() const { return *grid; }
  mutable test::Placed<FloorGrid> grid;
  mutable test::Placed<PointSet> points;
};

Plane level_at(double height_above_floor) {
  Plane p;
  p.d = test::kFloorBelow_m - height_above_floor;
  return p;
}

TEST(FloorGrid, FloorIsOpenAndWallsAreNot) {
  test::FloorFixture g;
  g.add_level({-6, 6, -2.0, 2.0}, 0.0);
  const std::uint32_t floor_points = g.points().set().count;
  g.add_wall(2.5);
  Open open(&g);
  // In their order, whole: what is left out is skipped.
  const PointSet &all = g.points().set(), &left = open.set();
  std::uint32_t of_floor = 0, i = 0;
  for (std::uint32_t k = 0; k < left.count; ++k, ++i) {
    while (i < all.count && (all.x[i] != left.x[k] || all.y[i] != left.y[k] || all.z[i] != left.z[k])) ++i;
    ASSERT_LT(i, all.count) << "no point of the cloud";
    EXPECT_EQ(left.weight[k], all.weight[i]);
    of_floor += i < floor_points ? 1U : 0U;
  }
  EXPECT_GT(of_floor, 0.95 * floor_points);
  EXPECT_LT(left.count - of_floor, 0.1 * (all.count - floor_points));
}

TEST(FloorGrid, AreaIsMeasuredInPlan) {
  test::FloorFixture g;
  g.add_level({-3, 3, -2.0, 2.0}, 0.0);
  Open open(&g);
  open.grid->mark(open.set(), level_at(0.0), 0.03);
  const FloorEvidence e = open.grid->evidence(kAhead_x);
  EXPECT_NEAR(e.area_m2, 24.0, 3.0);  // a cell of a quarter of a metre more on each edge
  EXPECT_GE(e.score_m2, e.area_m2);
  EXPECT_TRUE(open.grid->marked_near(1.0, 1.0));
  EXPECT_FALSE(open.grid->marked_near(10.0, 1.0));
  EXPECT_FALSE(open.grid->marked_near(1e6, -1e6));
  open.grid->mark(open.set(), level_at(0.5), 0.03);
  EXPECT_EQ(open.grid->evidence(kAhead_x).area_m2, 0.0);
}

bool much_is_below(test::FloorFixture* g, double height_above_floor, double share_max = 0.4) {
  Open open(g);
  const Plane plane = level_at(height_above_floor);
  open.grid->mark(open.set(), plane, 0.03);
  return open.grid->much_lies_below(plane, g->points().set(), 15.0, Eigen::Vector3d::Zero(), share_max);
}

// Two planes that cross in the middle: the threshold apart from a third of a metre on.
TEST(FloorGrid, GroundThatAnotherPlaneHasAsWellIsNotMarkedApart) {
  constexpr double kSlope = 0.1, kThresh_m = 0.03;  // 0.3 m from the line they are a threshold apart
  test::FloorFixture g;
  for (double x = -4.0; x <= 4.0; x += 0.05) {
    for (double y = -2.0; y <= 2.0; y += 0.05) g.add(x, y, kSlope * x);
  }
  const Open open(&g);
  const Eigen::Vector3d n = Eigen::Vector3d(-kSlope, 0.0, 1.0).normalized();
  const Plane tilted{n, n.z() * test::kFloorBelow_m}, level = level_at(0.0);
  open.grid->mark(open.set(), tilted, kThresh_m);
  const double whole_m2 = open.grid_of().evidence(kAhead_x).area_m2;
  open.grid->mark_apart(open.set(), tilted, level, kThresh_m);
  EXPECT_NEAR(open.grid_of().evidence(kAhead_x).area_m2, whole_m2 * (1.0 - kThresh_m / kSlope / 4.0), 0.05 * whole_m2);
  EXPECT_LT(open.grid_of().evidence(kAhead_x).area_m2, 0.97 * whole_m2) << "the middle is left out";
  open.grid->mark_apart(open.set(), level, tilted, kThresh_m);
  EXPECT_EQ(open.grid_of().evidence(kAhead_x).area_m2, 0.0) << "all points lie on the other one";
}

TEST(FloorGrid, WhatLiesBelowAPlaneSpeaksAgainstItUnlessItIsAReflection) {
  test::FloorFixture floor;
  floor.add_level({-3, 3, -2.0, 2.0}, 0.0);
  EXPECT_FALSE(much_is_below(&floor, 0.0));
  EXPECT_TRUE(much_is_below(&floor, 1.0)) << "a plane without points of its own";
  test::FloorFixture deck;  // beside floor that is seen past its edge
  deck.add_level({-1, 1, -2.0, 2.0}, 0.8);
  deck.add_level({-8, -2, -2.0, 2.0}, 0.0);
  deck.add_level({2, 8, -2.0, 2.0}, 0.0);
  EXPECT_TRUE(much_is_below(&deck, 0.8));
  EXPECT_FALSE(much_is_below(&deck, 0.0));
  test::FloorFixture wet;
  wet.add_level({-6, 6, -2.0, 2.0}, 0.0, 0.005, 0.15);
  wet.add_level({-4, 4, -1.5, 1.5}, -1.0, 0.005, 0.15);
  EXPECT_FALSE(much_is_below(&wet, 0.0));
  test::FloorFixture none;
  EXPECT_FALSE(much_is_below(&none, 0.0));
}

// The ditch has three eighths of the floor's area, and five times its points.
TEST(FloorGrid, AreaBelowCountsAndNotPoints) {
  test::FloorFixture ditch;
  ditch.add_level({-6, 2, -2.0, 2.0}, 0.0, 0.005, 0.2);
  ditch.add_level({8, 11, -2.0, 2.0}, -2.0, 0.005, 0.05);
  EXPECT_FALSE(much_is_below(&ditch, 0.0, 0.45));
  EXPECT_TRUE(much_is_below(&ditch, 0.0, 0.3));
}

// The bench shows twice as much as the floor beside it.
TEST(FloorGrid, AFloorOfHalfItsAreaSpeaksAgainstABench) {
  test::FloorFixture bench;
  bench.add_level({-6, 6, 0.0, 2.0}, 0.8);
  bench.add_level({-6, 0, -4.0, -2.0}, 0.0);
  EXPECT_TRUE(much_is_below(&bench, 0.8));
  EXPECT_FALSE(much_is_below(&bench, 0.0));
}

// A sensor that looks up sees the roof, near walls to a little below itself and farther ones to their feet. A level
// plane cuts through both walls where they are so sparsely seen that nothing else is in its cells. What lies below it
// is a small part of all points.
TEST(FloorGrid, APlaneThroughBothWallsHasTheirFeetBelowItWhereverTheSensorLooks) {
  test::FloorFixture road;
  road.add_level({-10, 10, -2.0, 2.0}, 3.0, 0.005, 0.05);
  for (const double y : {-2.0, 2.0}) {
    for (double x = -10.0; x <= 10.0; x += 0.1) {
      if (std::fabs(x) < 3.0) road.add(x, y, 1.0);
      if (std::fabs(x) > 5.0) road.add(x, y, 0.4);
    }
  }
  EXPECT_TRUE(much_is_below(&road, 1.0));
  EXPECT_FALSE(much_is_below(&road, 0.4)) << "nothing is seen below the lowest";
}

TEST(FloorGrid, AReflectionIsSeenThroughTheFloor) {
  test::FloorFixture g;
  g.add_level({-6, 6, -2.0, 2.0}, 0.0, 0.005, 0.15);
  g.add_level({-4, 4, -1.5, 1.5}, -1.0, 0.005, 0.15);
  Open open(&g);
  open.grid->mark(open.set(), level_at(0.0), 0.03);
  const Eigen::Vector3d sensor = Eigen::Vector3d::Zero();
  EXPECT_GT(share_seen_through(*open.grid, level_at(0.0), level_at(-1.0), open.set(), sensor, 0.03), 0.9);
  // And the floor is not seen through the reflection.
  open.grid->mark(open.set(), level_at(-1.0), 0.03);
  EXPECT_LT(share_seen_through(*open.grid, level_at(-1.0), level_at(0.0), open.set(), sensor, 0.03), 0.1);
}

// As FloorGrid::clear_around(), one cell and one point at a time.
class SlowClear {
 public:
  SlowClear(const PointSet& points, const Plane& plane, double gate_m) {
    for (std::uint32_t i = 0; i < points.count; ++i) {
      const double height_m = plane.signed_distance(points.at(i));
      if (height_m > gate_m && height_m < 1.0) rising_.insert({cell_of(points.x[i]), cell_of(points.y[i])});
    }
  }

  bool around(float x, float y) const {
    for (const int ix : {cell_of(x - 0.1F), cell_of(x + 0.1F)}) {
      for (const int iy : {cell_of(y - 0.1F), cell_of(y + 0.1F)}) {
        if (rising_.count({ix, iy}) > 0) return false;
      }
    }
    return true;
  }

 private:
  static int cell_of(float coordinate) { return static_cast<int>(std::floor(coordinate * 4.0F + 80.0F)); }
  std::set<std::pair<int, int>> rising_;
};

TEST(FloorGrid, ClearAroundIsWhatALookAtEachCellSays) {
  test::FloorFixture g;
  test::Noise noise(5);
  for (int k = 0; k < 8000; ++k) {
    g.points().add(noise.uniform(-10.0, 10.0), noise.uniform(-15.5, 15.5), noise.uniform(-6.0, 3.0));
  }
  const Open open(&g);
  const Eigen::Vector3d n = Eigen::Vector3d(-0.1, 0.05, 1.0).normalized();
  const Plane plane{n, test::kFloorBelow_m};
  open.grid->mark_rising(g.points().set(), plane, 0.09);
  const SlowClear slow(g.points().set(), plane, 0.09);
  std::uint32_t clear = 0, looked_at = 0;
  for (int k = 0; k < 5000; ++k) {
    FourFloats x{}, y{};
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      x[lane] = static_cast<float>(noise.uniform(-10.5, 10.5));
      y[lane] = static_cast<float>(noise.uniform(-19.85, 19.85));
    }
    const FourTruths counts = FourInts{k & 1, k & 2, k & 4, k & 8} != 0;
    const FourTruths fast = open.grid_of().clear_around(x, y, counts);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (counts[lane] == 0) {
        EXPECT_EQ(fast[lane], 0) << "not asked for";
        continue;
      }
      ++looked_at;
      clear += fast[lane] != 0 ? 1U : 0U;
      EXPECT_EQ(fast[lane] != 0, slow.around(x[lane], y[lane])) << x[lane] << " " << y[lane];
    }
  }
  EXPECT_GT(clear, looked_at / 10);
  EXPECT_LT(clear, looked_at * 9 / 10) << "or nothing was tested";
}

// What hangs under the roof, or lies below the floor, leaves the floor under it in the fit.
TEST(FloorGrid, OnlyWhatRisesFromThePlaneIsKeptClearOf) {
  test::FloorFixture g;
  g.add(0.0, 0.0, 0.2);
  g.add(3.0, 0.0, 0.05);
  g.add(6.0, 0.0, 2.5);
  g.add(9.0, 0.0, -0.3);
  Open open(&g);
  open.grid->mark_rising(g.points().set(), level_at(0.0), 0.09);
  const FourTruths all = FourInts{1, 1, 1, 1} != 0;
  const FourTruths clear = open.grid_of().clear_around(FourFloats{0.0F, 3.0F, 6.0F, 9.0F}, FourFloats{}, all);
  EXPECT_EQ(clear[0], 0) << "a heap";
  for (std::uint32_t lane = 1; lane < kFour; ++lane) EXPECT_NE(clear[lane], 0) << lane;
}

TEST(FloorGrid, AnyCountOfPointsIsMarked) {
  for (std::uint32_t points = 1; points <= 9; ++points) {
    test::FloorFixture g;
    for (std::uint32_t k = 0; k < points; ++k) g.points().add(0.5 * k - 2.1, 0.1, -test::kFloorBelow_m);
    Open open(&g);
    open.grid->mark(open.set(), level_at(0.0), 0.03);
    EXPECT_EQ(open.grid->evidence(kAhead_x).area_m2, points * 0.0625) << "a cell each";
  }
}

TEST(FloorGrid, PointsFarOutsideAndOddHeightsDoNoHarm) {
  test::FloorFixture g;
  for (const double far : {-450.0, -20.5, 20.5, 450.0}) {
    g.add(far, 0.0, 0.0);
    g.add(0.0, far, 0.0);
    g.add(0.0, 0.0, far);
  }
  Open open(&g);
  open.grid->mark(open.set(), level_at(0.0), 0.03);
  EXPECT_LE(open.grid->evidence(kAhead_x).area_m2, 1.0);
}

}  // namespace
}  // namespace pose_wall
