// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a block in which a runtime runs is not opened over, whatever else it may hold; a reader of an earlier box is
// refused by its first call; a shorter publication is written no further than it reaches. Structs of other versions are
// in tests/abi/refusals.

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "runtime/struct_versions.hpp"
#include "support/runtime_under_test.hpp"

extern "C" std::int32_t first_call_of_box_1(const void* bytes, std::uint64_t count,
                                            void* info) __asm__("pose_wall_box_open");
extern "C" std::int32_t first_call_of_box_2(const void* bytes, std::uint64_t count,
                                            void* info) __asm__("pose_wall_box_open_2");

namespace pose_wall::test {
namespace {

struct OnABlock {
  OnABlock() : options(options_of_default()), block(needed(), Dirt::kRandom) {}
  static pose_wall_runtime_options options_of_default() {
    pose_wall_runtime_options o;
    pose_wall_runtime_options_init(&o);
    o.cloud_points_max = 30000;
    return o;
  }
  std::uint64_t needed() const {
    std::uint64_t bytes = 0;
    EXPECT_EQ(pose_wall_runtime_memory_needed(&config, &options, &bytes), POSE_WALL_OK);
    return bytes;
  }
  std::int32_t open(pose_wall_runtime** runtime) {
    return pose_wall_runtime_open(&config, &options, block.data(), block.size(), runtime);
  }

  pose_wall_config config = small_config();
  pose_wall_runtime_options options;
  AlignedBlock block;
};

TEST(RuntimeMisuse, ABlockInWhichARuntimeRunsIsNotOpenedOver) {
  OnABlock on;
  pose_wall_runtime* runtime = nullptr;
  ASSERT_EQ(on.open(&runtime), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_runtime_start(runtime), POSE_WALL_OK);
  const Points room = room_points(1);
  for (std::int64_t i = 0; i < 3; ++i) {
    pose_wall_runtime* other = nullptr;
    EXPECT_EQ(on.open(&other), POSE_WALL_E_BUSY);
    EXPECT_EQ(other, nullptr);
    const pose_wall_cloud cloud = cloud_of(room, i * 100 * kMs);
    EXPECT_EQ(pose_wall_runtime_push(runtime, &cloud), POSE_WALL_OK) << "it goes on";
    EXPECT_EQ(pose_wall_runtime_wait_idle(runtime), POSE_WALL_OK);
  }
  EXPECT_EQ(pose_wall_runtime_request_stop(runtime), POSE_WALL_OK);
  EXPECT_EQ(on.open(&runtime), POSE_WALL_E_BUSY) << "its threads are there until stop has come back";
  EXPECT_EQ(pose_wall_runtime_stop(runtime), POSE_WALL_OK);
  EXPECT_EQ(on.open(&runtime), POSE_WALL_OK) << "stopped, if not closed";
  EXPECT_EQ(pose_wall_runtime_start(runtime), POSE_WALL_OK);
  EXPECT_EQ(on.open(&runtime), POSE_WALL_E_BUSY);
  EXPECT_EQ(pose_wall_runtime_stop(runtime), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_runtime_close(runtime), POSE_WALL_OK);
  EXPECT_EQ(on.open(&runtime), POSE_WALL_OK);
}

// Copied elsewhere its bytes say that it runs, but of another place.
TEST(RuntimeMisuse, ACopyOfARunningOneIsGarbage) {
  OnABlock on, other;
  pose_wall_runtime* runtime = nullptr;
  ASSERT_EQ(on.open(&runtime), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_runtime_start(runtime), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_runtime_stop(runtime), POSE_WALL_OK);
  std::memcpy(other.block.data(), on.block.data(), other.block.size());
  pose_wall_runtime* placed = nullptr;
  EXPECT_EQ(other.open(&placed), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_runtime_start(placed), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_runtime_stop(placed), POSE_WALL_OK);
}

TEST(RuntimeMisuse, AReaderOfAnEarlierBoxIsRefusedByItsFirstCall) {
  EXPECT_EQ(first_call_of_box_1(nullptr, 0, nullptr), POSE_WALL_E_ABI) << "its record is shorter";
  EXPECT_EQ(first_call_of_box_2(nullptr, 0, nullptr), POSE_WALL_E_ABI) << "and so is that of format 2";
}

// Who was built with an earlier header gets what he has room for, and results whose sizes say how much of them he has.
TEST(RuntimeMisuse, AShorterPublicationIsWrittenNoFurtherThanItReaches) {
  pose_wall_publication whole{}, to;
  whole.struct_size = sizeof whole;
  whole.index = 7;
  whole.result.struct_size = sizeof whole.result;
  whole.result.wall_points = 9;
  whole.motion.struct_size = sizeof whole.motion;
  whole.motion.source_id = 3;
  std::memset(&to, 0x55, sizeof to);
  whole.odometry.run = 5;
  constexpr auto kOdometryAt = static_cast<std::uint32_t>(offsetof(pose_wall_publication, odometry));
  const auto shorter = kOdometryAt - 8;
  runtime::write_publication(whole, shorter, &to);
  EXPECT_EQ(to.struct_size, shorter);
  EXPECT_EQ(to.motion.struct_size, sizeof to.motion - 8);
  EXPECT_EQ(to.index, 7U);
  EXPECT_EQ(to.motion.source_id, 0x55555555U) << "behind the end";
  runtime::write_publication(whole, kOdometryAt, &to);
  EXPECT_EQ(to.motion.struct_size, sizeof to.motion);
  EXPECT_EQ(to.motion.source_id, 3U);
  EXPECT_EQ(to.odometry.run, 0x5555555555555555U) << "behind the end";
  runtime::write_publication(whole, sizeof whole, &to);
  EXPECT_EQ(to.motion.struct_size, sizeof to.motion);
  EXPECT_EQ(to.odometry.run, 5U);
  std::memset(&to, 0x55, sizeof to);
  runtime::write_publication(whole, offsetof(pose_wall_publication, has_motion), &to);
  EXPECT_EQ(to.result.struct_size, sizeof to.result);
  EXPECT_EQ(to.result.wall_points, 9U);
  EXPECT_EQ(to.has_motion, 0x55555555U) << "behind the end";
}

}  // namespace
}  // namespace pose_wall::test
