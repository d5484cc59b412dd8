// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: start and stop from any state and thread come back, what would wait for itself is refused, every frame is
// accounted for across stops, and the block is free after close. Storms show no data race under ThreadSanitizer.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "support/runtime_under_test.hpp"

namespace pose_wall::test {
namespace {

const Points& few() {
  static const Points points(3, {1, 1, 1});
  return points;
}

TEST(RuntimeLife, StatesAndWhatTheyAllow) {
  RuntimeUnderTest runtime;
  pose_wall_runtime* const r = runtime.get();
  pose_wall_publication p{};
  p.struct_size = sizeof p;
  EXPECT_EQ(runtime.push(few(), 0), POSE_WALL_RUNTIME_E_STATE);
  EXPECT_EQ(pose_wall_runtime_latest(r, &p), POSE_WALL_RUNTIME_E_STATE);
  EXPECT_EQ(pose_wall_runtime_wait_idle(r), POSE_WALL_RUNTIME_E_STATE);
  EXPECT_EQ(pose_wall_runtime_tick(r), POSE_WALL_RUNTIME_E_STATE);
  EXPECT_EQ(pose_wall_runtime_request_stop(r), POSE_WALL_RUNTIME_E_STATE);
  EXPECT_EQ(pose_wall_runtime_stop(r), POSE_WALL_OK) << "stopped already";
  EXPECT_EQ(runtime.statistics().pushed, 0U);
  runtime.start();
  EXPECT_EQ(pose_wall_runtime_start(r), POSE_WALL_RUNTIME_E_STATE);
  EXPECT_EQ(pose_wall_runtime_close(r), POSE_WALL_RUNTIME_E_STATE);
  EXPECT_EQ(runtime.statistics().state, static_cast<std::uint32_t>(POSE_WALL_RUNTIME_RUNNING));
  EXPECT_EQ(pose_wall_runtime_request_stop(r), POSE_WALL_OK);
  EXPECT_EQ(runtime.push(few(), 0), POSE_WALL_RUNTIME_E_STATE);
  EXPECT_EQ(pose_wall_runtime_close(r), POSE_WALL_RUNTIME_E_STATE);
  EXPECT_EQ(pose_wall_runtime_stop(r), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_runtime_stop(r), POSE_WALL_OK);
  EXPECT_EQ(runtime.statistics().state, static_cast<std::uint32_t>(POSE_WALL_RUNTIME_STOPPED));
}

TEST(RuntimeLife, ClosedIsClosed) {
  const pose_wall_config config = small_config();
  pose_wall_runtime_options options;
  pose_wall_runtime_options_init(&options);
  options.cloud_points_max = 100;
  std::uint64_t bytes = 0;
  ASSERT_EQ(pose_wall_runtime_memory_needed(&config, &options, &bytes), POSE_WALL_OK);
  AlignedBlock block(bytes, Dirt::kOnes);
  pose_wall_runtime* r = nullptr;
  ASSERT_EQ(pose_wall_runtime_open(&config, &options, block.data(), bytes, &r), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_runtime_close(r), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_runtime_close(r), POSE_WALL_RUNTIME_E_HANDLE);
  EXPECT_EQ(pose_wall_runtime_start(r), POSE_WALL_RUNTIME_E_HANDLE);
  ASSERT_EQ(pose_wall_runtime_open(&config, &options, block.data(), bytes, &r), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_runtime_close(r), POSE_WALL_OK);
}

TEST(RuntimeLife, TheCallbackMayAskForTheEndButNotWaitForIt) {
  RuntimeUnderTest runtime;
  std::vector<std::int32_t> answers;
  runtime.in_callback = [&] {
    pose_wall_runtime* const r = runtime.get();
    answers = {pose_wall_runtime_stop(r),  pose_wall_runtime_start(r),        pose_wall_runtime_wait_idle(r),
               pose_wall_runtime_close(r), pose_wall_runtime_request_stop(r), pose_wall_runtime_request_stop(r)};
    EXPECT_TRUE(accounts_balance(runtime.statistics()));
  };
  runtime.start();
  runtime.push(few(), 0);
  pose_wall_runtime_wait_idle(runtime.get());  // idle or stopped, whichever it is first
  EXPECT_EQ(pose_wall_runtime_stop(runtime.get()), POSE_WALL_OK);
  EXPECT_EQ(answers, (std::vector<std::int32_t>{POSE_WALL_RUNTIME_E_THREAD, POSE_WALL_RUNTIME_E_THREAD,
                                                POSE_WALL_RUNTIME_E_THREAD, POSE_WALL_RUNTIME_E_THREAD, POSE_WALL_OK,
                                                POSE_WALL_RUNTIME_E_STATE}));
}

TEST(RuntimeLife, TheCallbackMayPushAndRead) {
  RuntimeUnderTest runtime;
  std::atomic<int> left{5};
  std::atomic<int> seen{0};
  runtime.in_callback = [&] {
    if (--left > 0) {
      EXPECT_EQ(runtime.push(few(), 100 - left), POSE_WALL_OK);
    }
    seen += runtime.latest().cause == POSE_WALL_RUNTIME_FRAME ? 1 : 0;
  };
  runtime.start();
  runtime.push(few(), 0);
  runtime.wait_idle();
  EXPECT_EQ(seen, 5);
}

TEST(RuntimeLife, StopWhileTheQueueIsFull) {
  RuntimeUnderTest runtime([](pose_wall_runtime_options* o) { o->queue_frames = 4; });
  runtime.gate.shut();
  runtime.start();
  runtime.push(few(), 0);
  runtime.gate.wait_until_somebody_is_inside();
  for (std::int64_t stamp = 1; stamp <= 6; ++stamp) runtime.push(few(), stamp);
  ASSERT_EQ(pose_wall_runtime_request_stop(runtime.get()), POSE_WALL_OK);
  runtime.gate.open();
  EXPECT_EQ(pose_wall_runtime_stop(runtime.get()), POSE_WALL_OK);
  const pose_wall_runtime_statistics s = runtime.statistics();
  EXPECT_EQ(s.processed, 1U);
  EXPECT_EQ(s.dropped[POSE_WALL_RUNTIME_DROP_OVERTAKEN], 2U);
  EXPECT_EQ(s.dropped[POSE_WALL_RUNTIME_DROP_STOPPED], 4U);
  EXPECT_EQ(s.waiting, 0U);
  EXPECT_TRUE(accounts_balance(s));
}

TEST(RuntimeLife, AStartRemembersNothingButTheCounters) {
  RuntimeUnderTest runtime;
  runtime.start();
  const Points room = room_points(1);
  runtime.push(room, 0);
  runtime.wait_idle();
  const pose_wall_publication before = runtime.latest();
  pose_wall_runtime_stop(runtime.get());
  runtime.start();
  pose_wall_publication p{};
  p.struct_size = sizeof p;
  EXPECT_EQ(pose_wall_runtime_latest(runtime.get(), &p), POSE_WALL_RUNTIME_E_NOTHING);
  runtime.push(room, 0);
  runtime.wait_idle();
  const pose_wall_publication after = runtime.latest();
  EXPECT_EQ(after.result.frame_index, 0U);
  EXPECT_EQ(after.result.frame_reasons, before.result.frame_reasons) << "neither frozen nor still";
  EXPECT_EQ(after.frame, 1U);
  EXPECT_EQ(after.index, 1U);
}

TEST(RuntimeLife, WishesAreReportedAndFatalOnlyIfAsked) {
  const auto wish = [](pose_wall_runtime_options* o) {
    o->worker_cpu = 1023;
    o->lock_memory = 1;
  };
  RuntimeUnderTest runtime(wish);
  runtime.start();
  if (runtime.statistics().affinity_error == 0) GTEST_SKIP() << "a machine with 1024 processors";
  RuntimeUnderTest strict([&](pose_wall_runtime_options* o) {
    wish(o);
    o->required = POSE_WALL_RUNTIME_AFFINITY;
  });
  EXPECT_EQ(pose_wall_runtime_start(strict.get()), POSE_WALL_RUNTIME_E_SYSTEM);
  EXPECT_NE(strict.statistics().affinity_error, 0);
  EXPECT_EQ(strict.statistics().state, static_cast<std::uint32_t>(POSE_WALL_RUNTIME_STOPPED));
  RuntimeUnderTest granted([](pose_wall_runtime_options* o) {
    o->worker_cpu = 0;
    o->required = POSE_WALL_RUNTIME_AFFINITY;
  });
  granted.start();
  EXPECT_EQ(granted.statistics().affinity_error, 0);
}

TEST(RuntimeLife, OnePushAtATime) {
  RuntimeUnderTest runtime;
  runtime.start();
  std::vector<std::thread> threads;
  std::atomic<std::uint64_t> taken{0}, busy{0};
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      const Points points(2000, {1, 1, 1});
      for (int i = 0; i < 100; ++i) {
        const std::int32_t status = runtime.push(points, i);
        taken += status == POSE_WALL_OK ? 1 : 0;
        busy += status == POSE_WALL_RUNTIME_E_BUSY ? 1 : 0;
      }
    });
  }
  for (std::thread& t : threads) t.join();
  runtime.wait_idle();
  const pose_wall_runtime_statistics s = runtime.statistics();
  EXPECT_EQ(taken + busy, 400U);
  EXPECT_EQ(s.dropped[POSE_WALL_RUNTIME_DROP_BUSY], busy);
  EXPECT_EQ(s.pushed, 400U);
  EXPECT_TRUE(accounts_balance(s));
}

