// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what calls of the C ABI promise beside the numbers: results built afresh, caps, repeats, memory by points_max
// alone, empty clouds and those beyond what pointers reach. How much memory that is, checks.sizes compares. What is
// refused is in abi/refusals.

#include <gtest/gtest.h>

#include <cstring>

#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"
#include "support/room.hpp"

namespace pose_wall::test {
namespace {

// Whatever the result held before, every byte of it is written.
TEST(AbiCalls, AResultIsBuiltAfresh) {
  const Points points = road_grid();
  EngineUnderTest a(config_with()), b(config_with());
  const pose_wall_cloud cloud = cloud_of(points, 0);
  pose_wall_result clean{}, dirty;
  clean.struct_size = sizeof clean;
  std::memset(&dirty, 0xFF, sizeof dirty);
  dirty.struct_size = sizeof dirty;
  ASSERT_EQ(pose_wall_process(a.get(), &cloud, &clean), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_process(b.get(), &cloud, &dirty), POSE_WALL_OK);
  EXPECT_EQ(std::memcmp(&clean, &dirty, sizeof clean), 0);
}

TEST(AbiCalls, HypothesesStayWithinTheirCaps) {
  EngineUnderTest engine(config_with({{"ground_iterations", "60"}, {"wall_iterations", "50"}}));
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    const pose_wall_result r = engine.process(cloud_of(room_points(frame), 100000000LL * frame));
    EXPECT_EQ(r.floor.iterations, 60U);
    EXPECT_LE(r.left.iterations, 54U);
    EXPECT_LE(r.right.iterations, 54U);
    EXPECT_GT(r.left.iterations, 50U) << "along the other wall";
  }
}

// Repeats under an old stamp are no frozen sensor, but they count when the next one has a new stamp.
TEST(AbiCalls, RepeatsUnderOldStampsCountForFrozenFrames) {
  const Points last = room_points(1);
  for (const int still : {0, 1, 2}) {
    EngineUnderTest engine(config_with({{"frozen_frames", "2"}}));
    engine.process(cloud_of(room_points(0), 0));
    engine.process(cloud_of(last, 100000000));
    for (int i = 0; i < still; ++i) {
      EXPECT_EQ(engine.process(cloud_of(last, 100000000)).frame_reasons & POSE_WALL_R_FROZEN, 0U);
    }
    const pose_wall_result r = engine.process(cloud_of(last, 200000000));
    EXPECT_NE(r.frame_reasons & POSE_WALL_R_FROZEN, 0U);
    EXPECT_EQ(r.quantity[POSE_WALL_ROLL].state,
              static_cast<std::uint32_t>(still < 2 ? POSE_WALL_DEGRADED : POSE_WALL_HELD))
        << still;
  }
}

TEST(AbiCalls, MemoryHangsOnPointsMaxOnly) {
  const auto needed = [](const pose_wall_config& config) {
    std::uint64_t bytes = 0;
    EXPECT_EQ(pose_wall_memory_needed(&config, &bytes), POSE_WALL_OK);
    return bytes;
  };
  const std::uint64_t usual = needed(config_with());
  EXPECT_EQ(needed(config_with({{"voxel_leaf", "0.02"}, {"wall_iterations", "2000"}, {"forward_axis", "-Y"}})), usual);
  EXPECT_GT(needed(config_with({{"points_max", "120000"}})), usual);
  EXPECT_LT(needed(config_with({{"points_max", "5000"}})), usual);
  // Both ends of the range open.
  for (const char* points_max : {"5000", "400000"}) EngineUnderTest engine(config_with({{"points_max", points_max}}));
}

TEST(AbiCalls, AnEmptyCloudIsNoError) {
  EngineUnderTest engine(config_with());
  const pose_wall_result r = engine.process(cloud_of(Points(), 123));
  EXPECT_EQ(r.points_in, 0U);
  EXPECT_EQ(r.stamp_ns, 123);
  EXPECT_NE(r.frame_reasons & POSE_WALL_R_NO_POINTS, 0U);
  EXPECT_EQ(r.confidence, 0.0);
  for (const pose_wall_value& v : r.quantity) EXPECT_EQ(v.state, static_cast<std::uint32_t>(POSE_WALL_INVALID));
}

// 2^26 points of 128 bytes are 2^33 bytes: 0 with pointers of 32 bits, where reading would begin again at the start.
TEST(AbiCalls, CloudsBeyondWhatPointersReach) {
  static const float one[3] = {};
  pose_wall_cloud cloud;
  ASSERT_EQ(pose_wall_cloud_xyz32(&cloud, one, 1U << 26, 128, 0), POSE_WALL_OK);
  const std::int32_t status = sizeof(void*) == 4 ? POSE_WALL_E_CLOUD_SIZE : POSE_WALL_OK;
  EXPECT_EQ(pose_wall_cloud_check(&cloud), status);
}

}  // namespace
}  // namespace pose_wall::test
