// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what is older than the watchdog's time by the reader's clock is refused and cannot be acted on, whatever the
// worker is at: in a callback, an engine or a clock that does not come back. Which of them it is, is told. What is
// refused for another reason cannot be acted on either. Images are those of the publication, with a true CRC, and of
// the config that measured.

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <thread>

#include "support/contract.hpp"
#include "support/engine_under_test.hpp"
#include "support/runtime_under_test.hpp"

namespace pose_wall::test {
namespace {

constexpr std::int64_t kWatchdog_ns = 300 * kMs;

struct Read {
  std::int32_t status;
  pose_wall_publication p;
};

Read read(const RuntimeUnderTest& runtime) {
  Read r{};
  std::memset(&r.p, 0x55, sizeof r.p);  // what a caller held before
  r.p.struct_size = sizeof r.p;
  r.status = pose_wall_runtime_latest(runtime.get(), &r.p);
  return r;
}

std::uint32_t best_state(const pose_wall_result& result) {
  std::uint32_t best = 0;
  for (const pose_wall_value& v : result.quantity) best = std::max({best, v.state, v.raw_state});
  return best;
}

// Nothing in it that a caller could act on who looks at states, at confidence, at levels or at raw values alone.
void expect_nothing_to_act_on(const pose_wall_publication& p) {
  EXPECT_EQ(p.struct_size, sizeof p);
  EXPECT_EQ(p.result.struct_size, sizeof p.result);
  EXPECT_EQ(best_state(p.result), std::uint32_t{POSE_WALL_INVALID});
  EXPECT_EQ(p.result.confidence, 0.0);
  EXPECT_EQ(broken_contract(p.result, limits_of(small_config())), "");
  for (const pose_wall_value& v : p.result.quantity) {
    EXPECT_EQ(v.confidence, 0.0);
    EXPECT_TRUE(std::isnan(v.raw) && std::isnan(v.raw_protection_level));
    EXPECT_FALSE(v.protection_level < 1e300);
    EXPECT_NE(v.reasons & POSE_WALL_R_NO_FRAME, 0U);
  }
  EXPECT_EQ(p.result.floor.found + p.result.left.found + p.result.right.found, 0U);
}

template <typename Image>
Image filled(const RuntimeUnderTest& runtime, std::int32_t expected,
             std::int32_t (*fill)(const pose_wall_runtime*, Image*), std::int32_t (*check)(const Image*)) {
  Image image;
  std::memset(&image, 0x55, sizeof image);
  image.struct_size = sizeof image;
  EXPECT_EQ(fill(runtime.get(), &image), expected);
  EXPECT_EQ(check(&image), POSE_WALL_OK);
  return image;
}

pose_wall_image image_of(const RuntimeUnderTest& runtime, std::int32_t expected) {
  return filled(runtime, expected, pose_wall_runtime_image, pose_wall_image_check);
}

pose_wall_image2 image2_of(const RuntimeUnderTest& runtime, std::int32_t expected) {
  return filled(runtime, expected, pose_wall_runtime_image2, pose_wall_image2_check);
}

template <typename Image>
void expect_without_values(const Image& image) {
  EXPECT_EQ(image.verdict, std::uint32_t{POSE_WALL_INVALID});
  EXPECT_EQ(image.valid, 0U);
  for (const auto& a : {image.roll, image.pitch, image.yaw}) {
    EXPECT_EQ(a.state, std::uint32_t{POSE_WALL_INVALID});
    EXPECT_EQ(a.protection_mdeg, POSE_WALL_IMAGE_NO_BOUND);
  }
  for (const auto& d : {image.d_lf, image.d_lb, image.d_rf, image.d_rb}) {
    EXPECT_EQ(d.state, std::uint32_t{POSE_WALL_INVALID});
    EXPECT_EQ(d.protection_mm, POSE_WALL_IMAGE_NO_BOUND);
  }
}

void expect_images_without_values(const RuntimeUnderTest& runtime, std::int32_t expected) {
  expect_without_values(image_of(runtime, expected));
  expect_without_values(image2_of(runtime, expected));
}

// The frame is 299 ms old, and then 300: whoever reads, the worker is not asked.
void expect_it_gets_stale(RuntimeUnderTest* runtime, std::uint32_t activity, std::int64_t begun_ns) {
  Read r = read(*runtime);
  const std::int64_t age_ns = r.p.age_ns;
  EXPECT_EQ(r.status, POSE_WALL_OK);
  EXPECT_GE(best_state(r.p.result), std::uint32_t{POSE_WALL_VALID});
  runtime->clock.advance(kWatchdog_ns - 1 - age_ns);
  r = read(*runtime);
  EXPECT_EQ(r.status, POSE_WALL_OK);
  EXPECT_EQ(r.p.age_ns, kWatchdog_ns - 1);
  EXPECT_EQ(r.p.activity, activity);
  runtime->clock.advance(1);
  for (const std::int64_t more_ns : {std::int64_t{0}, 1300 * kMs, 3600000 * kMs}) {
    runtime->clock.advance(more_ns);
    const Read stale = read(*runtime);
    EXPECT_EQ(stale.status, POSE_WALL_RUNTIME_E_STALE);
    EXPECT_EQ(stale.p.index, r.p.index);
    EXPECT_EQ(stale.p.received_ns, r.p.received_ns);
    EXPECT_GE(stale.p.age_ns, kWatchdog_ns + more_ns);
    EXPECT_EQ(stale.p.activity, activity) << pose_wall_runtime_activity_name(stale.p.activity);
    EXPECT_EQ(stale.p.activity_since_ns, begun_ns / 8 * 8);
    EXPECT_NEAR(stale.p.result.quantity[POSE_WALL_YAW].age_s, static_cast<double>(stale.p.age_ns) * 1e-9, 1e-6);
    EXPECT_EQ(stale.p.result.quantity[POSE_WALL_YAW].value, r.p.result.quantity[POSE_WALL_YAW].value) << "readable";
    expect_nothing_to_act_on(stale.p);
    expect_images_without_values(*runtime, POSE_WALL_RUNTIME_E_STALE);
  }
}

TEST(Freshness, ACallbackThatHangs) {
  RuntimeUnderTest runtime;
  runtime.gate.shut();
  runtime.start();
  runtime.push(room_points(1), 0);
  runtime.gate.wait_until_somebody_is_inside();
  const std::int64_t now_ns = runtime.latest().published_ns;
  expect_it_gets_stale(&runtime, POSE_WALL_RUNTIME_AT_CALLBACK, now_ns);
  EXPECT_EQ(runtime.statistics().activity, std::uint32_t{POSE_WALL_RUNTIME_AT_CALLBACK});
  EXPECT_EQ(runtime.statistics().activity_since_ns, now_ns / 8 * 8);
  // It comes back: silence is told at once, and is no worse for having been late.
  runtime.gate.open();
  runtime.wait_idle();
  EXPECT_EQ(read(runtime).status, POSE_WALL_OK);
  EXPECT_EQ(runtime.latest().cause, std::uint32_t{POSE_WALL_RUNTIME_SILENCE});
  runtime.push(room_points(2), 100 * kMs);
  runtime.wait_idle();
  EXPECT_EQ(runtime.latest().result.quantity[POSE_WALL_YAW].state, std::uint32_t{POSE_WALL_VALID});
  EXPECT_EQ(runtime.statistics().activity, std::uint32_t{POSE_WALL_RUNTIME_AT_WAIT});
}

// A clock that does not come back to others than the test's own thread, after so many looks.
struct HangingClock {
  StandingClock* clock = nullptr;
  Gate gate;
  std::atomic<int> looks_left{1 << 30};
  const std::thread::id own = std::this_thread::get_id();

