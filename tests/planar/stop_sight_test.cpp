// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/stop/places.hpp"
#include "planar/stop/sight.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "planar/encounter/plans.hpp"
#include "support/aligned_block.hpp"

namespace {

using namespace pose_wall;
using namespace pose_wall::planar;
using namespace pose_wall::test;

class SightUnderTest {
 public:
  SightUnderTest() : block_(bytes(), pose_wall::test::Dirt::kRandom) {
    Arena arena(block_.data());
    sight_ = arena.take_one<Sight>();
    sight_->lay_out(arena);
    settings_ = default_settings<StopTable>();
  }

  // One frame of a sensor at rest in a world; the same draws give the same rays.
  const Sight& look(Sensor sensor, const World& world, std::uint64_t seed) {
    Draw draw(seed);
    scan_.take(sensor, world, 0.0, 0.0, 0.0, 0.0, 0.0, &draw);
    mount_ = Mount();
    mount_.R_base_lidar = sensor.R();
    mount_.sensor_base_m = {sensor.x_m, 0.0, sensor.z_m};
    mount_.range_min_m = 0.3, mount_.range_max_m = 100.0;
    const pose_wall_cloud cloud = scan_.cloud(1);
    const Rays rays(cloud, mount_);
    auto looks = std::make_unique<FloorLooks>();
    ground_ = pose_wall::planar::find_ground(rays, mount_, settings_, looks.get());
    sight_->open(settings_, mount_);
    pose_wall::CloudPrint print;
    used_ = sight_->look(rays, ground_, &print);
    return *sight_;
  }
  bool returns_near(double x, double y, double within_m) const {
    bool found = false;
    sight_->each_return([&](const Sight::Return& r) {
      const double dx = static_cast<double>(r.x) + mount_.sensor_base_m.x() - x, dy = static_cast<double>(r.y) - y;
      found = found || dx * dx + dy * dy < within_m * within_m;
    });
    return found;
  }
  std::uint8_t seen(double x, double y) const {
    const auto dx = static_cast<float>(x - mount_.sensor_base_m.x()), dy = static_cast<float>(y);
    return static_cast<std::uint8_t>(sight_->seen(pose_wall::all_four(dx), pose_wall::all_four(dy))[0]);
  }
  const Ground& ground() const { return ground_; }
  std::uint32_t used() const { return used_; }

 private:
  static std::uint64_t bytes() {
    Arena arena(nullptr);
    arena.take_one<Sight>();
    Sight measured;
    measured.lay_out(arena);
    return arena.bytes();
  }

