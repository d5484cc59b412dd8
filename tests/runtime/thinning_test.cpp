// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: with a worker too slow for the sensor, frames are dropped first; points only where the options allow it, and
// then every publication says so and is no better than degraded, also where it only holds what came of it; and it comes
// back by itself. The clock moves one step by each look, so that a frame "takes" what the test says (and the watchdog
// is off, which would look without end).

#include <gtest/gtest.h>

#include <algorithm>

#include "support/runtime_under_test.hpp"

namespace pose_wall::test {
namespace {

// Each worked frame while the callback of the one before holds the worker, so that frames are always dropped.
void overload(RuntimeUnderTest* runtime, int rounds, bool too_many) {
  static std::int64_t frame = 0;
  const auto push = [&] {
    ++frame;
    runtime->push(room_points(static_cast<std::uint32_t>(frame)), frame * 10 * kMs);
  };
  for (int i = 0; i < rounds; ++i) {
    runtime->gate.shut();
    push();
    runtime->gate.wait_until_somebody_is_inside();
    for (int k = 0; k < (too_many ? 4 : 1); ++k) push();
    runtime->gate.open();
    runtime->wait_idle();
  }
}

std::uint32_t best_state(const pose_wall_publication& p) {
  std::uint32_t best = 0;
  for (const pose_wall_value& v : p.result.quantity) best = std::max({best, v.state, v.raw_state});
  return best;
}

TEST(RuntimeThinning, OffUnlessAllowed) {
  RuntimeUnderTest runtime([](pose_wall_runtime_options* o) { o->watchdog_ns = 0; });
  runtime.clock.set_step(100 * kMs);
  runtime.start();
  overload(&runtime, 6, true);
  const pose_wall_runtime_statistics s = runtime.statistics();
  EXPECT_GT(s.dropped[POSE_WALL_RUNTIME_DROP_OVERTAKEN], 0U);
  EXPECT_EQ(s.thinned, 0U);
  EXPECT_EQ(s.thinning_worst, 1U);
  EXPECT_EQ(runtime.latest().thinning, 1U);
  EXPECT_EQ(runtime.latest().result.points_in, room_points(1).size());
}

// A slow reader is no reason to see less.
TEST(RuntimeThinning, TheCallbacksTimeCostsFramesAndNoPoints) {
  RuntimeUnderTest runtime([](pose_wall_runtime_options* o) {
    o->thinning_max = 16;
    o->watchdog_ns = 0;
  });
  runtime.in_callback = [&runtime] { runtime.clock.advance(500 * kMs); };
  runtime.start();
  overload(&runtime, 6, true);
  const pose_wall_runtime_statistics s = runtime.statistics();
  EXPECT_GT(s.dropped[POSE_WALL_RUNTIME_DROP_OVERTAKEN], 0U);
  EXPECT_GE(s.callback.p50_ns, 500 * kMs);
  EXPECT_EQ(s.thinning_worst, 1U);
}

TEST(RuntimeThinning, FramesGoFirstThenPointsAndItIsSaid) {
  RuntimeUnderTest runtime([](pose_wall_runtime_options* o) {
    o->thinning_max = 2;
    o->watchdog_ns = 0;
  });
  runtime.start();
  overload(&runtime, 3, true);
  EXPECT_EQ(runtime.statistics().thinning, 1U) << "no time passes in the engine: dropping is enough";
  EXPECT_EQ(best_state(runtime.latest()), static_cast<std::uint32_t>(POSE_WALL_VALID));
  runtime.clock.set_step(100 * kMs);
  overload(&runtime, 4, true);
  const pose_wall_publication p = runtime.latest();
  EXPECT_EQ(p.thinning, 2U);
  const double share = p.result.points_in / static_cast<double>(room_points(1).size());
  EXPECT_NEAR(share, 0.5, 0.02);
  EXPECT_EQ(best_state(p), static_cast<std::uint32_t>(POSE_WALL_DEGRADED)) << "measured, but never better than that";
  pose_wall_image image{};
  image.struct_size = sizeof image;
  EXPECT_EQ(pose_wall_image_fill(&p.result, &image), POSE_WALL_OK) << "a result that an engine made, all the same";
  EXPECT_EQ(image.verdict, static_cast<std::uint32_t>(POSE_WALL_DEGRADED));
  EXPECT_GT(runtime.statistics().thinned, 0U);
  EXPECT_EQ(p.held_thinning, 1U) << "nothing is held";
  runtime.clock.set_step(0);
  // A frame that measures nothing holds what the thinned ones gave.
  runtime.push({}, p.result.stamp_ns + 10 * kMs);
  runtime.wait_idle();
  EXPECT_EQ(runtime.latest().result.quantity[POSE_WALL_YAW].state, static_cast<std::uint32_t>(POSE_WALL_HELD));
  EXPECT_EQ(runtime.latest().held_thinning, 2U);
  overload(&runtime, 14, false);
  EXPECT_EQ(runtime.latest().thinning, 1U);
  EXPECT_EQ(best_state(runtime.latest()), static_cast<std::uint32_t>(POSE_WALL_VALID));
  EXPECT_EQ(runtime.statistics().thinning_worst, 2U);
  runtime.push({}, runtime.latest().result.stamp_ns + 10 * kMs);
  runtime.wait_idle();
  EXPECT_EQ(runtime.latest().result.quantity[POSE_WALL_YAW].state, static_cast<std::uint32_t>(POSE_WALL_HELD));
  EXPECT_EQ(runtime.latest().held_thinning, 1U) << "of a whole cloud again";
}

}  // namespace
}  // namespace pose_wall::test
