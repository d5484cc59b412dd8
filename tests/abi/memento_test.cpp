// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: with what was saved before a frame another engine computes that frame to the same bits, whatever came before
// it; and a memento that is damaged in any one bit, or of another config, is refused and changes nothing.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstring>
#include <vector>

#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"
#include "support/moments.hpp"
#include "support/room.hpp"

namespace pose_wall::test {
namespace {

using Memento = std::vector<unsigned char>;

Memento save(EngineUnderTest* engine) {
  Memento memento(pose_wall_memento_bytes());
  EXPECT_EQ(pose_wall_save(engine->get(), nullptr, memento.data(), memento.size()), POSE_WALL_OK);
  return memento;
}

std::int32_t load(EngineUnderTest* engine, const Memento& memento) {
  return pose_wall_load(engine->get(), &pose_wall::test::kSameClock, memento.data(), memento.size());
}

// Frames, gaps, a frozen sensor, stamps that stand still, jump back and leap.
TEST(Memento, AnyFrameCanBeComputedAgain) {
  EngineUnderTest all(small_config());
  const std::int64_t stamps_ms[] = {0, 100, 200, 200, 300, 250, 350, 5000, 5100, 5200, 5300};
  std::uint32_t at = 0;
  for (const std::int64_t ms : stamps_ms) {
    ++at;
    const bool silent = at == 4 || at == 10;
    const Points points = silent ? Points() : room_points(at == 7 ? 6 : at);
    const pose_wall_cloud cloud = cloud_of(points, ms * 1000000);
    const Memento before = save(&all);
    const pose_wall_result expected = all.process(cloud);
    EngineUnderTest other(small_config());
    ASSERT_EQ(load(&other, before), POSE_WALL_OK);
    const pose_wall_result again = other.process(cloud);
    EXPECT_EQ(std::memcmp(&expected, &again, sizeof again), 0) << "frame " << at;
    EXPECT_EQ(save(&other), save(&all));
  }
}

// More voxels than there is room for, far fewer, and more again: each frame begins with the leaf of the one before.
TEST(Memento, TheLeafOfTheLastFrameIsInIt) {
  pose_wall_config config = small_config();
  set(&config, "points_max", "5000");
  EngineUnderTest all(config);
  const std::size_t one_of[] = {1, 1, 3, 3, 3, 3, 1, 2, 2, 2, 2, 9, 9};
  std::int64_t stamp_ns = 0;
  int grown = 0, from_the_past = 0;
  for (const std::size_t every : one_of) {
    const Points whole = room_points(static_cast<std::uint32_t>(every));
    Points points;
    for (std::size_t i = 0; i < whole.size(); i += every) points.push_back(whole[i]);
    const pose_wall_cloud cloud = cloud_of(points, stamp_ns += 100000000);
    const Memento before = save(&all);
    const pose_wall_result expected = all.process(cloud);
    EngineUnderTest other(config), fresh(config);
    ASSERT_EQ(load(&other, before), POSE_WALL_OK);
    const pose_wall_result again = other.process(cloud);
    EXPECT_EQ(std::memcmp(&expected, &again, sizeof again), 0) << stamp_ns;
    EXPECT_EQ(save(&other), save(&all));
    grown += (expected.frame_reasons & POSE_WALL_R_LEAF_GROWN) != 0 ? 1 : 0;
    from_the_past += fresh.process(cloud).voxels != expected.voxels ? 1 : 0;
  }
  EXPECT_GT(grown, 4);
  EXPECT_GT(from_the_past, 0) << "the leaf comes down by and by: else this test shows nothing";
}

struct TimedPoint {
  float x, y, z, time_s;
};

// What the last frame's floor and walls showed bounds the motion within the next scan.
TEST(Memento, WhatTwoFramesShowOfTheMotionWithinAScanIsInIt) {
  EngineUnderTest all(small_config());
  pose_wall_inputs inputs{};
  inputs.struct_size = sizeof inputs;
  inputs.given = POSE_WALL_INPUT_ODOMETRY;
  inputs.odometry.run = 7;
  inputs.odometry.quaternion[3] = inputs.odometry.along[0] = inputs.odometry.across[1] = 1.0;
  for (double& level : inputs.odometry.rate_level) level = 1.0;
  double first_level = 0.0;
  for (std::uint32_t frame = 1; frame <= 4; ++frame) {
    const Points points = room_points(frame);
    std::vector<TimedPoint> timed;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto share = static_cast<float>(i) / static_cast<float>(points.size());
      timed.push_back({points[i][0], points[i][1], points[i][2], 0.1F * share});
    }
    pose_wall_cloud cloud;
    ASSERT_EQ(pose_wall_cloud_xyz32(&cloud, timed.data(), static_cast<std::uint32_t>(timed.size()), sizeof(TimedPoint),
                                    frame * 100000000LL),
              POSE_WALL_OK);
    cloud.time = {offsetof(TimedPoint, time_s), POSE_WALL_FIELD_FLOAT32};
    cloud.inputs = &inputs;
    const Memento before = save(&all);
    const pose_wall_result expected = all.process(cloud);
    EngineUnderTest other(small_config());
    ASSERT_EQ(load(&other, before), POSE_WALL_OK);
    const pose_wall_result again = other.process(cloud);
    EXPECT_EQ(std::memcmp(&expected, &again, sizeof again), 0) << "frame " << frame;
    EXPECT_EQ(save(&other), save(&all));
    const double level = expected.quantity[POSE_WALL_ROLL].raw_protection_level;
    if (frame == 1) first_level = level;
    if (frame > 2) {
      EXPECT_LT(level, 0.5 * first_level) << "or the memory is of no use here";
    }
  }
}

// Without what came before, the second frame comes out otherwise: the test above can fail.
TEST(Memento, WithoutItTheSameFrameIsAnother) {
  EngineUnderTest all(small_config()), fresh(small_config());
  all.process(cloud_of(room_points(1), 0));
  const Points second = room_points(2);
  const pose_wall_result after = all.process(cloud_of(second, 100000000));
  const pose_wall_result alone = fresh.process(cloud_of(second, 100000000));
  EXPECT_NE(std::memcmp(&after.quantity, &alone.quantity, sizeof after.quantity), 0);
}

TEST(Memento, EveryFlippedBitIsFound) {
  EngineUnderTest engine(small_config()), other(small_config());
  engine.process(cloud_of(room_points(1), 0));
  const Memento good = save(&engine), fresh = save(&other);
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    Memento bad = good;
    bad[bit / 8] = static_cast<unsigned char>(bad[bit / 8] ^ (1U << bit % 8));
    ASSERT_EQ(load(&other, bad), POSE_WALL_E_MEMENTO) << "bit " << bit;
  }
  EXPECT_EQ(save(&other), fresh);
  EXPECT_EQ(load(&other, good), POSE_WALL_OK);
  Memento longer = good;
  longer.push_back(7);
  EXPECT_EQ(load(&other, longer), POSE_WALL_OK) << "what lies behind is not read";
}

// Another axis, another extrinsic: what was measured by it is no value of this engine.
TEST(Memento, OfAnotherConfigIsRefused) {
  EngineUnderTest engine(small_config());
  engine.process(cloud_of(room_points(1), 0));
  const Memento good = save(&engine);
  for (const test::KeyValue& change : {test::KeyValue{"forward_axis", "-X"}, test::KeyValue{"extrinsic_yaw", "0.1"},
                                       test::KeyValue{"alert_limit_distance", "0.2"}}) {
    pose_wall_config config = small_config();
    ASSERT_EQ(pose_wall_config_set(&config, change.first, change.second), POSE_WALL_OK);
    EngineUnderTest other(config);
    const Memento fresh = save(&other);
    EXPECT_EQ(load(&other, good), POSE_WALL_E_MEMENTO) << change.first;
    EXPECT_EQ(save(&other), fresh);
  }
  EngineUnderTest same(small_config());
  EXPECT_EQ(load(&same, good), POSE_WALL_OK);
}

}  // namespace
}  // namespace pose_wall::test