  pose_wall::test::AlignedBlock block_;
  Sight* sight_ = nullptr;
  Scan scan_;
  StopSettings settings_;
  Mount mount_;
  Ground ground_;
  std::uint32_t used_ = 0;
};

World flat() {
  World world;
  world.floor_wave_m = 0.0, world.floor_rough_m = 0.0;
  return world;
}

Sensor os1() {
  Sensor sensor(Pattern::os1_64, 2.0, 1.6, 0.0, 0.28, 1.5, 0);
  sensor.noise_m = 0.0, sensor.dropout = 0.0;
  return sensor;
}

TEST(StopSight, AClearFloorIsSeenAndWhatAThingHidesIsNot) {
  SightUnderTest test;
  World world = flat();
  test.look(os1(), world, 1);
  EXPECT_TRUE(test.ground().seen);
  EXPECT_NEAR(test.ground().height_m, 0.0, 0.01);
  for (const double x : {4.2, 5.0, 6.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) EXPECT_EQ(test.seen(x, y), Sight::kAll) << x << " " << y;
  }
  world.things.push_back(round_thing(4.0, 0.0, 0.3, -0.1, 1.7));
  test.look(os1(), world, 1);
  EXPECT_EQ(test.seen(5.0, 0.0) & (Sight::kLow | Sight::kTall), 0);  // rays go over their head
  EXPECT_EQ(test.seen(5.0, 1.5), Sight::kAll);
  EXPECT_TRUE(test.returns_near(3.7, 0.0, 0.15));
}

TEST(StopSight, WithoutReturnsNothingIsSeen) {
  SightUnderTest test;
  World world = flat();
  Sensor dirty = os1();
  dirty.dirt_from_rad = -0.15, dirty.dirt_to_rad = 0.15;
  test.look(dirty, world, 1);
  EXPECT_EQ(test.seen(4.0, 0.0), 0);
  EXPECT_EQ(test.seen(4.2, 1.5), Sight::kAll);
  // A puddle that swallows the rays, and one that mirrors the roof.
  for (const bool mirrors : {false, true}) {
    world.puddles = {{4.0, 6.5, -1.0, 1.0, mirrors}};
    test.look(os1(), world, 1);
    EXPECT_EQ(test.seen(5.5, 0.0) & Sight::kLow, 0) << mirrors;
    EXPECT_NE(test.seen(4.0, 1.5) & Sight::kLow, 0) << mirrors;
  }
  Sensor dead = os1();
  dead.dropout = 1.1;
  test.look(dead, world, 1);
  EXPECT_EQ(test.used(), 0U);
  EXPECT_EQ(test.seen(4.0, 0.0), 0);
}

TEST(StopSight, APuddleShorterThanTheShadowOfTheSmallestThingIsNoGap) {
  SightUnderTest test;
  World world = flat();
  world.puddles = {{4.3, 4.5, -1.0, 1.0, false}};
  test.look(os1(), world, 1);
  for (double x = 4.1; x < 5.0; x += 0.1) EXPECT_NE(test.seen(x, 0.0) & Sight::kLow, 0) << x;
}

// Steps of azimuth: each is met, in order, and none is wider than what the rule of silence counts with.
TEST(StopSight, StepsOfAzimuthAreEven) {
  constexpr std::uint32_t kDirections = 400000;
  constexpr double kTurn_rad = 6.283185307179586;
  std::vector<std::uint32_t> met(pose_wall::planar::kAzimuths, 0);
  std::uint32_t changes = 0, before = 0;
  for (std::uint32_t k = 0; k < kDirections; ++k) {
    const double angle = (k + 0.5) * kTurn_rad / kDirections;
    const std::uint32_t a =
        Sight::azimuth_of(static_cast<float>(3.0 * std::cos(angle)), static_cast<float>(3.0 * std::sin(angle)));
    ASSERT_LT(a, pose_wall::planar::kAzimuths);
    ++met[a];
    changes += k > 0 && a != before ? 1U : 0U;
    before = a;
  }
  EXPECT_LE(changes, pose_wall::planar::kAzimuths);
  for (const std::uint32_t count : met) {
    EXPECT_LE((count - 1) * kTurn_rad / kDirections, pose_wall::planar::kAzimuthMost_rad);
    EXPECT_GE((count + 1) * kTurn_rad / kDirections, 0.0114);
  }
}

// Straight ahead as well, where a column of a coarse sensor has its place beside a step of azimuth.
TEST(StopSight, NoPlaceAheadLiesBetweenTwoColumns) {
  SightUnderTest test;
  for (const std::uint32_t columns : {600U, 900U, 1800U}) {
    Sensor sensor(Pattern::vlp16, 2.0, 1.45, 0.0, 0.18, 1.25, columns);
    sensor.noise_m = sensor.dropout = 0.0;
    test.look(sensor, flat(), 1);
    for (const double x : {4.9, 5.0, 5.1, 5.2}) {
      for (double y = -0.9; y < 0.95; y += 0.05) {
        EXPECT_NE(test.seen(x, y) & Sight::kLow, 0) << columns << " " << x << " " << y;
      }
    }
  }
}

// What "seen" means: had the smallest thing been there, a ray would have hit it above the floor's band. Likewise a
// person for what is seen tall.
TEST(StopSight, WhereAPlaceIsSeenAThingWouldHaveReturned) {
  SightUnderTest test;
  Draw draw(5);
  std::uint32_t lows = 0, talls = 0;
  for (int k = 0; k < 90; ++k) {
    World world = flat();
    Sensor sensor =
        k % 3 == 0 ? os1() : Sensor(Pattern::vlp16, 2.0, draw.within(1.3, 1.7), 0.0, draw.within(0.3, 0.6), 1.2, 900);
    if (k % 3 == 2) sensor = Sensor(Pattern::mid360, 2.0, draw.within(1.3, 1.7), 3.14159265, 0.0, 1.2, 0);
    sensor.noise_m = 0.0, sensor.dropout = draw.within(0.0, 0.6);
    for (int p = 0; p < 8; ++p) {
      const double x = 2.4 + draw.within(0.0, 4.0), y = draw.within(-1.8, 1.8);
      world.things.clear();
      const std::uint64_t seed = 1000U + static_cast<std::uint64_t>(k);
      const std::uint8_t seen = (test.look(sensor, world, seed), test.seen(x, y));
      if (seen == 0) continue;
      const bool is_low = (seen & Sight::kLow) != 0;
      world.things.push_back(round_thing(x, y, 0.15, -0.1, is_low ? 0.3 : 1.4));
      test.look(sensor, world, seed);
      EXPECT_TRUE(test.returns_near(x, y, 0.3)) << k << " " << x << " " << y << " " << is_low;
      ++(is_low ? lows : talls);
    }
  }
  EXPECT_GT(lows, 200U);
  EXPECT_GT(talls, 5U);
}

TEST(StopSight, TheFloorIsFoundOnASlopeAndBesideAHeap) {
  SightUnderTest test;
  World world;
  world.floor_wave_m = 0.25, world.floor_length_m = 40.0, world.floor_phase = 0.0;  // 2.2 degrees
  world.things.push_back(round_thing(4.5, 1.2, 0.5, -0.5, 0.4));
  test.look(os1(), world, 3);
  EXPECT_TRUE(test.ground().seen);
  EXPECT_NEAR(test.ground().slope_x, 0.036, 0.012);
}

}  // namespace
