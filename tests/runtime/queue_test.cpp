// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what comes out is what the engine says of the same cloud, bit for bit, whatever its layout; the newest frames
// win; every push is accounted for by its fate, at every moment.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "support/engine_under_test.hpp"
#include "support/runtime_under_test.hpp"

namespace pose_wall::test {
namespace {

// The engine has no clock of its own here; the runtime's stands still, so stage_ns is 0 in both.
void expect_same(const pose_wall_result& a, const pose_wall_result& b) {
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
}

// With what a driver adds: no-returns as NaN, infinity and zero, also negative zero.
Points with_no_returns(Points points) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(), kInf = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < points.size(); i += 7) {
    const std::array<float, 3> kinds[] = {{0, 0, 0}, {kNan, 1, 1}, {1, -kInf, 1}, {0, -0.0F, 0}, {kNan, kNan, kNan}};
    points.insert(points.begin() + static_cast<std::ptrdiff_t>(i), kinds[i % 5]);
  }
  return points;
}

TEST(RuntimeQueue, GivesWhatTheEngineSays) {
  EngineUnderTest engine(small_config());
  RuntimeUnderTest runtime;
  runtime.start();
  for (std::uint32_t frame = 0; frame < 5; ++frame) {
    const Points points = frame == 3 ? Points() : with_no_returns(room_points(frame));
    ASSERT_EQ(runtime.push(points, 100 * kMs * frame), POSE_WALL_OK);
    runtime.wait_idle();
    const pose_wall_publication p = runtime.latest();
    expect_same(p.result, engine.process(cloud_of(points, 100 * kMs * frame)));
    EXPECT_EQ(p.frame, frame);
    EXPECT_EQ(p.index, frame);
    EXPECT_EQ(p.cause, POSE_WALL_RUNTIME_FRAME);
    EXPECT_EQ(p.thinning, 1U);
  }
  EXPECT_GE(runtime.latest().result.quantity[POSE_WALL_YAW].state, POSE_WALL_DEGRADED);
  ASSERT_EQ(runtime.published().size(), 5U);
  expect_same(runtime.published()[4].result, runtime.latest().result);
}

// A side that is blocked right before the sensor is told by its share of what came back, with the no-returns or
// without.
TEST(RuntimeQueue, ABlockedSideIsToldAsTheEngineTellsIt) {
  Points points;
  for (const std::array<float, 3>& p : room_points(1)) {
    if (p[1] < std::fabs(p[0])) points.push_back(p);  // nothing comes from the left
  }
  const std::size_t near = points.size() / 25, none = 5 * points.size();
  points.insert(points.end(), near, {0.0F, 0.1F, 0.0F});
  points.insert(points.end(), none, {0.0F, 0.0F, 0.0F});
  ASSERT_LT(near, (points.size()) / 50) << "less than the share of all points";
  EngineUnderTest engine(small_config());
  RuntimeUnderTest runtime(
      [&](pose_wall_runtime_options* o) { o->cloud_points_max = static_cast<std::uint32_t>(points.size()); });
  runtime.start();
  ASSERT_EQ(runtime.push(points, 0), POSE_WALL_OK);
  runtime.wait_idle();
  const pose_wall_result told = runtime.latest().result;
  expect_same(told, engine.process(cloud_of(points, 0)));
  EXPECT_NE(told.quantity[POSE_WALL_D_LF].reasons & POSE_WALL_R_WALL_TOO_NEAR, 0U);
}

TEST(RuntimeQueue, EmptyRowsMayBeAnyNumber) {
  RuntimeUnderTest runtime;
  runtime.start();
  pose_wall_cloud cloud = cloud_of({}, 0);
  cloud.height = 0xFFFFFFFFU;
  ASSERT_EQ(pose_wall_runtime_push(runtime.get(), &cloud), POSE_WALL_OK);
  runtime.wait_idle();
  EXPECT_EQ(runtime.latest().result.points_in, 0U);
}