// Pushers, readers, tickers and two that start and stop, all at once; with and without a slow callback.
#ifdef __SANITIZE_THREAD__
constexpr int kStormStarts = 50;  // six threads at once are slow under ThreadSanitizer
#else
constexpr int kStormStarts = 150;
#endif

TEST(RuntimeLife, Storm) {
  for (const bool slow : {false, true}) {
    RuntimeUnderTest runtime;
    if (slow) runtime.in_callback = [] { std::this_thread::sleep_for(std::chrono::microseconds(200)); };
    std::atomic<bool> over{false};
    std::atomic<std::uint64_t> broken{0};
    std::vector<std::thread> threads;
    for (int t = 0; t < 2; ++t) {
      threads.emplace_back([&] {
        for (std::int64_t stamp = 0; !over; ++stamp) runtime.push(few(), stamp);
      });
    }
    threads.emplace_back([&] {
      pose_wall_publication p{};
      while (!over) {
        p.struct_size = sizeof p;
        if (pose_wall_runtime_latest(runtime.get(), &p) == POSE_WALL_OK) broken += p.struct_size != sizeof p ? 1 : 0;
        broken += accounts_balance(runtime.statistics()) ? 0 : 1;
        runtime.clock.advance(kMs);
        pose_wall_runtime_tick(runtime.get());
      }
    });
    const auto start_and_stop = [&] {
      for (int i = 0; i < kStormStarts; ++i) {
        pose_wall_runtime_start(runtime.get());
        runtime.push(few(), i);
        if (i % 3 == 0) pose_wall_runtime_wait_idle(runtime.get());
        if (i % 5 == 0) pose_wall_runtime_request_stop(runtime.get());
        EXPECT_EQ(pose_wall_runtime_stop(runtime.get()), POSE_WALL_OK);
      }
    };
    std::thread other(start_and_stop);
    start_and_stop();
    other.join();
    over = true;
    for (std::thread& t : threads) t.join();
    runtime.start();
    EXPECT_EQ(runtime.push(few(), 0), POSE_WALL_OK) << "as good as new";
    runtime.wait_idle();
    pose_wall_runtime_stop(runtime.get());
    EXPECT_EQ(broken, 0U);
    const pose_wall_runtime_statistics s = runtime.statistics();
    EXPECT_EQ(s.pushed, s.processed + dropped(s));
    EXPECT_GT(s.processed, 0U);
  }
}

}  // namespace
}  // namespace pose_wall::test
