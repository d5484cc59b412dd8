// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the close look at a chosen plane, direction by direction, calls rows of pipes and props silent or open,
// whether what is behind them is seen or too dark, and how deep it is; misses the top of what ends below the roof;
// and lets a solid wall pass, whatever the sensor, its tilt, the things before the wall, a road that branches off, dust
// and mud on the window; of many scans in one cloud it says what it says of one. Scenes are cast ray by ray on flat
// panels, without noise. Does not prove the shares for rough rock, for a moving machine, nor for a sensor that is not
// in the road's middle.

#include "engine/walls/doubts/sight.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "support/ray_scene.hpp"

namespace pose_wall {
namespace {

using namespace test;

constexpr double kBehind_m = 0.15;
constexpr double kRoof_m = 1.8;  // above the sensor; the band ends at 1.1
constexpr Interval kFull{test::kFloorZ_m, kRoof_m};
constexpr double kOtherSide_m = -2.2;
// Well below what the engine doubts or refuses a wall for (walls.cpp).
constexpr double kNoSilence = 0.012, kNothingOpen = 0.01;

Lidar tilted(Lidar lidar, double degrees, const Eigen::Vector3d& axis) {
  lidar.R_level_lidar = Eigen::AngleAxisd(degrees * M_PI / 180.0, axis).toRotationMatrix();
  return lidar;
}

// Floor, roof and the right wall. The left side is the test's.
RayScene road() {
  RayScene scene;
  scene.add(level_panel(test::kFloorZ_m)).add(level_panel(kRoof_m));
  scene.add(side_panel(kOtherSide_m, kEverywhere, kFull));
  return scene;
}

WallSight sight_of(BandFixture* band, double plane_y_m) {
  const WallScene scene = band->scene();
  test::Placed<SightScratch> scratch;
  learn_directions(scene, scratch.get());
  return look_at(scene, Plane{Eigen::Vector3d(0, -1, 0), plane_y_m}, Eigen::Vector3d::UnitX(), kBehind_m,
                 scratch.get());
}

WallSight look(const RayScene& scene, double plane_y_m, const Lidar& lidar, const RayScene::Lost& lost = nullptr) {
  BandFixture band;
  scene.scan(lidar, &band, lost);
  return sight_of(&band, plane_y_m);
}

// Pipes 0.1 m thick, one every 0.5 m: four fifths of the height are between them.
void add_pipes(double y_m, bool wall_is_dark, RayScene* scene) {
  for (double z = -1.2; z < 1.2; z += 0.5) scene->add(side_panel(y_m, kEverywhere, {z, z + 0.1}));
  scene->add(side_panel(y_m > 0.0 ? y_m + 0.8 : y_m - 0.8, kEverywhere, kFull, wall_is_dark));
}

RayScene pipes(double y_m, bool wall_is_dark) {
  RayScene scene = road();
  add_pipes(y_m, wall_is_dark, &scene);
  return scene;
}

// A wall 2 m to the left, of which a share of the returns is lost by chance, on this side alone or all around.
WallSight thinned(const Lidar& lidar, double lost_share, bool all_around) {
  Noise noise(3);
  return look(road().add(side_panel(2.0, kEverywhere, kFull)), 2.0, lidar, [&](const Eigen::Vector3d& ray_lidar) {
    return (all_around || ray_lidar.y() > 0.0) && noise.uniform(0.0, 1.0) < lost_share;
  });
}

void expect_solid(const WallSight& sight) {
  EXPECT_LE(sight.silent, kNoSilence);
  EXPECT_LE(sight.open, kNothingOpen);
  EXPECT_FALSE(sight.dim);
}

// Nothing that the engine would doubt or refuse a wall for.
bool said_nothing(const WallSight& sight) {
  return sight.silent <= 0.1 && !sight.dim;
}

void expect_nothing(const WallSight& sight) {
  EXPECT_EQ(sight.silent, 0.0);
  EXPECT_EQ(sight.open, 0.0);
  EXPECT_FALSE(sight.dim);
}

TEST(WallSight, ASolidWallHasNoFault) {
  for (const Lidar& lidar : {kVlp16, kOs1, kOs0}) {
    for (const double y_m : {0.8, 1.3, 2.0, 3.2, 4.5, 6.0}) {
      SCOPED_TRACE(::testing::Message() << y_m << " m, " << lidar.elevation_max_deg);
      expect_solid(look(road().add(side_panel(y_m, kEverywhere, kFull)), y_m, lidar));
    }
  }
}

TEST(WallSight, WhatWasKeptIsOnlyToldWhereThePlaneWasPassed) {
  for (const bool passed : {false, true}) {
    BandFixture band;
    RayScene scene = road();
    passed ? add_pipes(2.0, false, &scene) : (void)scene.add(side_panel(2.0, kEverywhere, kFull));
    scene.scan(kOs1, &band);
    const WallScene walls = band.scene();
    test::Placed<SightScratch> scratch;
    learn_directions(walls, scratch.get());
    EXPECT_FALSE(scratch->kept_is_told);
    look_at(walls, Plane{Eigen::Vector3d(0, -1, 0), 2.0}, Eigen::Vector3d::UnitX(), kBehind_m, scratch.get());
    EXPECT_EQ(scratch->kept_is_told, passed);
    tell_kept(walls, scratch.get());
    std::uint32_t kept = 0;
    for (std::uint32_t row = 0; row < DirectionGrid::kRows; ++row) {
      for (std::uint32_t column = 0; column < DirectionGrid::kColumns; ++column) {
        kept += scratch->kept_lidar.count(row, column);
      }
    }
    EXPECT_EQ(kept, walls.cloud_base.count) << "each point once, whoever asks how often";
  }
}

TEST(WallSight, ATiltedFieldOfViewIsNoFault) {
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

TEST(WallSight, PipesBeforeAWallTooDarkToBeSeenAreSilent) {
  for (const Lidar& lidar : {kVlp16, kOs1, kOs0}) {
    for (const double y_m : {1.0, 1.5, 2.5, 4.0}) {
      const WallSight sight = look(pipes(y_m, true), y_m, lidar);
      EXPECT_GT(sight.silent, 0.4) << y_m;
      EXPECT_GE(sight.open, sight.silent) << "what is silent is open too";
    }
  }
}

// Then the directions between the pipes are silent all around, or seen by few.
TEST(WallSight, PipesBeforeDarkWallsAllAroundAreNotPassedOver) {
  for (const double y_m : {1.0, 1.5, 2.5, 4.0}) {
    for (const double opposite_m : {y_m, 2.2}) {
      RayScene both;
      both.add(level_panel(test::kFloorZ_m)).add(level_panel(kRoof_m));
      add_pipes(y_m, true, &both);
      add_pipes(-opposite_m, true, &both);
      EXPECT_FALSE(said_nothing(look(both, y_m, kVlp16))) << y_m << " and " << opposite_m;
    }
    RayScene one;
    one.add(level_panel(test::kFloorZ_m)).add(level_panel(kRoof_m));
    add_pipes(y_m, true, &one);
    EXPECT_FALSE(said_nothing(look(one, y_m, kVlp16))) << y_m << " and nothing opposite";
  }
}

TEST(WallSight, PipesBeforeAWallAreOpenAndNotSilent) {
  for (const Lidar& lidar : {kVlp16, kOs1, kOs0}) {
    for (const double y_m : {1.0, 1.5, 2.5, 4.0}) {
      const WallSight sight = look(pipes(y_m, false), y_m, lidar);
      EXPECT_LE(sight.silent, kNoSilence) << y_m;
      EXPECT_NEAR(sight.open, 0.8, 0.05) << y_m;
      EXPECT_NEAR(sight.depth_m, 0.8, 0.06) << "bins of 5 cm";
    }
  }
}

// Props 0.2 m wide every 0.8 m: three quarters of the length are between them.
TEST(WallSight, ARowOfPropsIsOpen) {
  for (const Lidar& lidar : {kVlp16, kOs1, kOs0}) {
    for (const double y_m : {1.5, 2.0, 3.0}) {
      for (const bool dark : {false, true}) {
        RayScene scene = road();
        for (double x = -12.0; x < 12.0; x += 0.8) scene.add(side_panel(y_m, {x, x + 0.2}, kFull));
        const WallSight sight = look(scene.add(side_panel(y_m + 0.8, kEverywhere, kFull, dark)), y_m, lidar);
        EXPECT_GT(sight.open, dark ? 0.25 : 0.5) << y_m << (dark ? " dark" : " seen");
        if (dark) {
          EXPECT_GT(sight.silent, 0.2) << y_m;
        } else {
          EXPECT_LE(sight.silent, kNoSilence) << y_m;
        }
      }
    }
  }
}

// A box with a lid, before a wall that is seen or too dark.
TEST(WallSight, AConveyorIsOpenOverItsTop) {
  for (const Lidar& lidar : {kVlp16, kOs1, kOs0}) {
    for (const double top_m : {-0.2, 0.2}) {
      for (const bool dark : {false, true}) {
        SCOPED_TRACE(::testing::Message() << top_m << (dark ? " dark" : " seen"));
        RayScene scene = road();
        scene.add(side_panel(1.6, kEverywhere, {test::kFloorZ_m, top_m}));
        scene.add(Panel{2, top_m, kEverywhere, {1.6, 2.2}, kEverywhere});
        const WallSight sight = look(scene.add(side_panel(2.6, kEverywhere, kFull, dark)), 1.6, lidar);
        EXPECT_EQ(sight.silent > 0.3, dark);
        EXPECT_GT(sight.open, 0.3);
      }
    }
  }
}

TEST(WallSight, ARoadThatBranchesOffIsNoHole) {
  for (const double from_x_m : {-0.75, 0.3, 1.0}) {
    for (const double wide_m : {1.2, 1.5, 3.0}) {
      const double to_x_m = from_x_m + wide_m;
      RayScene scene = road();
      scene.add(side_panel(2.0, {-20.0, from_x_m}, kFull)).add(side_panel(2.0, {to_x_m, 20.0}, kFull));
      scene.add(cross_panel(from_x_m, {2.0, 8.0}, kFull)).add(cross_panel(to_x_m, {2.0, 8.0}, kFull));
      scene.add(side_panel(8.0, kEverywhere, kFull));
      for (const Lidar& lidar : {kVlp16, kOs1, kOs0}) {
        SCOPED_TRACE(::testing::Message() << from_x_m << " " << wide_m);
        const WallSight sight = look(scene, 2.0, lidar);
        expect_solid(sight);
        EXPECT_GT(sight.depth_m, 0.3) << "the road is there all the same";
      }
    }
  }
}

TEST(WallSight, OneNarrowGapDoesNotCountButSeveralDo) {
  for (const Lidar& lidar : {kVlp16, kOs1, kOs0}) {
    RayScene one = road(), several = road();
    one.add(side_panel(2.0, {-20.0, -0.3}, kFull)).add(side_panel(2.0, {0.3, 20.0}, kFull));
    for (double x = -10.2; x < 10.0; x += 1.7) several.add(side_panel(2.0, {x, x + 1.1}, kFull));
    const Panel behind = side_panel(3.0, kEverywhere, kFull);
    expect_solid(look(one.add(behind), 2.0, lidar));
    EXPECT_GT(look(several.add(behind), 2.0, lidar).open, 0.15) << "gaps of 0.6 m, a third of the length";
  }
}

TEST(WallSight, WhatStandsBeforeTheWallHidesIt) {
  RayScene scene = road();
  scene.add(side_panel(2.4, kEverywhere, kFull));
  scene.add(side_panel(1.2, {-0.4, 0.3}, {test::kFloorZ_m, 0.5})).add(side_panel(1.5, {0.8, 1.2}, kFull));
  for (const Lidar& lidar : {kVlp16, kOs1, kOs0}) expect_solid(look(scene, 2.4, lidar));
}

// A wet wall answers less, but all over; so does everything in dust.
TEST(WallSight, EvenLossIsNotSilence) {
  for (const Lidar& lidar : {kVlp16, kOs1, kOs0}) {
    for (const double lost_share : {0.1, 0.3, 0.5}) {
      SCOPED_TRACE(lost_share);
      expect_solid(thinned(lidar, lost_share, false));
      expect_solid(thinned(lidar, lost_share, true));
    }
    for (const double lost_share : {0.8, 0.9}) {
      const WallSight wet = thinned(lidar, lost_share, false);
      EXPECT_TRUE(wet.dim) << lost_share;
      EXPECT_EQ(wet.silent, 0.0) << lost_share;
      EXPECT_LE(thinned(lidar, lost_share, true).silent, kNoSilence) << "silent elsewhere too: " << lost_share;
    }
  }
}

TEST(WallSight, ABlockedSectorDoesNotCount) {
  for (const Lidar& lidar : {kVlp16, kOs1, kOs0}) {
    for (const double from_deg : {40.0, 70.0, 100.0}) {
      for (const double wide_deg : {5.0, 10.0, 20.0, 45.0}) {
        SCOPED_TRACE(::testing::Message() << wide_deg << " from " << from_deg);
        expect_solid(look(road().add(side_panel(2.0, kEverywhere, kFull)), 2.0, lidar, [&](const Eigen::Vector3d& ray) {
          const double azimuth_deg = std::atan2(ray.y(), ray.x()) * 180.0 / M_PI;
          return azimuth_deg > from_deg && azimuth_deg < from_deg + wide_deg;
        }));
      }
    }
  }
}

// A cloud of many scans: the shares are shares, however many returns there are of each.
TEST(WallSight, AccumulatedScansHaveTheSharesOfOne) {
  constexpr double kSame = 0.02;
  RayScene props = road();
  for (double x = -12.0; x < 12.0; x += 0.8) props.add(side_panel(2.0, {x, x + 0.2}, kFull));
  props.add(side_panel(2.8, kEverywhere, kFull));
  std::pair<const char*, RayScene> scenes[] = {{"solid", road().add(side_panel(2.0, kEverywhere, kFull))},
                                               {"pipes before a dark wall", pipes(2.0, true)},
                                               {"pipes", pipes(2.0, false)},
                                               {"props", props}};
  for (auto& [name, scene] : scenes) {
    const WallSight one = look(scene, 2.0, kVlp16);
    for (const std::uint32_t scans : {100U, 1000U}) {
      SCOPED_TRACE(::testing::Message() << name << ", " << scans << " scans");
      scene.set_accumulated(scans);
      const WallSight many = look(scene, 2.0, kVlp16);
      EXPECT_NEAR(many.silent, one.silent, kSame);
      EXPECT_NEAR(many.open, one.open, kSame);
      EXPECT_EQ(many.depth_m, one.depth_m);
      EXPECT_EQ(many.dim, one.dim);
    }
  }
}

TEST(WallSight, NothingIsSaidWhereNothingIsSeen) {
  for (const double y_m : {-2.0, 0.0, 2.0, 20.0}) expect_nothing(look(RayScene(), y_m, kOs0));
  expect_nothing(look(pipes(9.0, true), 9.0, kOs0));  // out of reach
  BandFixture placed;                                 // points, but no word of where the sensor looked
  placed.add_wall(2.0, test::kLongWall);
  expect_nothing(sight_of(&placed, 2.0));
}

TEST(WallSight, WildPointsLeaveSharesFromNoughtToOne) {
  BandFixture band;
  pipes(2.0, true).scan(kVlp16, &band);
  for (const double wild : {-1e30, -1e5, 1e-30, 1e5, 1e30}) {
    band.points().add(wild, 1.0, 0.0);
    band.points().add(0.0, wild, 0.0);
    band.beyond().add(1.0, 3.0, wild);
    band.count_return({wild, 1.0, 0.0});
    band.count_return({0.0, wild, 0.0});
    band.count_return({1.0, 3.0, wild});
  }
  for (const double distance_m : {-2.0, 0.0, 1e-12, 2.0, 1e6}) {
    const WallSight sight = sight_of(&band, distance_m);
    for (const double share : {sight.silent, sight.open}) {
      EXPECT_TRUE(share >= 0.0 && share <= 1.0) << share << " at " << distance_m;
    }
    EXPECT_TRUE(sight.depth_m >= 0.0 && sight.depth_m <= 10.0);
  }
}

}  // namespace
}  // namespace pose_wall