TEST(RuntimeQueue, WhateverTheLayout) {
  Points points = with_no_returns(room_points(1));
  while (points.size() % 4 != 0) points.pop_back();
  for (const CloudLayout layout : {CloudLayout{}, CloudLayout{true, false, 3, 0, 5, 4, 9},
                                   CloudLayout{false, true, 1, 5, 2, 2, 0}, CloudLayout{true, true, 0, 0, 0, 1, 0}}) {
    const EncodedCloud encoded = encode(points, layout, 5);
    EngineUnderTest engine(small_config());
    RuntimeUnderTest runtime([](pose_wall_runtime_options* o) { o->point_bytes_max = 24; });
    runtime.start();
    ASSERT_EQ(pose_wall_runtime_push(runtime.get(), &encoded.cloud), POSE_WALL_OK);
    runtime.wait_idle();
    expect_same(runtime.latest().result, engine.process(encoded.cloud));
  }
}

// With intensity as a weight, no-returns count in the mean, so none may be left out.
TEST(RuntimeQueue, WithIntensity) {
  const Points points = with_no_returns(room_points(1));
  std::vector<std::array<float, 4>> lit;
  for (std::size_t i = 0; i < points.size(); ++i) {
    lit.push_back({points[i][0], points[i][1], points[i][2], static_cast<float>(i % 100)});
  }
  pose_wall_cloud cloud;
  pose_wall_cloud_xyz32(&cloud, lit.data(), static_cast<std::uint32_t>(lit.size()), 16, 5);
  cloud.intensity = {12, POSE_WALL_FIELD_FLOAT32};
  pose_wall_config config = small_config();
  set(&config, "intensity_weight", 0.7);
  EngineUnderTest engine(config);
  RuntimeUnderTest runtime(nullptr, config);
  runtime.start();
  ASSERT_EQ(pose_wall_runtime_push(runtime.get(), &cloud), POSE_WALL_OK);
  runtime.wait_idle();
  expect_same(runtime.latest().result, engine.process(cloud));
}

// A brightness from 0 to 99 in the bytes of any type.
void store_brightness(std::uint32_t type, std::uint32_t brightness, unsigned char* to) {
  const auto single = static_cast<float>(brightness);
  const auto number = static_cast<double>(brightness);
  if (type == POSE_WALL_FIELD_FLOAT32) {
    std::memcpy(to, &single, sizeof single);
  } else if (type == POSE_WALL_FIELD_FLOAT64) {
    std::memcpy(to, &number, sizeof number);
  } else {
    to[0] = static_cast<unsigned char>(brightness);  // whole numbers, low byte first
  }
}

TEST(RuntimeQueue, WithIntensityOfAnyTypeOrNone) {
  constexpr std::uint32_t kStep = 20;
  const Points points = with_no_returns(room_points(1));
  pose_wall_config config = small_config();
  set(&config, "intensity_weight", 0.7);
  EngineUnderTest engine(config);
  RuntimeUnderTest runtime([](pose_wall_runtime_options* o) { o->point_bytes_max = kStep; }, config);
  runtime.start();
  for (std::uint32_t type = POSE_WALL_FIELD_NONE; type <= POSE_WALL_FIELD_FLOAT64; ++type) {
    std::vector<unsigned char> bytes(points.size() * kStep, 0);
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::memcpy(&bytes[i * kStep], points[i].data(), 12);
      store_brightness(type, static_cast<std::uint32_t>(i % 100), &bytes[i * kStep + 12]);
    }
    pose_wall_cloud cloud;
    pose_wall_cloud_xyz32(&cloud, bytes.data(), static_cast<std::uint32_t>(points.size()), kStep, 5 + type);
    cloud.intensity = {12, type};
    ASSERT_EQ(pose_wall_runtime_push(runtime.get(), &cloud), POSE_WALL_OK) << type;
    runtime.wait_idle();
    expect_same(runtime.latest().result, engine.process(cloud));
  }
}

