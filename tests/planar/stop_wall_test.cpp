// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the stop takes for walls and what for people: rock, bends, niches, and people who come out of them.

#include <gtest/gtest.h>

#include "planar/encounter/mount_table.hpp"
#include "planar/encounter/standing.hpp"

namespace {

using namespace pose_wall::test;

bool is_nearing(const pose_wall_planar_stop_result& r) {
  return (r.reasons & POSE_WALL_PLANAR_STOP_R_NEARING) != 0;
}

Thing box(double x_m, double y_m, double half_x_m, double half_y_m) {
  return {x_m, y_m, 0.0, half_x_m, half_y_m, -0.1, 3.0};
}

// Walls behind the machine and round the bend come into sight all the time.
TEST(StopWall, BendsAreDriven) {
  for (const char* name : {"vlp16-front-1.35-10", "os1_64-front-1.35-15"}) {
    const pose_wall::test::Mount mount = mounts_named(name).front();
    for (const std::uint64_t seed : {22U, 23U}) {
      Draw draw(seed);
      const Plan plan = clear_road(mount, Road::curve, false, false, &draw);
      StopUnderTest stop;
      const pose_wall_planar_stop_settings settings = settings_of(mount);
      const Outcome out = Encounter(plan, settings, &stop, &draw).run();
      EXPECT_LE(out.stops, 2U) << name << " " << seed;
      EXPECT_GT(out.moved_m, 50.0) << name << " " << seed;
    }
  }
}

// Blocks of rock are as deep as people are thick.
TEST(StopWall, ARoadOfRockIsDriven) {
  const pose_wall::test::Mount mount = mounts_named("os1_64-front-1.35-15").front();
  constexpr std::uint64_t kKinds = 4;  // of rock, by the seed
  double moved_m = 0.0;
  std::uint32_t stops = 0;
  for (std::uint64_t seed = 0; seed < kKinds; ++seed) {
    Draw draw(seed + 31);
    Plan plan = clear_road(mount, Road::straight, false, false, &draw);
    plan.world.rock = std::make_shared<Rock>(seed);
    plan.lasts_s = 30.0;
    StopUnderTest stop;
    const pose_wall_planar_stop_settings settings = settings_of(mount);
    const Outcome out = Encounter(plan, settings, &stop, &draw).run();
    stops += out.stops, moved_m += out.moved_m;
  }
  EXPECT_LE(stops, 6U);
  EXPECT_GT(moved_m, 85.0);  // of 4 runs of 27 m at most
}

// Who stands in a niche is of the rock as long as they are in it. They count once they stand out of its line, before
// they can reach the front edge until the machine stands.
TEST(StopWall, WhoComesOutOfANicheCountsBeforeTheyAreNear) {
  // As deep as a wall's line allows, wide enough for a person, and in the sensor's sight, which ends 57 degrees aside.
  constexpr double kHalfWidth_m = 2.8, kDeep_m = 0.5, kRadius_m = 0.2, kLine_m = kHalfWidth_m - kDeep_m;
  constexpr double kNiche_m = 4.0, kHalfNiche_m = 0.4, kBlock_m = 1.5;  // blocks longer than a line's metre
  for (const double walks_m_s : {0.3, 1.0, 1.6}) {
    World world = plain_road(kHalfWidth_m);
    for (const double side : {-1.0, 1.0}) {
      world.things.push_back(
          box(kNiche_m + side * (kHalfNiche_m + kBlock_m), kHalfWidth_m - 0.5 * kDeep_m, kBlock_m, 0.5 * kDeep_m));
    }
    world.things.push_back(round_thing(kNiche_m, kHalfWidth_m - kRadius_m - 0.05, kRadius_m, -0.1, 1.8));
    Standing standing(world);
    standing.frames(40);
    Thing& person = standing.world().things.back();
    std::uint32_t counted = 0;
    while (person.y_m > 1.0) {
      person.y_m -= 0.1 * walks_m_s;
      const auto result = standing.frame();
      // What the line gives away, and a place of the rock and one of the person.
      constexpr double kChest_m = 0.23, kPlaces_m = 0.2;
      if (kLine_m - (person.y_m - kRadius_m) < kChest_m + kPlaces_m + 0.1 * walks_m_s) continue;
      ++counted;
      // From a stop that is known to stand: in 0.45 s + v / a, as far as it has driven then.
      const double v_m_s = result.stop_speed_m_s, drives_m = 0.45 * v_m_s + 0.5 * v_m_s * v_m_s;
      const double ahead_m = std::fmax(kNiche_m - 2.25 - drives_m, 0.0);
      EXPECT_LE(1.6 * (0.45 + v_m_s), std::hypot(ahead_m, person.y_m - 0.6) - kRadius_m)
          << walks_m_s << " " << person.y_m;
    }
    EXPECT_GT(counted, 3U);
  }
}

TEST(StopWall, PeopleWhoComeAbreastAreNoWall) {
  World world = plain_road();
  for (const double y : {-0.9, -0.45, 0.0, 0.45, 0.9}) world.things.push_back(round_thing(9.0, y, 0.2, -0.1, 1.8));
  Standing standing(world);
  standing.frames(40);  // they may be a wall as long as they stand
  for (int k = 0; k < 45; ++k) {
    for (Thing& person : standing.world().things) person.x_m -= 0.1;
    const auto result = standing.frame();
    if (k < 20) continue;  // further than 7 m away
    EXPECT_TRUE(is_nearing(result)) << k;
  }
}

// From standstill in an unknown road, where all is seen.
TEST(StopWall, TheFirstMetreTakesNoMoreThanThreeSeconds) {
  for (const char* name : {"vlp16-front-1.35-10", "os1_64-front-1.35-15"}) {
    const pose_wall::test::Mount mount = mounts_named(name).front();
    Draw draw(9);
    Plan plan = clear_road(mount, Road::straight, false, false, &draw);
    plan.lasts_s = 6.0;
    StopUnderTest stop;
    const pose_wall_planar_stop_settings settings = settings_of(mount);
    EXPECT_LE(Encounter(plan, settings, &stop, &draw).run().first_metre_s, 3.0) << name;
  }
}

// Whichever way the wall goes: a line that begins at a chest and ends on the wall is no wall.
TEST(StopWall, APersonBesideASlantingWallIsNoEndOfIt) {
  constexpr double kWall_m = 2.4;  // near enough that whoever stands there can reach the machine
  for (const double slant_rad : {0.1, 0.2, 0.3}) {
    for (const double radius_m : {0.17, 0.25}) {
      for (const double gap_m : {0.0, 0.2}) {
        const bool leans_thin = gap_m == 0.0 && radius_m < 0.2;  // a limit, which the README of the stop tells
        if (leans_thin) continue;
        World world = plain_road(kWall_m);
        world.things.push_back(round_thing(3.5, kWall_m - radius_m - gap_m, radius_m, -0.1, 1.7));
        Standing standing(world);
        standing.turn(slant_rad);
        standing.frames(40);  // longer than a thing needs to settle
        for (int k = 0; k < 20; ++k) {
          EXPECT_NE(standing.frame().reasons & POSE_WALL_PLANAR_STOP_R_NEARING, 0U)
              << slant_rad << " " << radius_m << " " << gap_m;
        }
      }
    }
  }
}

}  // namespace
