// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: silence is published in time by the runtime's clock, with the values that the engine's own rules of holding
// give; it goes on until a frame comes; a refused frame breaks no silence; a frame that waited too long is no news; a
// slow callback does not keep frames out; a clock that goes back is told. Time stands unless the test moves it.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <limits>

#include "support/engine_under_test.hpp"
#include "support/runtime_under_test.hpp"

namespace pose_wall::test {
namespace {

TEST(RuntimeWatchdog, ValuesAgeAreHeldAndEnd) {
  EngineUnderTest engine(small_config());
  RuntimeUnderTest runtime;
  runtime.start();
  const Points room = room_points(1);
  runtime.push(room, 7000 * kMs);
  runtime.wait_idle();
  engine.process(cloud_of(room, 7000 * kMs));
  runtime.pass(299 * kMs);
  EXPECT_EQ(runtime.latest().cause, POSE_WALL_RUNTIME_FRAME);
  runtime.pass(1 * kMs);
  bool held = false, invalid = false;
  for (std::int64_t ms = 300; ms <= 3000; ms += 100) {
    const pose_wall_publication p = runtime.latest();
    EXPECT_EQ(p.cause, POSE_WALL_RUNTIME_SILENCE);
    EXPECT_EQ(p.frame, 0U);
    EXPECT_EQ(p.published_ns - p.received_ns, ms * kMs);
    pose_wall_result expected{};
    expected.struct_size = sizeof expected;
    ASSERT_EQ(pose_wall_age(engine.get(), (7000 + ms) * kMs, &expected), POSE_WALL_OK);
    EXPECT_EQ(std::memcmp(&p.result, &expected, sizeof expected), 0) << ms << " ms";
    held = held || p.result.quantity[POSE_WALL_D_LF].state == POSE_WALL_HELD;
    invalid = p.result.quantity[POSE_WALL_D_LF].state == POSE_WALL_INVALID;
    runtime.pass(100 * kMs);
  }
  EXPECT_TRUE(held);
  EXPECT_TRUE(invalid);
  EXPECT_EQ(runtime.statistics().silences, runtime.published().size() - 1);
  runtime.push(room_points(2), 10100 * kMs);
  runtime.wait_idle();
  EXPECT_GE(runtime.latest().result.quantity[POSE_WALL_D_LF].state, POSE_WALL_DEGRADED);
}

std::vector<std::uint32_t> causes_of(const RuntimeUnderTest::Publications& published) {
  std::vector<std::uint32_t> causes;
  for (const pose_wall_publication& p : published) causes.push_back(p.cause);
  return causes;
}

// A worker that is late tells the age of what it knows, and what waited as long is not told as news.
TEST(RuntimeWatchdog, LateFramesAreOldFrames) {
  RuntimeUnderTest runtime;
  runtime.gate.shut();
  runtime.start();
  runtime.push(room_points(1), 0);
  runtime.gate.wait_until_somebody_is_inside();
  runtime.push(room_points(2), 100 * kMs);
  runtime.clock.advance(400 * kMs);
  runtime.gate.open();
  runtime.wait_idle();
  EXPECT_EQ(causes_of(runtime.published()),
            (std::vector<std::uint32_t>{POSE_WALL_RUNTIME_FRAME, POSE_WALL_RUNTIME_SILENCE}));
  const pose_wall_publication p = runtime.latest();
  EXPECT_EQ(p.frame, 0U);
  EXPECT_NEAR(p.result.quantity[POSE_WALL_D_LF].age_s, 0.4, 1e-9);
  EXPECT_EQ(p.result.quantity[POSE_WALL_D_LF].state, static_cast<std::uint32_t>(POSE_WALL_HELD));
  const pose_wall_runtime_statistics s = runtime.statistics();
  EXPECT_EQ(s.dropped[POSE_WALL_RUNTIME_DROP_LATE], 1U);
  EXPECT_TRUE(accounts_balance(s));
}

TEST(RuntimeWatchdog, AFrameThatIsAlmostLateIsWorked) {
  RuntimeUnderTest runtime;
  runtime.gate.shut();
  runtime.start();
  runtime.push(room_points(1), 0);
  runtime.gate.wait_until_somebody_is_inside();
  runtime.clock.advance(100 * kMs);
  runtime.push(room_points(2), 100 * kMs);
  runtime.clock.advance(299 * kMs);
  runtime.gate.open();
  runtime.wait_idle();
  EXPECT_EQ(runtime.statistics().processed, 2U);
  EXPECT_EQ(runtime.latest().result.stamp_ns, 100 * kMs);
}

// A callback that takes longer than watchdog_every_ns: silence would be due after each silence, for ever.
TEST(RuntimeWatchdog, ASlowCallbackLetsFramesThrough) {
  RuntimeUnderTest runtime;
  std::int64_t stamp_ns = 0;
  std::atomic<int> pushes{0};
  runtime.in_callback = [&] {
    runtime.clock.advance(150 * kMs);
    if (pushes < 20) runtime.push(room_points(static_cast<std::uint32_t>(++pushes) % 3), stamp_ns += 150 * kMs);
  };
  runtime.start();
  runtime.pass(300 * kMs);
  EXPECT_EQ(pushes, 20);
  EXPECT_GE(runtime.statistics().processed, 9U) << "every second publication at least";
  EXPECT_TRUE(accounts_balance(runtime.statistics()));
}

TEST(RuntimeWatchdog, AClockThatGoesBackIsSilenceOfUnknownLength) {
  RuntimeUnderTest runtime;
  runtime.start();
  runtime.push(room_points(1), 0);
  runtime.wait_idle();
  runtime.pass(-100 * kMs);
  EXPECT_EQ(runtime.latest().cause, POSE_WALL_RUNTIME_FRAME) << "a clock that is set right by a little";
  runtime.pass(-3600000 * kMs);
  pose_wall_publication p = runtime.latest();
  EXPECT_EQ(p.cause, POSE_WALL_RUNTIME_SILENCE);
  for (const pose_wall_value& v : p.result.quantity) {
    EXPECT_EQ(v.state, static_cast<std::uint32_t>(POSE_WALL_INVALID));
  }
  EXPECT_EQ(runtime.statistics().newest_age_ns, -1) << "nobody knows";
  runtime.push(room_points(2), 100 * kMs);
  runtime.wait_idle();
  p = runtime.latest();
  EXPECT_EQ(p.cause, POSE_WALL_RUNTIME_FRAME);
  EXPECT_EQ(p.result.quantity[POSE_WALL_YAW].state, static_cast<std::uint32_t>(POSE_WALL_VALID));
  runtime.pass(300 * kMs);
  EXPECT_EQ(runtime.latest().result.quantity[POSE_WALL_YAW].state, static_cast<std::uint32_t>(POSE_WALL_HELD))
      << "by its new time";
}

// By more than the watchdog's time, whatever the time between two silences.
TEST(RuntimeWatchdog, AClockThatGoesBackIsToldThoughSilenceIsToldSeldom) {
  RuntimeUnderTest runtime([](pose_wall_runtime_options* o) { o->watchdog_every_ns = 10000 * kMs; });
  runtime.start();
  runtime.push(room_points(1), 0);
  runtime.wait_idle();
  runtime.pass(100 * kMs);
  runtime.pass(-15000 * kMs);
  EXPECT_EQ(runtime.latest().cause, POSE_WALL_RUNTIME_SILENCE);
  EXPECT_EQ(runtime.latest().result.quantity[POSE_WALL_YAW].state, static_cast<std::uint32_t>(POSE_WALL_INVALID));
}

// An engine that takes longer than the watchdog's time: what it measures is told with its age, not as news.
TEST(RuntimeWatchdog, AFrameThatIsWorkedTooLateIsNoNews) {
  RuntimeUnderTest runtime;
  runtime.in_callback = [&] { runtime.clock.set_step(0); };  // or it would look without end
  runtime.start();
  runtime.push(room_points(1), 0);
  runtime.wait_idle();
  EXPECT_EQ(runtime.latest().cause, POSE_WALL_RUNTIME_FRAME);
  runtime.clock.set_step(60 * kMs);  // by each look at the clock, of which a frame takes more than five
  runtime.push(room_points(2), 100 * kMs);
  runtime.wait_idle();
  const pose_wall_runtime_statistics s = runtime.statistics();
  EXPECT_EQ(s.dropped[POSE_WALL_RUNTIME_DROP_LATE], 1U);
  EXPECT_EQ(s.processed, 1U);
  EXPECT_TRUE(accounts_balance(s));
  const std::vector<std::uint32_t> causes = causes_of(runtime.published());
  EXPECT_EQ(std::count(causes.begin(), causes.end(), static_cast<std::uint32_t>(POSE_WALL_RUNTIME_FRAME)), 1);
  const pose_wall_publication p = runtime.latest();
  EXPECT_EQ(p.frame, 1U) << "of what was measured";
  EXPECT_LE(p.result.quantity[POSE_WALL_YAW].state, static_cast<std::uint32_t>(POSE_WALL_HELD));
  EXPECT_GE(p.result.quantity[POSE_WALL_YAW].age_s, 0.3);
}

// While silent the clock goes back: what was told to be this old gets no younger.
TEST(RuntimeWatchdog, NothingGetsYoungerWhileSilent) {
  RuntimeUnderTest runtime;
  runtime.start();
  runtime.push(room_points(1), 0);
  runtime.wait_idle();
  runtime.pass(400 * kMs);
  const double age_s = runtime.latest().result.quantity[POSE_WALL_YAW].age_s;
  EXPECT_NEAR(age_s, 0.4, 1e-9);
  runtime.clock.advance(-350 * kMs);
  runtime.pass(0);
  runtime.pass(100 * kMs);
  EXPECT_GE(runtime.latest().result.quantity[POSE_WALL_YAW].age_s, age_s);
}

TEST(RuntimeWatchdog, SpeaksBeforeTheFirstFrameToo) {
  RuntimeUnderTest runtime;
  runtime.start();
  pose_wall_publication p{};
  p.struct_size = sizeof p;
  EXPECT_EQ(pose_wall_runtime_latest(runtime.get(), &p), POSE_WALL_RUNTIME_E_NOTHING);
  runtime.pass(300 * kMs);
  p = runtime.latest();
  EXPECT_EQ(p.cause, POSE_WALL_RUNTIME_SILENCE);
  EXPECT_NE(p.result.quantity[0].reasons & POSE_WALL_R_NEVER_MEASURED, 0U);
  EXPECT_EQ(p.result.frame_index, UINT64_MAX) << "of no frame yet";
}

TEST(RuntimeWatchdog, ARefusedFrameBreaksNoSilence) {
  RuntimeUnderTest runtime;
  runtime.start();
  runtime.clock.advance(200 * kMs);
  pose_wall_cloud cloud = cloud_of(room_points(1), 0);
  cloud.x.type = 77;
  EXPECT_EQ(pose_wall_runtime_push(runtime.get(), &cloud), POSE_WALL_E_CLOUD_FIELD);
  runtime.pass(100 * kMs);
  EXPECT_EQ(runtime.latest().cause, POSE_WALL_RUNTIME_SILENCE);
}

TEST(RuntimeWatchdog, OffMeansNever) {
  RuntimeUnderTest runtime([](pose_wall_runtime_options* o) { o->watchdog_ns = 0; });
  runtime.start();
  runtime.pass(3600000 * kMs);
  EXPECT_EQ(runtime.statistics().published, 0U);
}

TEST(RuntimeWatchdog, StampsAtTheEndOfTime) {
  for (const std::int64_t stamp :
       {std::numeric_limits<std::int64_t>::max(), std::numeric_limits<std::int64_t>::min()}) {
    RuntimeUnderTest runtime;
    runtime.start();
    runtime.push(room_points(1), stamp);
    runtime.wait_idle();
    runtime.pass(400 * kMs);
    const pose_wall_publication p = runtime.latest();
    EXPECT_EQ(p.cause, POSE_WALL_RUNTIME_SILENCE);
    EXPECT_GE(p.result.stamp_ns, stamp) << "saturated, not come round";
  }
}

// The real clock: no figure is asked for, only that it comes by itself.
TEST(RuntimeWatchdog, TheRealClockNeedsNoTick) {
  RuntimeUnderTest runtime([](pose_wall_runtime_options* o) {
    o->clock = nullptr;
    o->watchdog_ns = kMs;
    o->watchdog_every_ns = kMs;
  });
  Gate& gate = runtime.gate;
  gate.shut();
  runtime.start();
  gate.wait_until_somebody_is_inside();
  pose_wall_publication p{};
  p.struct_size = sizeof p;
  const std::int32_t status = pose_wall_runtime_latest(runtime.get(), &p);
  EXPECT_TRUE(status == POSE_WALL_OK || status == POSE_WALL_RUNTIME_E_STALE) << "a millisecond is soon over";
  EXPECT_EQ(p.cause, POSE_WALL_RUNTIME_SILENCE);
}

}  // namespace
}  // namespace pose_wall::test
