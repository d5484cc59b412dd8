// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: start and stop from any state and thread come back, what would wait for itself is refused, every frame is
// accounted for across stops, and the block is free after close. In a storm of calls what is read is whole, was
// published and is the newest; there is no data race under ThreadSanitizer.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>
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
  (void)pose_wall_runtime_wait_idle(runtime.get());  // idle or stopped, whichever it is first
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
  runtime.stop();
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

#if defined(__SANITIZE_THREAD__)
constexpr int kStormStarts = 25;  // each takes many times as long
#else
constexpr int kStormStarts = 150;
#endif

// A number of all bytes of a publication but what is of the moment in which it is read: two that differ in one word
// have different ones.
std::uint64_t digest_of(pose_wall_publication p) {
  p.age_ns = p.activity_since_ns = 0;
  p.activity = 0;
  std::uint64_t words[sizeof p / sizeof(std::uint64_t)], sum = 0;
  static_assert(sizeof words == sizeof p, "made of whole words");
  std::memcpy(words, &p, sizeof p);
  for (const std::uint64_t word : words) sum = (sum ^ word) * 0x9E3779B97F4A7C15U + (sum >> 29U);
  return sum;
}

// Who pushes what: each pusher's stamps go up by kPushers, so that a stamp tells whose it is and which; and a cloud has
// as many points as tell whose it is.
constexpr std::uint32_t kPushers = 4;

const Points& points_of_pusher(std::uint32_t pusher) {
  static const Points points[kPushers] = {Points(3, {1, 1, 1}), Points(4, {1, 1, 1}), Points(5, {1, 1, 1}),
                                          Points(6, {1, 1, 1})};
  return points[pusher];
}

std::int32_t push_next(RuntimeUnderTest* runtime, std::uint32_t pusher, std::int64_t* round) {
  return runtime->push(points_of_pusher(pusher), (*round)++ * kPushers + pusher);
}

// What the worker called back with, publication by publication: what readers saw is held against it.
struct Told {
  std::vector<std::uint64_t> digests;  // by index
  std::atomic<std::uint64_t> count{0};
  std::atomic<std::uint64_t> broken{0};
  bool slow = false;

  static void on_result(void* self, const pose_wall_publication* p) {
    Told& told = *static_cast<Told*>(self);
    told.broken += p->index == told.digests.size() ? 0U : 1U;
    told.broken += p->cause == POSE_WALL_RUNTIME_SILENCE || told.is_next_frame(*p) ? 0U : 1U;
    told.broken += p->published_ns >= p->received_ns ? 0U : 1U;
    told.digests.push_back(digest_of(*p));
    told.count = told.digests.size();
    if (told.slow) std::this_thread::sleep_for(std::chrono::microseconds(200));
  }

 private:
  // Frames come in the order of their numbers, and each is what its pusher gave, in his order.
  bool is_next_frame(const pose_wall_publication& p) {
    const std::int64_t stamp = p.result.stamp_ns;
    const auto pusher = static_cast<std::uint32_t>(stamp % kPushers);
    const bool next = p.frame + 1 > frames_ && stamp > last_stamp_[pusher];
    frames_ = p.frame + 1;
    last_stamp_[pusher] = stamp;
    return next && p.result.points_in == points_of_pusher(pusher).size();
  }

  std::uint64_t frames_ = 0;
  std::int64_t last_stamp_[kPushers] = {-1, -1, -1, -1};
};

// One thread that reads the newest publication, again and again.
class Reader {
 public:
  Reader(RuntimeUnderTest* runtime, const Told* told) : runtime_(runtime), told_(told) {}

  void look() {
    const std::uint64_t told_before = told_->count;
    pose_wall_publication p{};
    p.struct_size = sizeof p;
    const std::int32_t status = pose_wall_runtime_latest(runtime_->get(), &p);
    broken_ += status == POSE_WALL_OK || p.result.confidence == 0.0 ? 0U : 1U;
    if (status != POSE_WALL_OK) return;
    const pose_wall_runtime_statistics s = runtime_->statistics();
    // Readers have it before the callback has: what was called back with already is never newer than what is read.
    broken_ += p.index + 1 >= told_before ? 0U : 1U;
    broken_ += seen_.empty() || p.index >= seen_.back().first ? 0U : 1U;
    broken_ += p.cause == POSE_WALL_RUNTIME_SILENCE || p.frame < s.pushed ? 0U : 1U;
    broken_ += p.published_ns >= p.received_ns ? 0U : 1U;
    const std::pair<std::uint64_t, std::uint64_t> now(p.index, digest_of(p));
    if (seen_.empty() || seen_.back() != now) seen_.push_back(now);
  }

