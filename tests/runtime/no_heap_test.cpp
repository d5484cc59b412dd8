// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: after start no thread of the runtime, nor any call into it, allocates or frees: frames good and bad,
// overload, silence, records. Counts in all threads, and counts itself first.

#include <gtest/gtest.h>

#include <cstdlib>

#include "apps/soak/heap_count.hpp"
#include "support/runtime_under_test.hpp"

namespace pose_wall::test {
namespace {

using tools::start_counting_heap_calls;
using tools::stop_counting_heap_calls;

std::int32_t to_nowhere(void* /*user*/, std::uint64_t /*offset*/, const void* /*bytes*/, std::uint64_t /*count*/) {
  return 0;
}

TEST(RuntimeNoHeap, NothingAfterStart) {
  if (!tools::heap_calls_are_counted()) GTEST_SKIP() << "a sanitizer has its own malloc";
  start_counting_heap_calls();
  void* volatile block = std::malloc(100);
  std::free(block);
  ASSERT_GE(stop_counting_heap_calls(), 2U) << "the counter does not count";

  const pose_wall_config config = small_config();
  StandingClock clock;
  pose_wall_runtime_options options;
  pose_wall_runtime_options_init(&options);
  options.cloud_points_max = 30000;
  options.clock = StandingClock::read;
  options.clock_user = &clock;
  options.sink = to_nowhere;
  options.box_bytes = 8 << 20;
  std::uint64_t bytes = 0;
  ASSERT_EQ(pose_wall_runtime_memory_needed(&config, &options, &bytes), POSE_WALL_OK);
  AlignedBlock memory(bytes, Dirt::kRandom);
  pose_wall_runtime* r = nullptr;
  ASSERT_EQ(pose_wall_runtime_open(&config, &options, memory.data(), bytes, &r), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_runtime_start(r), POSE_WALL_OK);
  const Points room = room_points(1), few(3, {1, 1, 1});
  pose_wall_publication p{};
  pose_wall_runtime_statistics s{};
  pose_wall_image image{};
  p.struct_size = sizeof p;
  image.struct_size = sizeof image;
  s.struct_size = sizeof s;

  start_counting_heap_calls();
  for (std::int64_t i = 0; i < 50; ++i) {
    pose_wall_cloud cloud = cloud_of(i % 3 == 0 ? few : room, i * kMs);
    if (i % 10 == 9) cloud.data_bytes = 1;
    (void)pose_wall_runtime_push(r, &cloud);
    if (i % 4 == 0) (void)pose_wall_runtime_wait_idle(r);
    clock.advance(400 * kMs);
    (void)pose_wall_runtime_tick(r);
    (void)pose_wall_runtime_latest(r, &p);
    (void)pose_wall_runtime_image(r, &image);
    (void)pose_wall_runtime_statistics_now(r, &s);
  }
  (void)pose_wall_runtime_wait_idle(r);
  EXPECT_EQ(stop_counting_heap_calls(), 0U);
  (void)pose_wall_runtime_statistics_now(r, &s);
  EXPECT_GT(s.processed, 10U);
  EXPECT_GT(s.silences, 0U);
  EXPECT_GT(s.box_written, 10U);
  EXPECT_TRUE(accounts_balance(s));
  EXPECT_EQ(pose_wall_runtime_stop(r), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_runtime_close(r), POSE_WALL_OK);
}

}  // namespace
}  // namespace pose_wall::test
