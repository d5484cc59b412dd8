// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the close look at a chosen plane calls rows of pipes and props silent or open, whether what is behind them is
// seen or too dark; lets a solid wall pass, whatever the sensor, its tilt, the things before the wall and an opening in
// it; and sees whether the roof is beyond the plane. Scenes are cast ray by ray on flat panels, without noise. Does not
// prove overtopping for a sensor that sees the roof over itself, nor the shares for rough rock or for a moving machine.

#include "stages/walls_holes.hpp"

#include <gtest/gtest.h>

#include "support/ray_scene.hpp"

namespace pose_wall {
namespace {

using test::BandFixture;
using test::cross_panel;
using test::Interval;
using test::kEverywhere;
using test::level_panel;
using test::Lidar;
using test::RayScene;
using test::side_panel;

constexpr double kHit_m = 0.15;
constexpr double kRoof_m = 1.8;  // above the sensor; the band ends at 1.1
constexpr Interval kFull{test::kFloorZ_m, kRoof_m};
// Rays fall on rows and columns by chance: a cell in a hundred may be missed at their rims.
constexpr double kNone = 0.02;

const Lidar kVlp16{-15.0, 15.0, 2.0, 0.2};
const Lidar kOs0{-45.0, 45.0, 0.7, 0.5};

Lidar tilted(Lidar lidar, double degrees, const Eigen::Vector3d& axis) {
  lidar.R_level_lidar = Eigen::AngleAxisd(degrees * M_PI / 180.0, axis).toRotationMatrix();
  return lidar;
}

RayScene road() {
  RayScene scene;
  scene.add(level_panel(test::kFloorZ_m)).add(level_panel(kRoof_m));
  return scene;
}

WallHoles look(const RayScene& scene, double plane_y_m, const Lidar& lidar) {
  BandFixture band;
  scene.scan(lidar, &band);
  return find_holes(band.scene(), Plane{Eigen::Vector3d(0, -1, 0), plane_y_m}, Eigen::Vector3d::UnitX(), kHit_m);
}

// Pipes 0.1 m thick, one every 0.5 m: four fifths of the height are between them. A row of 0.15 m that a pipe touches
// is the pipe's, so that no more than half of all rows are: two of each three and a third.
RayScene pipes(double y_m, bool wall_is_dark) {
  RayScene scene = road();
  for (double z = -1.2; z < 1.2; z += 0.5) scene.add(side_panel(y_m, kEverywhere, {z, z + 0.1}));
  scene.add(side_panel(y_m + 0.8, kEverywhere, kFull, wall_is_dark));
  return scene;
}

void expect_solid(const WallHoles& holes) {
  EXPECT_LE(holes.silent, kNone);
  EXPECT_LE(holes.open, kNone);
  EXPECT_LE(holes.overtopped, kNone);
}

TEST(WallHoles, ASolidWallHasNone) {
  for (const Lidar& lidar : {kVlp16, kOs0}) {
    for (const double y_m : {1.3, 2.0, 2.5, 3.2}) {
      SCOPED_TRACE(y_m);
      expect_solid(look(road().add(side_panel(y_m, kEverywhere, kFull)), y_m, lidar));
    }
  }
}

TEST(WallHoles, PipesBeforeAWallTooDarkToBeSeenAreSilent) {
  for (const Lidar& lidar : {kVlp16, kOs0}) {
    for (const double y_m : {1.5, 2.0, 2.5}) {
      const WallHoles holes = look(pipes(y_m, true), y_m, lidar);
      EXPECT_GT(holes.silent, 0.3) << y_m;
      EXPECT_GE(holes.open, holes.silent - 1e-6) << "what is silent is open too";
    }
  }
}

TEST(WallHoles, PipesBeforeAWallAreOpenAndNotSilent) {
  for (const Lidar& lidar : {kVlp16, kOs0}) {
    for (const double y_m : {1.5, 2.0, 2.5}) {
      const WallHoles holes = look(pipes(y_m, false), y_m, lidar);
      EXPECT_LE(holes.silent, kNone) << y_m;
      EXPECT_GT(holes.open, 0.3) << y_m;
    }
  }
}

// Props 0.2 m wide every 0.8 m: three quarters of the length are between them, columns of 0.2 m that they touch half.
TEST(WallHoles, ARowOfPropsIsOpen) {
  RayScene scene = road();
  for (double x = -12.0; x < 12.0; x += 0.8) scene.add(side_panel(2.0, {x, x + 0.2}, kFull));
  for (const bool dark : {false, true}) {
    RayScene whole = scene;
    const WallHoles holes = look(whole.add(side_panel(2.8, kEverywhere, kFull, dark)), 2.0, kOs0);
    EXPECT_GT(holes.open, 0.4) << (dark ? "dark" : "seen");
    EXPECT_EQ(holes.silent > 0.3, dark);
  }
}

TEST(WallHoles, ARoadThatBranchesOffIsNoHole) {
  for (const double from_x_m : {-0.75, 0.3, 1.0}) {
    const double to_x_m = from_x_m + 1.5;
    RayScene scene = road();
    scene.add(side_panel(2.0, {-20.0, from_x_m}, kFull)).add(side_panel(2.0, {to_x_m, 20.0}, kFull));
    scene.add(cross_panel(from_x_m, {2.0, 8.0}, kFull)).add(cross_panel(to_x_m, {2.0, 8.0}, kFull));
    scene.add(side_panel(8.0, kEverywhere, kFull));
    for (const Lidar& lidar : {kVlp16, kOs0}) {
      const WallHoles holes = look(scene, 2.0, lidar);
      EXPECT_LE(holes.silent, kNone) << from_x_m;
      // Columns at its rims are narrower than the opening's and hold a little of both.
      EXPECT_LE(holes.open, 0.05) << from_x_m;
    }
  }
}

// The counterpart: a gap of 0.6 m is a hole, and counts by its share of the reach. 5.7 m of the plane are in reach.
TEST(WallHoles, ANarrowGapCounts) {
  RayScene scene = road();
  scene.add(side_panel(2.0, {-20.0, -0.3}, kFull)).add(side_panel(2.0, {0.3, 20.0}, kFull));
  scene.add(side_panel(3.0, kEverywhere, kFull));
  EXPECT_NEAR(look(scene, 2.0, kOs0).open, 0.6 / 5.7, 0.05) << "a column is 0.2 m";
}

TEST(WallHoles, ATiltedFieldOfViewMakesNoSilence) {
  const Eigen::Vector3d axes[] = {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                                  Eigen::Vector3d(1, 1, 0).normalized()};
  for (const Lidar& lidar : {kVlp16, kOs0}) {
    for (const Eigen::Vector3d& axis : axes) {
      for (const double degrees : {-35.0, -15.0, 15.0, 35.0}) {
        SCOPED_TRACE(::testing::Message() << degrees << " about " << axis.transpose());
        expect_solid(look(road().add(side_panel(2.2, kEverywhere, kFull)), 2.2, tilted(lidar, degrees, axis)));
      }
    }
  }
}

TEST(WallHoles, WhatStandsBeforeTheWallHidesIt) {
  RayScene scene = road();
  scene.add(side_panel(2.4, kEverywhere, kFull));
  scene.add(side_panel(1.2, {-0.4, 0.3}, {test::kFloorZ_m, 0.5})).add(side_panel(1.5, {0.8, 1.2}, kFull));
  for (const Lidar& lidar : {kVlp16, kOs0}) expect_solid(look(scene, 2.4, lidar));
}

TEST(WallHoles, ACurtainThatDoesNotReachTheRoofIsOvertopped) {
  for (const double top_m : {-0.2, 0.0, 0.2}) {
    RayScene scene = road();
    scene.add(side_panel(1.8, kEverywhere, {test::kFloorZ_m, top_m})).add(side_panel(4.0, kEverywhere, kFull));
    EXPECT_GT(look(scene, 1.8, kVlp16).overtopped, 0.9) << top_m;
  }
}

TEST(WallHoles, NothingIsSaidWhereNothingIsSeen) {
  for (const double y_m : {0.0, 2.0, 20.0}) {
    const WallHoles holes = look(RayScene(), y_m, kOs0);
    EXPECT_EQ(holes.silent, 0.0);
    EXPECT_EQ(holes.open, 0.0);
    EXPECT_EQ(holes.overtopped, 0.0);
  }
  // Out of reach: only the roof can tell.
  const WallHoles far = look(pipes(6.0, true), 6.0, kOs0);
  EXPECT_EQ(far.silent, 0.0);
  EXPECT_EQ(far.open, 0.0);
}

TEST(WallHoles, WildPointsLeaveSharesFromNoughtToOne) {
  BandFixture band;
  pipes(2.0, true).scan(kVlp16, &band);
  for (const double wild : {-1e30, -1e5, 1e-30, 0.0, 1e5, 1e30}) {
    band.points().add(wild, 1.0, 0.0);
    band.points().add(0.0, wild, 0.0);
    band.beyond().add(1.0, 3.0, wild);
  }
  for (const double distance_m : {-2.0, 0.0, 1e-12, 2.0, 1e6}) {
    const WallHoles holes =
        find_holes(band.scene(), Plane{Eigen::Vector3d(0, -1, 0), distance_m}, Eigen::Vector3d::UnitX(), kHit_m);
    for (const double share : {holes.silent, holes.open, holes.overtopped}) {
      EXPECT_TRUE(share >= 0.0 && share <= 1.0) << share << " at " << distance_m;
    }
  }
}

}  // namespace
}  // namespace pose_wall
