// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: silence is published in time by the runtime's clock, with the values that the engine's own rules of holding
// give; it goes on until a frame comes; a refused frame breaks no silence. Time stands unless the test moves it.

#include <gtest/gtest.h>

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

// A worker that is late tells the age of what it knows, though frames wait.
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
  std::vector<std::uint32_t> causes;
  for (const pose_wall_publication& p : runtime.published()) causes.push_back(p.cause);
  EXPECT_EQ(causes, (std::vector<std::uint32_t>{POSE_WALL_RUNTIME_FRAME, POSE_WALL_RUNTIME_SILENCE,
                                                POSE_WALL_RUNTIME_FRAME, POSE_WALL_RUNTIME_SILENCE}));
  const pose_wall_publication p = runtime.latest();
  EXPECT_EQ(p.frame, 1U);
  EXPECT_NEAR(p.result.quantity[POSE_WALL_D_LF].age_s, 0.4, 1e-9);
  EXPECT_NE(p.result.quantity[POSE_WALL_D_LF].state, static_cast<std::uint32_t>(POSE_WALL_VALID));
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
  EXPECT_EQ(runtime.latest().cause, POSE_WALL_RUNTIME_SILENCE);
}

}  // namespace
}  // namespace pose_wall::test