TEST(RuntimeQueue, TheNewestWin) {
  RuntimeUnderTest runtime([](pose_wall_runtime_options* o) { o->queue_frames = 3; });
  runtime.gate.shut();
  runtime.start();
  const Points few(3, {1, 1, 1});
  runtime.push(few, 0);
  runtime.gate.wait_until_somebody_is_inside();
  for (std::int64_t stamp = 1; stamp <= 8; ++stamp) EXPECT_EQ(runtime.push(few, stamp), POSE_WALL_OK);
  pose_wall_runtime_statistics s = runtime.statistics();
  EXPECT_EQ(s.pushed, 9U);
  EXPECT_EQ(s.processed, 0U) << "the first is still in the callback";
  EXPECT_EQ(s.in_work, 1U);
  EXPECT_EQ(s.waiting, 3U);
  EXPECT_EQ(s.dropped[POSE_WALL_RUNTIME_DROP_OVERTAKEN], 5U);
  EXPECT_TRUE(accounts_balance(s));
  runtime.gate.open();
  runtime.wait_idle();
  s = runtime.statistics();
  EXPECT_EQ(s.processed, 4U);
  EXPECT_EQ(s.waiting_worst, 3U);
  EXPECT_TRUE(accounts_balance(s));
  std::vector<std::int64_t> stamps;
  for (const pose_wall_publication& p : runtime.published()) stamps.push_back(p.result.stamp_ns);
  EXPECT_EQ(stamps, (std::vector<std::int64_t>{0, 6, 7, 8}));
}

TEST(RuntimeQueue, EveryRefusalIsCountedUnderItsReason) {
  RuntimeUnderTest runtime([](pose_wall_runtime_options* o) { o->cloud_points_max = 100; });
  runtime.start();
  const Points many(101, {1, 1, 1}), enough(100, {1, 1, 1});
  pose_wall_cloud cloud = cloud_of(enough, 0);
  cloud.data_bytes = 7;
  EXPECT_EQ(pose_wall_runtime_push(runtime.get(), &cloud), POSE_WALL_E_CLOUD_SIZE);
  cloud.struct_size = 0;
  EXPECT_EQ(pose_wall_runtime_push(runtime.get(), &cloud), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(runtime.push(many, 0), POSE_WALL_RUNTIME_E_LARGE);
  const EncodedCloud wide = encode(enough, CloudLayout{true, false, 0, 0, 0, 1, 0}, 0);
  EXPECT_EQ(pose_wall_runtime_push(runtime.get(), &wide.cloud), POSE_WALL_RUNTIME_E_LARGE) << "24 bytes a point";
  EXPECT_EQ(runtime.push(enough, 0), POSE_WALL_OK);
  runtime.wait_idle();
  const pose_wall_runtime_statistics s = runtime.statistics();
  EXPECT_EQ(s.pushed, 5U);
  EXPECT_EQ(s.dropped[POSE_WALL_RUNTIME_DROP_DESCRIPTION], 2U);
  EXPECT_EQ(s.dropped[POSE_WALL_RUNTIME_DROP_LARGE], 2U);
  EXPECT_EQ(s.processed, 1U);
  EXPECT_TRUE(accounts_balance(s));
}

TEST(RuntimeQueue, TimesAreThoseOfTheClock) {
  RuntimeUnderTest runtime;
  runtime.in_callback = [&] { runtime.clock.advance(5 * kMs); };
  runtime.gate.shut();
  runtime.start();
  const Points few(3, {1, 1, 1});
  runtime.push(few, 0);
  runtime.gate.wait_until_somebody_is_inside();
  runtime.push(few, 1);
  runtime.clock.advance(40 * kMs);
  runtime.gate.open();
  runtime.wait_idle();
  const pose_wall_runtime_statistics s = runtime.statistics();
  EXPECT_EQ(s.wait.count, 2U);
  EXPECT_EQ(s.wait.worst_ns, 40 * kMs);
  EXPECT_EQ(s.latency.worst_ns, 40 * kMs);
  EXPECT_EQ(s.callback.worst_ns, 45 * kMs);
  EXPECT_EQ(s.work.worst_ns, 0);
  EXPECT_EQ(s.newest_age_ns, 45 * kMs) << "received when 5 ms had passed, now it is 50";
}

}  // namespace
}  // namespace pose_wall::test
