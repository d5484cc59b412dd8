// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: between frames the engine tells what a frame without a measurement would tell at that time, bit for bit;
// asking changes no later frame, except that what was told invalid is not held again.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"
#include "support/room.hpp"

namespace pose_wall::test {
namespace {

constexpr std::int64_t kMs = 1000000;

pose_wall_result age(EngineUnderTest* engine, std::int64_t stamp_ns) {
  pose_wall_result result{};
  result.struct_size = sizeof result;
  EXPECT_EQ(pose_wall_age(engine->get(), stamp_ns, &result), POSE_WALL_OK);
  return result;
}

// Everything but the reasons, which tell the two apart.
void expect_same_values(pose_wall_result aged, pose_wall_result framed) {
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    EXPECT_EQ(aged.quantity[q].reasons & ~std::uint32_t{POSE_WALL_R_NO_FRAME},
              framed.quantity[q].reasons & POSE_WALL_R_HOLD_EXPIRED);
    aged.quantity[q].reasons = framed.quantity[q].reasons = 0;
  }
  EXPECT_EQ(std::memcmp(aged.quantity, framed.quantity, sizeof aged.quantity), 0);
  EXPECT_EQ(aged.confidence, framed.confidence);
  EXPECT_EQ(aged.stamp_ns, framed.stamp_ns);
}

TEST(Age, TellsWhatAFrameThatMeasuresNothingWould) {
  const Points room = room_points(1);
  bool held = false, invalid = false;
  for (const std::int64_t ms : {1, 50, 100, 400, 900, 1999, 2001, 60000}) {
    EngineUnderTest asked(small_config()), shown(small_config());
    asked.process(cloud_of(room, 7 * kMs));
    ASSERT_GE(shown.process(cloud_of(room, 7 * kMs)).quantity[POSE_WALL_D_LF].state, POSE_WALL_DEGRADED);
    const pose_wall_result aged = age(&asked, (7 + ms) * kMs);
    expect_same_values(aged, shown.process(cloud_of(Points(), (7 + ms) * kMs)));
    EXPECT_EQ(aged.frame_reasons, POSE_WALL_R_NO_FRAME);
    EXPECT_EQ(aged.frame_index, 0U);
    held = held || aged.quantity[POSE_WALL_D_LF].state == POSE_WALL_HELD;
    invalid = invalid || aged.quantity[POSE_WALL_D_LF].state == POSE_WALL_INVALID;
  }
  EXPECT_TRUE(held && invalid);
}

TEST(Age, TheNextFrameDoesNotNotice) {
  EngineUnderTest asked(small_config()), left_alone(small_config());
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    const Points room = room_points(frame);
    const std::int64_t stamp_ns = 100 * kMs * frame;
    pose_wall_result one = asked.process(cloud_of(room, stamp_ns));
    pose_wall_result two = left_alone.process(cloud_of(room, stamp_ns));
    EXPECT_EQ(one.publication, 3 * two.publication - 2) << "two of its results were told in between";
    one.publication = two.publication = one.mark = two.mark = 0;
    EXPECT_EQ(std::memcmp(&one, &two, sizeof one), 0) << "frame " << frame;
    age(&asked, stamp_ns + 60 * kMs);
    age(&asked, stamp_ns + 90 * kMs);
  }
}

TEST(Age, WhatWasToldInvalidIsNotHeldAgain) {
  EngineUnderTest asked(small_config()), left_alone(small_config());
  const Points room = room_points(1);
  asked.process(cloud_of(room, 0));
  left_alone.process(cloud_of(room, 0));
  EXPECT_EQ(age(&asked, 10000 * kMs).quantity[POSE_WALL_D_LF].state, POSE_WALL_INVALID);
  EXPECT_EQ(age(&asked, 1 * kMs).quantity[POSE_WALL_D_LF].state, POSE_WALL_INVALID);
  // The sensor's clock says that only 100 ms have passed.
  EXPECT_EQ(asked.process(cloud_of(Points(), 100 * kMs)).quantity[POSE_WALL_D_LF].state, POSE_WALL_INVALID);
  EXPECT_EQ(left_alone.process(cloud_of(Points(), 100 * kMs)).quantity[POSE_WALL_D_LF].state, POSE_WALL_HELD);
  EXPECT_GE(asked.process(cloud_of(room, 200 * kMs)).quantity[POSE_WALL_D_LF].state, POSE_WALL_DEGRADED);
}

TEST(Age, BeforeTheFirstFrameNothingIsKnown) {
  EngineUnderTest engine(small_config());
  const pose_wall_result aged = age(&engine, 5);
  EXPECT_EQ(aged.frame_index, std::numeric_limits<std::uint64_t>::max()) << "not that of the first frame";
  for (const pose_wall_value& v : aged.quantity) {
    EXPECT_EQ(v.state, POSE_WALL_INVALID);
    EXPECT_EQ(v.reasons, POSE_WALL_R_NEVER_MEASURED | POSE_WALL_R_NO_FRAME);
    EXPECT_TRUE(std::isnan(v.value) && std::isnan(v.raw) && std::isnan(v.sigma) && std::isnan(v.protection_level));
    EXPECT_EQ(v.confidence, 0.0);
  }
}

TEST(Age, BackwardsNothingAges) {
  EngineUnderTest engine(small_config());
  engine.process(cloud_of(room_points(1), 1000 * kMs));
  for (const std::int64_t stamp_ns : {1000 * kMs, 999 * kMs, std::numeric_limits<std::int64_t>::min()}) {
    const pose_wall_value v = age(&engine, stamp_ns).quantity[POSE_WALL_D_LF];
    EXPECT_EQ(v.state, POSE_WALL_HELD);
    EXPECT_EQ(v.age_s, 0.0);
  }
}

}  // namespace
}  // namespace pose_wall::test