  std::uint64_t broken() const { return broken_; }
  // When all threads have ended. Of what was read, how many are not what the callback got, bit by bit.
  std::uint64_t other_than_told() const {
    std::uint64_t others = 0;
    for (const auto& [index, digest] : seen_) {
      others += index < told_->digests.size() && told_->digests[index] == digest ? 0U : 1U;
    }
    return others;
  }
  std::size_t seen() const { return seen_.size(); }

 private:
  RuntimeUnderTest* runtime_;
  const Told* told_;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> seen_;
  std::uint64_t broken_ = 0;
};

// Pushers, readers, tickers and two that start and stop, all at once; with and without a slow callback. Whatever is
// read is whole and not older than what was read or called back with before.
TEST(RuntimeLife, Storm) {
  for (const bool slow : {false, true}) {
    Told told;
    told.slow = slow;
    RuntimeUnderTest runtime([&](pose_wall_runtime_options* o) {
      o->callback = Told::on_result;
      o->callback_user = &told;
    });
    std::atomic<bool> over{false};
    std::atomic<std::uint64_t> broken{0};
    std::vector<std::thread> threads;
    for (std::uint32_t pusher = 0; pusher < 2; ++pusher) {
      threads.emplace_back([&, pusher] {
        for (std::int64_t round = 0; !over;) push_next(&runtime, pusher, &round);
      });
    }
    Reader reader(&runtime, &told), beside(&runtime, &told);
    threads.emplace_back([&] {
      for (int round = 1; !over; ++round) {
        reader.look();
        broken += accounts_balance(runtime.statistics()) ? 0 : 1;
        runtime.clock.advance(kMs);
        (void)pose_wall_runtime_tick(runtime.get());
        // The pushers never pause, so two that both wait for idleness may wait for good: a stop ends that.
        constexpr int kRoundsToStop = 64;  // a start lasts several, so frames are worked
        if (round % kRoundsToStop == 0) (void)pose_wall_runtime_request_stop(runtime.get());
      }
    });
    threads.emplace_back([&] {
      while (!over) beside.look();
    });
    const auto start_and_stop = [&](std::uint32_t pusher) {
      std::int64_t round = 0;
      for (int i = 0; i < kStormStarts; ++i) {
        (void)pose_wall_runtime_start(runtime.get());  // the other thread may have
        push_next(&runtime, pusher, &round);
        if (i % 3 == 0) (void)pose_wall_runtime_wait_idle(runtime.get());
        if (i % 5 == 0) (void)pose_wall_runtime_request_stop(runtime.get());
        EXPECT_EQ(pose_wall_runtime_stop(runtime.get()), POSE_WALL_OK);
      }
    };
    std::thread other(start_and_stop, 2U);
    start_and_stop(3);
    other.join();
    over = true;
    for (std::thread& t : threads) t.join();
    runtime.start();
    std::int64_t round = kStormStarts;
    EXPECT_EQ(push_next(&runtime, 3, &round), POSE_WALL_OK) << "as good as new";
    runtime.wait_idle();
    reader.look();
    runtime.stop();
    EXPECT_EQ(broken, 0U);
    EXPECT_EQ(told.broken, 0U) << "called back out of order, or with what nobody pushed";
    for (const Reader* const r : {&reader, &beside}) {
      EXPECT_EQ(r->broken(), 0U) << "read what is older, or of no push";
      EXPECT_EQ(r->other_than_told(), 0U) << "read what was never published";
    }
    EXPECT_GT(reader.seen(), 0U);
    const pose_wall_runtime_statistics s = runtime.statistics();
    EXPECT_EQ(s.pushed, s.processed + dropped(s));
    EXPECT_EQ(s.published, told.digests.size());
    EXPECT_GT(s.processed, 0U);
  }
}

}  // namespace
}  // namespace pose_wall::test
