// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what comes and goes between two looks is counted. A result that is not followed by another one counts only as
// long as it holds. Latencies of frames are counted step by step, and those of silence are none.

#include "apps/live/result_counts.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "pose_wall.hpp"

namespace pose_wall::tools::live {
namespace {

// The runtime's watchdog: pose_wall_runtime.h.
constexpr std::int64_t kCountMs_ns = 1'000'000, kStaleAfter_ns = 300 * kCountMs_ns;

TEST(StateTimes, TellHowLongEachStateWas) {
  StateTimes times(3, 0, 0);
  EXPECT_EQ(times.until(10), (std::vector<std::int64_t>{10, 0, 0})) << "unknown before the first note";
  times.note(2, 10, 100);
  times.note(1, 30, 100);
  EXPECT_EQ(times.until(40), (std::vector<std::int64_t>{10, 10, 20}));
  EXPECT_EQ(times.until(150), (std::vector<std::int64_t>{60, 70, 20})) << "it holds up to 100";
  times.note(2, 160, 200);
  EXPECT_EQ(times.until(170), (std::vector<std::int64_t>{70, 70, 30}));
}

TEST(StateTimes, NeverGoBack) {
  StateTimes times(2, 0, 100);
  EXPECT_EQ(times.until(50), (std::vector<std::int64_t>{0, 0})) << "a clock that is behind";
  times.note(1, 200, 150);
  EXPECT_EQ(times.until(250), (std::vector<std::int64_t>{150, 0})) << "it never held";
  times.note(1, 190, 400);
  EXPECT_EQ(times.until(300), (std::vector<std::int64_t>{150, 50})) << "what was told of 200 to 250 stays";
}

LiveResult result_at(std::int64_t ms, std::uint32_t state, std::int64_t latency_ms = 40) {
  LiveResult result;
  const api::Config config;
  result.config = *config.get();
  result.publication.cause = POSE_WALL_RUNTIME_FRAME;
  result.publication.published_ns = ms * kCountMs_ns;
  result.publication.received_ns = (ms - latency_ms) * kCountMs_ns;
  for (pose_wall_value& value : result.publication.result.quantity) {
    value.state = POSE_WALL_VALID;
    value.protection_level = 0.001;
  }
  result.publication.result.quantity[POSE_WALL_YAW].state = state;
  return result;
}

TEST(ResultCounts, ASecondWithoutSteeringIsSeenByWhoLooksLater) {
  ResultCounts counts(kStaleAfter_ns, 0);
  counts.note(result_at(100, POSE_WALL_VALID));
  for (std::int64_t ms = 200; ms <= 1200; ms += 100) counts.note(result_at(ms, POSE_WALL_INVALID));
  for (std::int64_t ms = 1300; ms <= 5000; ms += 100) counts.note(result_at(ms, POSE_WALL_VALID));
  const ResultSums sums = counts.until(5050 * kCountMs_ns);
  EXPECT_EQ(sums.not_steering_ns[POSE_WALL_YAW], (100 + 1100) * kCountMs_ns)
      << "before the first one, and 200 to 1300 ms";
  EXPECT_EQ(sums.not_steering_ns[POSE_WALL_ROLL], 100 * kCountMs_ns);
}

TEST(ResultCounts, AWorkerThatHangsDoesNotSteerOnceItsLastResultIsStale) {
  ResultCounts counts(kStaleAfter_ns, 0);
  counts.note(result_at(100, POSE_WALL_VALID, 40));
  EXPECT_EQ(counts.until(360 * kCountMs_ns).not_steering_ns[POSE_WALL_YAW], 100 * kCountMs_ns);
  EXPECT_EQ(counts.until(1360 * kCountMs_ns).not_steering_ns[POSE_WALL_YAW], 1100 * kCountMs_ns)
      << "300 ms after its reception";
}

TEST(ResultCounts, LatenciesOfFramesAreCountedStepByStep) {
  ResultCounts counts(kStaleAfter_ns, 0);
  for (const std::int64_t latency_ms : {2, 3, 40, 250, 900}) {
    counts.note(result_at(1000, POSE_WALL_VALID, latency_ms));
  }
  LiveResult silence = result_at(2000, POSE_WALL_INVALID, 40);
  silence.publication.cause = POSE_WALL_RUNTIME_SILENCE;
  counts.note(silence);
  const ResultSums sums = counts.until(2000 * kCountMs_ns);
  EXPECT_EQ(std::accumulate(sums.latency.begin(), sums.latency.end(), std::uint64_t{0}), 5U);
  EXPECT_EQ(sums.latency[0], 1U) << "up to 2 ms, with its end";
  EXPECT_EQ(sums.latency[1], 1U);
  EXPECT_EQ(sums.latency[5], 1U) << "up to 50 ms";
  EXPECT_EQ(sums.latency[9], 1U);
  EXPECT_EQ(sums.latency.back(), 1U);
  EXPECT_EQ(sums.latency_sum_ns, 1195 * kCountMs_ns);
}

}  // namespace
}  // namespace pose_wall::tools::live
