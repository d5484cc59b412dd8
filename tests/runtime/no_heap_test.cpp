// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: after start no thread of the runtime, nor any call into it, allocates or frees: frames good and bad,
// overload, silence, records. Counts in all threads, and counts itself first.

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

#include "support/runtime_under_test.hpp"

#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
#define POSE_WALL_OWN_MALLOC 0  // theirs must not be replaced; the release build counts
#else
#define POSE_WALL_OWN_MALLOC 1
#endif

namespace {
std::atomic<bool> counting{false};
std::atomic<int> calls{0};

[[maybe_unused]] void count_call() {
  if (counting.load(std::memory_order_relaxed)) calls.fetch_add(1, std::memory_order_relaxed);
}
}  // namespace

#if POSE_WALL_OWN_MALLOC
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void __libc_free(void* block);

void* malloc(std::size_t size) {
  count_call();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  count_call();
  return __libc_calloc(count, size);
}
void* realloc(void* block, std::size_t size) {
  count_call();
  return __libc_realloc(block, size);
}
void free(void* block) {
  count_call();
  __libc_free(block);
}
}
#endif

namespace pose_wall::test {
namespace {

std::int32_t to_nowhere(void* /*user*/, std::uint64_t /*offset*/, const void* /*bytes*/, std::uint64_t /*count*/) {
  return 0;
}

TEST(RuntimeNoHeap, NothingAfterStart) {
  if (POSE_WALL_OWN_MALLOC == 0) GTEST_SKIP() << "a sanitizer has its own malloc";
  counting = true;
  void* volatile block = std::malloc(100);
  std::free(block);
  counting = false;
  ASSERT_GE(calls.exchange(0), 2) << "the counter does not count";

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
  p.struct_size = sizeof p;
  s.struct_size = sizeof s;

  counting = true;
  for (std::int64_t i = 0; i < 50; ++i) {
    pose_wall_cloud cloud = cloud_of(i % 3 == 0 ? few : room, i * kMs);
    if (i % 10 == 9) cloud.data_bytes = 1;
    pose_wall_runtime_push(r, &cloud);
    if (i % 4 == 0) pose_wall_runtime_wait_idle(r);
    clock.advance(400 * kMs);
    pose_wall_runtime_tick(r);
    pose_wall_runtime_latest(r, &p);
    pose_wall_runtime_statistics_now(r, &s);
  }
  pose_wall_runtime_wait_idle(r);
  counting = false;
  pose_wall_runtime_statistics_now(r, &s);
  EXPECT_EQ(calls, 0);
  EXPECT_GT(s.processed, 10U);
  EXPECT_GT(s.silences, 0U);
  EXPECT_GT(s.box_written, 10U);
  EXPECT_TRUE(accounts_balance(s));
  EXPECT_EQ(pose_wall_runtime_stop(r), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_runtime_close(r), POSE_WALL_OK);
}

}  // namespace
}  // namespace pose_wall::test
