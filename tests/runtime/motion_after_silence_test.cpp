// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: after a silence in which the machine went elsewhere, the runtime's yaw is valid again as soon with motion as
// without, and no frame comes late. The runtime's clock goes by the processor time of motion, with an ordinary frame of
// it as 10 ms, so that the machine's own speed does not count.

#include <gtest/gtest.h>
#include <time.h>

#include <cmath>
#include <random>

#include "pose_wall_motion.h"
#include "support/runtime_under_test.hpp"

namespace pose_wall::test {
namespace {

constexpr std::int64_t kPeriod_ns = 100 * kMs, kOrdinary_ns = 10 * kMs;
constexpr int kBefore = 6, kAfter = 20;

std::int64_t worked_ns() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return t.tv_sec * std::int64_t{1000000000} + t.tv_nsec;
}

// Of the motion that is under test now: functions of C have no other place for it.
StandingClock* clock_now = nullptr;
std::int64_t ordinary_ns = 0;  // processor time of the cheapest frame so far

std::int32_t process_by_clock(pose_wall_motion* motion, const pose_wall_cloud* cloud, pose_wall_motion_result* result) {
  const std::int64_t begin_ns = worked_ns();
  const std::int32_t status = pose_wall_motion_process(motion, cloud, result);
  const std::int64_t took_ns = worked_ns() - begin_ns;
  if (ordinary_ns == 0 || took_ns < ordinary_ns) ordinary_ns = took_ns;
  clock_now->advance(took_ns * kOrdinary_ns / ordinary_ns);
  return status;
}

const pose_wall_motion_functions* timed_motion() {
  static pose_wall_motion_functions functions = *pose_wall_motion_functions_get();
  functions.process = process_by_clock;
  return &functions;
}

// A road of rough walls, as 32 rings see it.
Points road(double along_m, double half_m, double yaw_rad) {
  std::mt19937 random(static_cast<std::uint32_t>(1000.0 * along_m) + 1);
  Points points;
  for (int ring = 0; ring < 32; ++ring) {
    for (int column = 0; column < 600; ++column) {
      const double up = (-22.5 + 45.0 * ring / 31) * M_PI / 180.0, azimuth = 2.0 * M_PI * column / 600;
      const double x = std::cos(up) * std::cos(azimuth), y = std::cos(up) * std::sin(azimuth), z = std::sin(up);
      double range = half_m / std::fabs(y);
      for (int round = 0; round < 4 && range < 60.0; ++round) {
        const double at = range * x + along_m, height = range * z, side = y > 0.0 ? 0.0 : 2.0;
        const double rock = 0.06 * std::sin(2.1 * at + 1.3 * height + side) + 0.05 * std::sin(5.3 * at - 3.1 * height) +
                            0.03 * std::sin(11.7 * at + 7.0 * height + side);
        range = (half_m - rock) / std::fabs(y);
      }
      range = std::fmin(range, (z < 0.0 ? 1.2 : 2.0) / std::fabs(z));
      if (!(range < 60.0)) continue;
      range += 0.02 * (static_cast<double>(random()) / 4294967296.0 - 0.5);
      const double c = std::cos(yaw_rad), s = std::sin(yaw_rad);
      points.push_back({static_cast<float>(range * (c * x + s * y)), static_cast<float>(range * (c * y - s * x)),
                        static_cast<float>(range * z)});
    }
  }
  return points;
}

// How many frames after the silence yaw is valid; those that come while the worker is busy are overtaken.
int first_valid(const std::vector<Points>& frames, std::int64_t silence_ns, bool with_motion) {
  RuntimeUnderTest runtime([with_motion](pose_wall_runtime_options* o) {
    if (with_motion) o->motion = timed_motion();
  });
  clock_now = &runtime.clock;
  runtime.start();
  const std::int64_t start_ns = StandingClock::read(&runtime.clock);
  int first = -1;
  for (int i = 0; i < kBefore + kAfter; ++i) {
    const std::int64_t due_ns = start_ns + (i + 1) * kPeriod_ns + (i < kBefore ? 0 : silence_ns);
    const std::int64_t early_ns = due_ns - StandingClock::read(&runtime.clock);
    if (early_ns < -kPeriod_ns) continue;
    if (early_ns > 0) runtime.pass(early_ns);
    EXPECT_EQ(runtime.push(frames[static_cast<std::size_t>(i)], due_ns), POSE_WALL_OK);
    runtime.wait_idle();
    const pose_wall_publication p = runtime.latest();
    const bool is_valid =
        p.cause == POSE_WALL_RUNTIME_FRAME && p.result.quantity[POSE_WALL_YAW].state == POSE_WALL_VALID;
    EXPECT_TRUE(is_valid || i != kBefore - 1) << "else nothing is lost by the silence";
    if (is_valid && i >= kBefore && first < 0) first = i - kBefore;
  }
  EXPECT_EQ(runtime.statistics().dropped[POSE_WALL_RUNTIME_DROP_LATE], 0U);
  runtime.stop();
  return first;
}

TEST(RuntimeMotion, YawIsValidAsSoonAfterASilenceAsWithoutMotion) {
  std::vector<Points> frames;
  for (int i = 0; i < kBefore; ++i) frames.push_back(road(0.05 * i, 2.4, 0.05));
  for (int i = 0; i < kAfter; ++i) frames.push_back(road(300.0 + 0.05 * i, 3.6, -0.2));
  for (const std::int64_t silence_ms : {1000, 5000, 600000}) {
    const int without = first_valid(frames, silence_ms * kMs, false),
              with = first_valid(frames, silence_ms * kMs, true);
    EXPECT_GE(without, 0) << silence_ms;
    EXPECT_GE(with, 0) << silence_ms;
    EXPECT_LE(with, without) << silence_ms;
  }
}

}  // namespace
}  // namespace pose_wall::test
