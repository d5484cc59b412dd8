// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a curtain or a vehicle past both of whose ends the sensor looks is an island; a wall is none that goes on, or
// bends away, or ends on one side only, or has an opening near the sensor. What the sensor looks over is low, even
// where it does so only far ahead; a wall up to the roof is not, nor one with openings or that bends away. A sensor
// that does not look up has not seen the top. Scenes are cast ray by ray on flat panels, without noise. Does not prove
// it for rough rock, nor for voxels.

#include "engine/walls/doubts/edges.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/ray_scene.hpp"

namespace pose_wall {
namespace {

using namespace test;

constexpr double kMargin_m = 0.15;
constexpr Interval kFull{test::kFloorZ_m, 1.8};

const Lidar kLidars[] = {{-15.0, 15.0, 2.0, 0.4}, {-22.5, 22.5, 0.7, 0.7}, {-45.0, 45.0, 0.7, 1.0}};

RayScene road() {
  RayScene scene;
  scene.add(test::level_panel(test::kFloorZ_m)).add(test::level_panel(1.8));
  return scene.add(side_panel(-2.2, kEverywhere, kFull));
}

WallEdges edges(BandFixture* band, double plane_y_m) {
  test::Placed<EdgeScratch> scratch;
  const Plane plane{Eigen::Vector3d(0, -1, 0), plane_y_m};
  // What another wall has left in it is no matter.
  look_past(band->scene(), Plane{Eigen::Vector3d(0, -1, 0), 0.7}, Eigen::Vector3d::UnitX(), kMargin_m, scratch.get());
  return look_past(band->scene(), plane, Eigen::Vector3d::UnitX(), kMargin_m, scratch.get());
}

WallEdges edges(const RayScene& scene, double plane_y_m, const Lidar& lidar) {
  BandFixture band;
  scene.scan(lidar, &band);
  return edges(&band, plane_y_m);
}

TEST(WallEnds, ACurtainBeforeTheWallIsAnIsland) {
  for (const Lidar& lidar : kLidars) {
    for (const Interval& along : {Interval{-1.5, 1.5}, Interval{-4.0, 2.0}, Interval{-0.6, 4.5}}) {
      for (const double y_m : {1.0, 1.8}) {
        RayScene scene = road();
        scene.add(side_panel(y_m, along, kFull)).add(side_panel(3.0, kEverywhere, kFull));
        EXPECT_TRUE(edges(scene, y_m, lidar).island) << y_m << " from " << along.low << " to " << along.high;
      }
    }
  }
}

// The floor behind its ends is seen.
TEST(WallEnds, ACurtainBeforeNothingIsAnIsland) {
  for (const Lidar& lidar : kLidars) {
    EXPECT_TRUE(edges(road().add(side_panel(1.5, {-2.0, 2.0}, kFull)), 1.5, lidar).island);
  }
}

TEST(WallEnds, AWallThatGoesOnIsNone) {
  for (const Lidar& lidar : kLidars) {
    for (const double y_m : {0.8, 1.5, 2.5, 4.0}) {
      EXPECT_FALSE(edges(road().add(side_panel(y_m, kEverywhere, kFull)), y_m, lidar).island) << y_m;
      EXPECT_FALSE(edges(road().add(side_panel(y_m, kEverywhere, kFull)), y_m, lidar).low) << y_m;
    }
  }
}

TEST(WallEnds, AWallThatEndsOnOneSideOnlyIsNone) {
  for (const Lidar& lidar : kLidars) {
    for (const double end_m : {-1.0, 1.0, 3.0}) {
      RayScene scene = road();
      scene.add(side_panel(2.0, {-40.0, end_m}, kFull)).add(cross_panel(end_m, {2.0, 6.0}, kFull));
      scene.add(side_panel(6.0, kEverywhere, kFull));
      EXPECT_FALSE(edges(scene, 2.0, lidar).island) << end_m;
      EXPECT_FALSE(edges(scene, 2.0, lidar).low) << end_m;
    }
  }
}

// An arc as chords of half a metre, to the left of a plane that touches it beside the sensor: both of its ends lie more
// than the margin behind the plane from 2.7 m on.
TEST(WallEnds, AWallThatBendsAwayIsNone) {
  constexpr double kRadius_m = 25.0, kChordsAt_m = 2.0, kChord_m = 0.5;
  for (const Lidar& lidar : kLidars) {
    RayScene scene = road();
    for (double x = -15.0; x < 15.0; x += kChord_m) {
      const double middle_m = x + 0.5 * kChord_m;
      const double back_m = kRadius_m - std::sqrt(kRadius_m * kRadius_m - middle_m * middle_m);
      scene.add(side_panel(kChordsAt_m + back_m, {x, x + kChord_m}, kFull));
    }
    EXPECT_FALSE(edges(scene, kChordsAt_m, lidar).island);
    EXPECT_FALSE(edges(scene, kChordsAt_m, lidar).low);
  }
}

TEST(WallEnds, AWallWithAnOpeningBesideTheSensorIsNone) {
  for (const Lidar& lidar : kLidars) {
    for (const double from_x_m : {-1.5, -0.5, 1.0}) {
      const double to_x_m = from_x_m + 2.5;
      RayScene scene = road();
      scene.add(side_panel(2.0, {-40.0, from_x_m}, kFull)).add(side_panel(2.0, {to_x_m, 40.0}, kFull));
      scene.add(cross_panel(from_x_m, {2.0, 8.0}, kFull)).add(cross_panel(to_x_m, {2.0, 8.0}, kFull));
      scene.add(side_panel(8.0, kEverywhere, kFull));
      EXPECT_FALSE(edges(scene, 2.0, lidar).island) << from_x_m;
      EXPECT_FALSE(edges(scene, 2.0, lidar).low) << from_x_m;
    }
  }
}

// What stands between two roads is no curtain: behind each of them the wall goes on.
TEST(WallEnds, AWallBetweenTwoOpeningsIsNone) {
  for (const Lidar& lidar : kLidars) {
    for (const double half_m : {0.8, 1.5}) {
      RayScene scene = road();
      scene.add(side_panel(2.0, {-half_m, half_m}, kFull)).add(side_panel(8.0, kEverywhere, kFull));
      for (const double near_m : {-half_m - 2.5, half_m}) {
        scene.add(cross_panel(near_m, {2.0, 8.0}, kFull)).add(cross_panel(near_m + 2.5, {2.0, 8.0}, kFull));
      }
      scene.add(side_panel(2.0, {-40.0, -half_m - 2.5}, kFull)).add(side_panel(2.0, {half_m + 2.5, 40.0}, kFull));
      EXPECT_FALSE(edges(scene, 2.0, lidar).island) << half_m;
      EXPECT_FALSE(edges(scene, 2.0, lidar).low) << half_m;
    }
  }
}

// The sensor looks up 7 degrees at most: beside it, the thing is as high as it sees.
const Lidar kHardlyUp{-52.0, 7.0, 1.0, 0.5};

TEST(WallTops, AThingBeforeTheWallIsLookedOver) {
  for (const Lidar& lidar : {kLidars[0], kLidars[1], kLidars[2], kHardlyUp}) {
    for (const double top_m : {-0.6, -0.1, 0.2}) {
      for (const double y_m : {0.5, 1.0, 1.8}) {
        RayScene scene = road();
        scene.add(side_panel(y_m, kEverywhere, {test::kFloorZ_m, top_m})).add(side_panel(3.0, kEverywhere, kFull));
        EXPECT_TRUE(edges(scene, y_m, lidar).low) << top_m << " at " << y_m;
        EXPECT_FALSE(edges(scene, 3.0, lidar).low) << "the wall behind, " << top_m << " at " << y_m;
      }
    }
  }
}

TEST(WallTops, AWallWithWindowsIsNotLow) {
  for (const Lidar& lidar : {kLidars[0], kLidars[1], kLidars[2], kHardlyUp}) {
    RayScene scene = road();
    scene.add(side_panel(2.0, kEverywhere, {test::kFloorZ_m, 0.2})).add(side_panel(4.0, kEverywhere, kFull));
    for (const Interval& wall : {Interval{-40.0, -2.0}, Interval{-1.0, 4.0}, Interval{6.0, 40.0}}) {
      scene.add(side_panel(2.0, wall, {0.2, 1.8}));
    }
    EXPECT_FALSE(edges(scene, 2.0, lidar).low);
  }
}

// Half-way up the wall, as high as the sensor looks: a conveyor and a wall are the same from here.
TEST(WallTops, ASensorThatDoesNotLookUpCannotTellAWall) {
  const Lidar kNeverUp{-52.0, -1.0, 1.0, 0.5};
  for (const double y_m : {0.5, 1.0, 2.0}) {
    const RayScene scene = road().add(side_panel(y_m, kEverywhere, kFull));
    EXPECT_TRUE(edges(scene, y_m, kNeverUp).top_unseen) << y_m;
    for (const Lidar& lidar : {kLidars[0], kLidars[1], kLidars[2], kHardlyUp}) {
      EXPECT_FALSE(edges(scene, y_m, lidar).top_unseen) << y_m;
    }
  }
}

// An arch begins above the springing: what the sensor sees there lies before the plane of the wall below.
TEST(WallTops, WhatIsSeenBeforeThePlaneIsATopToo) {
  RayScene scene = road();
  scene.add(side_panel(2.0, kEverywhere, {test::kFloorZ_m, -0.2})).add(side_panel(1.6, kEverywhere, {-0.2, 1.8}));
  for (const Lidar& lidar : kLidars) EXPECT_FALSE(edges(scene, 2.0, lidar).top_unseen);
}

// Roof has come down at the shoulder: beyond the plane there is a hollow, higher than the roof is elsewhere.
TEST(WallTops, AHollowAtTheShoulderDoesNotMakeAWallLow) {
  constexpr double kRoof_m = 1.0, kHollowRoof_m = 1.8;
  for (const Lidar& lidar : {kLidars[0], kLidars[1], kLidars[2]}) {
    for (const double from_x_m : {-1.0, 1.0, 3.0}) {
      const Interval hollow{from_x_m, from_x_m + 1.2};
      RayScene scene;
      scene.add(test::level_panel(test::kFloorZ_m)).add(test::level_panel(kHollowRoof_m));
      scene.add(side_panel(2.0, kEverywhere, {test::kFloorZ_m, kRoof_m}));
      scene.add({2, kRoof_m, {-40.0, hollow.low}, kEverywhere, kEverywhere});
      scene.add({2, kRoof_m, {hollow.high, 40.0}, kEverywhere, kEverywhere});
      scene.add(side_panel(2.6, hollow, {kRoof_m, kHollowRoof_m}));
      for (const double end_m : {hollow.low, hollow.high}) {
        scene.add(cross_panel(end_m, kEverywhere, {kRoof_m, kHollowRoof_m}));
      }
      EXPECT_FALSE(edges(scene, 2.0, lidar).low) << from_x_m;
    }
  }
}

bool island_among_wild_points(const RayScene& scene, double plane_y_m) {
  BandFixture band;
  scene.scan(kLidars[0], &band);
  for (const double wild : {-1e30, -1e5, 1e-30, 1e5, 1e30}) {
    band.points().add(wild, 1.0, 0.0);
    band.points().add(0.0, wild, 0.0);
    band.beyond().add(1.0, 3.0, wild);
  }
  return edges(&band, plane_y_m).island;
}

TEST(WallEnds, NothingSeenAndWildPointsMakeNoIsland) {
  for (const double y_m : {-2.0, 0.0, 2.0}) {
    EXPECT_FALSE(edges(RayScene(), y_m, kLidars[0]).island) << y_m;
    EXPECT_FALSE(edges(RayScene(), y_m, kLidars[0]).low) << y_m;
  }
  EXPECT_FALSE(island_among_wild_points(road().add(side_panel(2.0, kEverywhere, kFull)), 2.0));
}

TEST(WallEnds, WildPointsDoNotHideAnIsland) {
  for (const double y_m : {1.3, 1.8}) {
    RayScene curtain = road();
    curtain.add(side_panel(y_m, {-1.5, 1.5}, kFull)).add(side_panel(3.0, kEverywhere, kFull));
    EXPECT_TRUE(island_among_wild_points(curtain, y_m)) << y_m;
  }
}

// Pipes one above the other half-way up a wall, and props from floor to roof before it: next to nothing is seen of the
// wall behind, and all of that lies equally far behind.
RayScene pipes_and_props(double y_m, double behind_m) {
  RayScene scene = road();
  for (const Interval& pipe : {Interval{-0.35, -0.05}, Interval{-0.02, 0.35}, Interval{0.38, 0.7}}) {
    scene.add(side_panel(y_m, kEverywhere, pipe));
  }
  for (double x = -30.0; x < 30.0; x += 0.8) scene.add(side_panel(y_m, {x, x + 0.25}, kFull));
  return scene.add(side_panel(y_m + behind_m, kEverywhere, kFull));
}

TEST(WallLayers, TheWallBehindPipesAndPropsIsTold) {
  for (const Lidar& lidar : kLidars) {
    for (const double y_m : {1.0, 1.5}) {
      for (const double behind_m : {0.4, 0.55, 1.0}) {
        EXPECT_TRUE(edges(pipes_and_props(y_m, behind_m), y_m, lidar).layer_behind) << y_m << ", " << behind_m;
        EXPECT_FALSE(edges(pipes_and_props(y_m, behind_m), y_m + behind_m, lidar).layer_behind) << "the wall itself";
      }
    }
  }
}

TEST(WallLayers, NothingIsBehindAWallNorBehindOneWithNichesOrRoads) {
  for (const Lidar& lidar : kLidars) {
    EXPECT_FALSE(edges(road().add(side_panel(2.0, kEverywhere, kFull)), 2.0, lidar).layer_behind);
    for (const double deep_m : {0.5, 1.0, 8.0}) {
      for (const double from_x_m : {-2.0, 0.5, 3.0}) {
        const double to_x_m = from_x_m + 4.0;
        RayScene scene = road();
        scene.add(side_panel(2.0, {-40.0, from_x_m}, kFull)).add(side_panel(2.0, {to_x_m, 40.0}, kFull));
        scene.add(cross_panel(from_x_m, {2.0, 2.0 + deep_m}, kFull))
            .add(cross_panel(to_x_m, {2.0, 2.0 + deep_m}, kFull));
        scene.add(side_panel(2.0 + deep_m, {from_x_m, to_x_m}, kFull));
        EXPECT_FALSE(edges(scene, 2.0, lidar).layer_behind) << deep_m << " deep from " << from_x_m;
      }
    }
  }
}

}  // namespace
}  // namespace pose_wall