  static std::int64_t read(void* self) {
    HangingClock& c = *static_cast<HangingClock*>(self);
    const std::int64_t now_ns = StandingClock::read(c.clock);
    if (std::this_thread::get_id() != c.own && --c.looks_left < 0) c.gate.pass();
    return now_ns;
  }
  void hang_after(int looks) {
    gate.shut();
    looks_left = looks;
  }
  void come_back() {
    looks_left = 1 << 30;
    gate.open();
  }
};

class HangingRuntime : public ::testing::Test {
 protected:
  HangingRuntime() : runtime_([this](pose_wall_runtime_options* o) { hang_in(o); }) {
    runtime_.start();
    runtime_.push(room_points(1), 0);
    runtime_.wait_idle();
    runtime_.clock.advance(100 * kMs);
  }
  void TearDown() override { clock_.come_back(); }
  void hang_in(pose_wall_runtime_options* o) {
    clock_.clock = static_cast<StandingClock*>(o->clock_user);
    o->clock = HangingClock::read;
    o->clock_user = &clock_;
  }

  HangingClock clock_;
  RuntimeUnderTest runtime_;
};

TEST_F(HangingRuntime, InItsEngine) {
  const std::int64_t now_ns = runtime_.latest().published_ns + 100 * kMs;
  clock_.hang_after(3);  // the next look is the engine's, at the end of one of its stages
  ASSERT_EQ(runtime_.push(room_points(2), 100 * kMs), POSE_WALL_OK);
  clock_.gate.wait_until_somebody_is_inside();
  EXPECT_EQ(runtime_.statistics().activity, std::uint32_t{POSE_WALL_RUNTIME_AT_FRAME});
  expect_it_gets_stale(&runtime_, POSE_WALL_RUNTIME_AT_FRAME, now_ns);
  clock_.come_back();
  runtime_.wait_idle();
  EXPECT_EQ(runtime_.latest().cause, std::uint32_t{POSE_WALL_RUNTIME_SILENCE}) << "that frame is old";
}

TEST_F(HangingRuntime, InItsClock) {
  const std::int64_t looked_ns = runtime_.latest().published_ns;
  clock_.hang_after(0);
  ASSERT_EQ(pose_wall_runtime_tick(runtime_.get()), POSE_WALL_OK);
  clock_.gate.wait_until_somebody_is_inside();
  expect_it_gets_stale(&runtime_, POSE_WALL_RUNTIME_AT_CHOICE, looked_ns);
  clock_.come_back();
  runtime_.pass(0);
  EXPECT_EQ(runtime_.latest().cause, std::uint32_t{POSE_WALL_RUNTIME_SILENCE});
}

// With a clock of the caller's nobody but tick wakes the worker: what it does not tell is stale all the same.
TEST(Freshness, AWorkerThatNobodyWakes) {
  RuntimeUnderTest runtime;
  runtime.start();
  runtime.push(room_points(1), 0);
  runtime.wait_idle();
  const std::int64_t now_ns = runtime.latest().published_ns;
  expect_it_gets_stale(&runtime, POSE_WALL_RUNTIME_AT_WAIT, now_ns);
}

// While it measures, the frame before gets stale; what it has measured comes with the age that it has by then.
TEST_F(HangingRuntime, OrIsDeadSlow) {
  clock_.hang_after(3);
  ASSERT_EQ(runtime_.push(room_points(2), 100 * kMs), POSE_WALL_OK);
  clock_.gate.wait_until_somebody_is_inside();
  runtime_.clock.advance(200 * kMs);
  EXPECT_EQ(read(runtime_).status, POSE_WALL_RUNTIME_E_STALE);
  clock_.come_back();
  runtime_.wait_idle();
  const Read r = read(runtime_);
  EXPECT_EQ(r.status, POSE_WALL_OK);
  EXPECT_EQ(r.p.frame, 1U);
  EXPECT_EQ(r.p.age_ns, 200 * kMs) << "not 0";
  runtime_.clock.advance(100 * kMs);
  EXPECT_EQ(read(runtime_).status, POSE_WALL_RUNTIME_E_STALE);
}

TEST(Freshness, SilenceGetsStaleTooWhenItIsNotToldAnew) {
  RuntimeUnderTest runtime;
  runtime.start();
  runtime.push(room_points(1), 0);
  runtime.wait_idle();
  runtime.gate.shut();
  runtime.clock.advance(kWatchdog_ns);
  ASSERT_EQ(pose_wall_runtime_tick(runtime.get()), POSE_WALL_OK);
  runtime.gate.wait_until_somebody_is_inside();
  Read r = read(runtime);
  EXPECT_EQ(r.status, POSE_WALL_OK);
  EXPECT_EQ(r.p.cause, std::uint32_t{POSE_WALL_RUNTIME_SILENCE});
  EXPECT_EQ(r.p.age_ns, kWatchdog_ns) << "of the frame";
  EXPECT_EQ(best_state(r.p.result), std::uint32_t{POSE_WALL_HELD});
  runtime.clock.advance(kWatchdog_ns - 1);
  EXPECT_EQ(read(runtime).status, POSE_WALL_OK);
  runtime.clock.advance(1);
  r = read(runtime);
  EXPECT_EQ(r.status, POSE_WALL_RUNTIME_E_STALE);
  EXPECT_EQ(r.p.age_ns, 2 * kWatchdog_ns);
  EXPECT_NEAR(r.p.result.quantity[POSE_WALL_YAW].age_s, 0.6, 1e-9);
  expect_nothing_to_act_on(r.p);
}

TEST(Freshness, AClockThatGoesBackUnderAWorkerThatHangs) {
  RuntimeUnderTest runtime;
  runtime.gate.shut();
  runtime.start();
  runtime.push(room_points(1), 0);
  runtime.gate.wait_until_somebody_is_inside();
  runtime.clock.advance(-kWatchdog_ns);
  Read r = read(runtime);
  EXPECT_EQ(r.status, POSE_WALL_OK) << "a clock that is set right by a little";
  EXPECT_EQ(r.p.age_ns, 0);
  runtime.clock.advance(-1);
  r = read(runtime);
  EXPECT_EQ(r.status, POSE_WALL_RUNTIME_E_STALE);
  EXPECT_EQ(r.p.age_ns, INT64_MAX) << "nobody knows";
  expect_nothing_to_act_on(r.p);
  EXPECT_GE(r.p.result.quantity[POSE_WALL_YAW].age_s, 3600.0);
}

TEST(Freshness, WithoutAWatchdogNothingIsStale) {
  RuntimeUnderTest runtime([](pose_wall_runtime_options* o) { o->watchdog_ns = 0; });
  runtime.start();
  runtime.push(room_points(1), 0);
  runtime.wait_idle();
  runtime.clock.advance(3600000 * kMs);
  const Read r = read(runtime);
  EXPECT_EQ(r.status, POSE_WALL_OK);
  EXPECT_EQ(r.p.age_ns, 3600000 * kMs);
  EXPECT_EQ(best_state(r.p.result), std::uint32_t{POSE_WALL_VALID});
}

// Of what was never there, or is there no more: a caller who forgets the status holds nothing that he held before.
TEST(Freshness, WhatIsNotThereIsWrittenAsSuch) {
  RuntimeUnderTest runtime;
  const auto expect_nothing = [&](std::int32_t status) {
    const Read r = read(runtime);
    EXPECT_EQ(r.status, status);
    EXPECT_EQ(r.p.cause, 0U);
    EXPECT_EQ(r.p.age_ns, INT64_MAX);
    expect_nothing_to_act_on(r.p);
    expect_images_without_values(runtime, status);
    EXPECT_EQ(image2_of(runtime, status).publication, 0U);
    EXPECT_EQ(image2_of(runtime, status).latency_ms, 0xFFFFFFFFU);
  };
  expect_nothing(POSE_WALL_RUNTIME_E_STATE);
  EXPECT_EQ(read(runtime).p.activity, std::uint32_t{POSE_WALL_RUNTIME_AT_NOTHING});
  runtime.start();
  expect_nothing(POSE_WALL_RUNTIME_E_NOTHING);
  runtime.push(room_points(1), 0);
  runtime.wait_idle();
  EXPECT_EQ(best_state(read(runtime).p.result), std::uint32_t{POSE_WALL_VALID});
  runtime.stop();
  expect_nothing(POSE_WALL_RUNTIME_E_STATE);
  EXPECT_EQ(read(runtime).p.activity, std::uint32_t{POSE_WALL_RUNTIME_AT_NOTHING});
}

TEST(Freshness, TheCallbackIsToldItsOwnActivity) {
  RuntimeUnderTest runtime;
  runtime.start();
  runtime.push(room_points(1), 0);
  runtime.wait_idle();
  const auto published = runtime.published();
  ASSERT_EQ(published.size(), 1U);
  EXPECT_EQ(published[0].activity, std::uint32_t{POSE_WALL_RUNTIME_AT_CALLBACK});
  EXPECT_EQ(published[0].age_ns, published[0].published_ns - published[0].received_ns);
}

// The image is that of the engine alone, with the CRC of the config that measured: there is no other handle to give.
TEST(RuntimeImage, IsOfWhoeverMeasured) {
  pose_wall_config config = small_config();
  set(&config, "alert_limit_distance", "0.09");
  std::uint32_t crc = 0;
  ASSERT_EQ(pose_wall_config_crc(&config, &crc), POSE_WALL_OK);
  EngineUnderTest engine(config);
  RuntimeUnderTest runtime(nullptr, config);
  runtime.start();
  for (std::uint32_t i = 0; i < 3; ++i) {
    const Points room = room_points(i);
    runtime.push(room, i * 100 * kMs);
    runtime.wait_idle();
    const pose_wall_result result = engine.process(cloud_of(room, i * 100 * kMs));
    pose_wall_image expected{};
    expected.struct_size = sizeof expected;
    ASSERT_EQ(pose_wall_image_fill(&result, &expected), POSE_WALL_OK);
    const pose_wall_image image = image_of(runtime, POSE_WALL_OK);
    EXPECT_EQ(std::memcmp(&image, &expected, sizeof image), 0) << i;
    EXPECT_EQ(image.config_crc32, crc);
    EXPECT_EQ(image.sequence, i + 1);
  }
}

// Image 2 tells what the runtime knows beside the result, of frames and of silence.
TEST(RuntimeImage, TwoHasItsSource) {
  RuntimeUnderTest runtime;
  runtime.start();
  runtime.push(room_points(1), 0);
  runtime.wait_idle();
  pose_wall_image2 image = image2_of(runtime, POSE_WALL_OK);
  EXPECT_EQ(image.publication, 1U);
  EXPECT_EQ(image.sequence, 1U);
  EXPECT_EQ(image.told_by, std::uint32_t{POSE_WALL_RUNTIME_FRAME});
  EXPECT_EQ(image.thinning, 1U);
  EXPECT_EQ(image.held_thinning, 1U);
  EXPECT_EQ(image.latency_ms, 0U);
  runtime.pass(kWatchdog_ns);
  image = image2_of(runtime, POSE_WALL_OK);
  EXPECT_EQ(image.publication, 2U);
  EXPECT_EQ(image.sequence, 1U);
  EXPECT_EQ(image.told_by, std::uint32_t{POSE_WALL_RUNTIME_SILENCE});
  EXPECT_EQ(image.latency_ms, 300U) << "the age of what it tells of";
  runtime.clock.advance(kWatchdog_ns);
  EXPECT_EQ(image2_of(runtime, POSE_WALL_RUNTIME_E_STALE).publication, 2U) << "nobody publishes";
}

}  // namespace
}  // namespace pose_wall::test
