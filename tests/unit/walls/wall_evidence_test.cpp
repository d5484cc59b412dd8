// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the grid on a plane tells solid wall from things seen through, and measures length and area in whole
// cells; a ray speaks against it where it crosses it, as often as it stands for.

#include "engine/walls/propose/evidence.hpp"

#include <gtest/gtest.h>

#include "support/band_fixture.hpp"

namespace pose_wall {
namespace {

using test::BandFixture;

class Marked {
 public:
  explicit Marked(BandFixture* band, double y_m = 2.5) {
    const WallScene s = band->scene();
    grid_->mark(s, Plane{Eigen::Vector3d(0, -1, 0), y_m}, Eigen::Vector3d::UnitX(), {0.05, 0.15});
  }
  WallEvidence evidence() { return grid_->evidence(); }
  WallGrid* operator->() { return grid_.get(); }
  bool solid_at(float along_m, float z_level_m) {
    const FourTruths solid = grid_->solid_at(all_four(along_m), all_four(z_level_m), FourInts{0, -1, -1, 0});
    EXPECT_EQ(solid[0], 0) << "does not count";
    EXPECT_EQ(solid[3], 0);
    EXPECT_EQ(solid[1], solid[2]);
    return solid[1] != 0;
  }

 private:
  test::Placed<WallGrid> grid_;
};

TEST(WallGrid, ASolidWall) {
  BandFixture band;
  band.add_wall(2.5, {-4.0, 4.0, 0.3, 2.4});
  const WallEvidence e = Marked(&band).evidence();
  EXPECT_NEAR(e.length_m, 8.0, 0.6);  // a column at each end
  EXPECT_NEAR(e.along_min_m, -4.0, 0.51);
  EXPECT_NEAR(e.along_max_m, 4.0, 0.51);
  EXPECT_NEAR(e.area_m2, 8.0 * 2.25, 0.15 * 8.0 * 2.25);
  EXPECT_EQ(e.seen_through, 0.0);
  EXPECT_EQ(e.score_m2, e.area_m2);
  EXPECT_NEAR(e.inliers, 4.0 * band.points().set().count, 0.01 * e.inliers) << "each point stands for four";
}

TEST(WallGrid, NothingThere) {
  BandFixture band;
  const WallEvidence e = Marked(&band).evidence();
  EXPECT_EQ(e.score_m2, 0.0);
  EXPECT_EQ(e.length_m, 0.0);
  EXPECT_EQ(e.inliers, 0U);
}

TEST(WallGrid, APipeIsSeenThrough) {
  BandFixture band;
  // The wall behind, but for the shadow of the pipe.
  band.add_wall(2.5, {-8.0, 8.0, 0.3, 1.2});
  band.add_wall(2.5, {-8.0, 8.0, 1.6, 2.4});
  // The pipe is nearer and so holds more points.
  for (int copy = 0; copy < 3; ++copy) band.add_wall(1.9, {-6.0, 6.0, 1.3, 1.5});
  const WallEvidence pipe = Marked(&band, 1.9).evidence(), wall = Marked(&band, 2.5).evidence();
  EXPECT_GT(pipe.seen_through, 0.5);
  EXPECT_LT(wall.seen_through, 0.1);
  EXPECT_LT(pipe.score_m2, 0.2 * wall.score_m2);
}

TEST(WallGrid, WhatStopsIsToldByRaysWhateverCellsTheyFill) {
  const auto stopped = [](int copies_before, double behind_from_m, double behind_to_m, float beyond) {
    BandFixture band;
    for (int copy = 0; copy < copies_before; ++copy) band.add_wall(2.0, {-4.0, 4.0, 0.3, 2.4});
    if (behind_to_m > behind_from_m) band.add_wall(4.0, {behind_from_m, behind_to_m, 0.3, 2.4});
    if (beyond > 0.0F) band.beyond().add(2.4, 4.0, 1.4, beyond);
    return Marked(&band, 2.0).evidence().stopped;
  };
  EXPECT_EQ(stopped(1, 0.0, 0.0, 0.0F), 1.0);
  EXPECT_NEAR(stopped(1, -4.0, 4.0, 0.0F), 0.5, 0.01);
  EXPECT_NEAR(stopped(3, -4.0, 4.0, 0.0F), 0.75, 0.01);
  const double before = stopped(1, -2.0, 2.0, 0.0F);
  EXPECT_NEAR(before, 2.0 / 3.0, 0.01);
  EXPECT_LT(stopped(1, -2.0, 2.0, 500.0F), before - 0.01) << "what lies outside the band has passed it, too";
  EXPECT_EQ(stopped(0, -4.0, 4.0, 0.0F), 0.0);
}

TEST(WallGrid, IsSolidWhereItsPointsAreDense) {
  BandFixture band;
  band.add_wall(2.5, {-6.0, -2.0, 0.3, 2.4});
  band.add_wall(2.5, {3.0, 6.0, 0.3, 2.4});
  Marked grid(&band);
  EXPECT_TRUE(grid.solid_at(-4.1F, 0.1F));
  EXPECT_FALSE(grid.solid_at(0.5F, 0.1F));
  EXPECT_FALSE(grid.solid_at(-4.1F, 50.0F));
  EXPECT_FALSE(grid.solid_at(1e6F, 0.1F));
  for (double along_m = -40.1; along_m < 40.0; along_m += 0.17) {
    const bool well_inside = (along_m > -5.5 && along_m < -2.5) || (along_m > 3.5 && along_m < 5.5);
    const bool well_outside = along_m < -6.5 || (along_m > -1.5 && along_m < 2.5) || along_m > 6.5;
    if (!well_inside && !well_outside) continue;
    EXPECT_EQ(grid->is_solid_at(along_m), well_inside) << along_m;
  }
}

// What stands alone before a wall may be a stump, and a column a stray.
TEST(WallGrid, AWallIsAsFarAwayAsItsNearestColumnsSideBySide) {
  BandFixture around, ahead, behind, with_stump;
  around.add_wall(2.5, {-4.0, 4.0, 0.3, 2.4});
  ahead.add_wall(2.5, {3.0, 9.0, 0.3, 2.4});
  behind.add_wall(2.5, {-9.0, -3.0, 0.3, 2.4});
  with_stump.add_wall(2.5, {3.0, 9.0, 0.3, 2.4});
  with_stump.add_wall(2.5, {0.1, 0.4, 0.3, 1.2});
  EXPECT_EQ(Marked(&around).evidence().away_m, 0.0);
  EXPECT_NEAR(Marked(&ahead).evidence().away_m, 3.0, 0.51);
  EXPECT_NEAR(Marked(&behind).evidence().away_m, 3.0, 0.51);
  const WallEvidence e = Marked(&with_stump).evidence();
  EXPECT_LT(e.along_min_m, 0.5);
  EXPECT_NEAR(e.away_m, 3.0, 0.51);
  BandFixture nothing;
  EXPECT_GT(Marked(&nothing).evidence().away_m, 100.0);
}

TEST(WallGrid, PointsFarOutsideTheGridDoNoHarm) {
  BandFixture band;
  band.add_wall(2.5, {-4.0, 4.0, 0.3, 2.4});
  const double before = Marked(&band).evidence().score_m2;
  for (const double x : {-400.0, -33.0, 33.0, 400.0}) band.points().add(x, 2.5, 0.0);
  EXPECT_EQ(Marked(&band).evidence().score_m2, before);
}

// Sensor at the origin, plane 2 m to the left: a ray that ends 4 m to the left crosses it half way.
TEST(WallGrid, ARayCountsWhereItCrossesThePlaneThoughItEndsOutsideTheBand) {
  const auto solid_with = [](double y_m, float rays) {
    BandFixture band;
    band.add_wall(2.0, {-4.0, 4.0, 0.3, 2.4});
    band.beyond().add(2.4, y_m, 1.4, rays);
    Marked grid(&band, 2.0);
    EXPECT_TRUE(grid.solid_at(-1.2F, 0.7F)) << "elsewhere nothing changes";
    return grid.solid_at(1.2F, 0.7F);
  };
  EXPECT_FALSE(solid_with(4.0, 200.0F)) << "a cell holds some 15 hits";
  EXPECT_TRUE(solid_with(4.0, 2.0F)) << "fewer rays than hits";
  EXPECT_TRUE(solid_with(1.9, 200.0F)) << "ends before the plane";
  EXPECT_TRUE(solid_with(2.1, 200.0F)) << "ends behind it, but not well behind";
  EXPECT_FALSE(solid_with(4.0, 1e6F)) << "the counter does not wrap";
}

}  // namespace
}  // namespace pose_wall
