// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: numbers of the public enums are those that programs were built against; options out of range are refused one
// by one, by name, and at their limits they are taken. What else is refused is in tests/abi/refusals.

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <set>
#include <string>

#include "pose_wall_box.h"
#include "support/runtime_under_test.hpp"

namespace pose_wall::test {
namespace {

std::int32_t sink(void* /*user*/, std::uint64_t /*offset*/, const void* /*bytes*/, std::uint64_t /*count*/) {
  return 0;
}

TEST(RuntimeAbi, Numbers) {
  EXPECT_EQ(pose_wall_runtime_abi_version(), 3U);
  const int statuses[] = {POSE_WALL_RUNTIME_E_OPTION,  POSE_WALL_RUNTIME_E_HANDLE, POSE_WALL_RUNTIME_E_STATE,
                          POSE_WALL_RUNTIME_E_THREAD,  POSE_WALL_RUNTIME_E_BUSY,   POSE_WALL_RUNTIME_E_LARGE,
                          POSE_WALL_RUNTIME_E_NOTHING, POSE_WALL_RUNTIME_E_SYSTEM, POSE_WALL_RUNTIME_E_STALE,
                          POSE_WALL_RUNTIME_E_MOTION};
  for (int i = 0; i < 10; ++i) EXPECT_EQ(statuses[i], -100 - i);
  const int of_box[] = {POSE_WALL_BOX_E_FORMAT, POSE_WALL_BOX_E_VERSION, POSE_WALL_BOX_E_END,
                        POSE_WALL_BOX_E_EMPTY,  POSE_WALL_BOX_E_RUN,     POSE_WALL_BOX_E_KIND};
  for (int i = 0; i < 6; ++i) EXPECT_EQ(of_box[i], -90 - i);
  const int drops[] = {POSE_WALL_RUNTIME_DROP_DESCRIPTION, POSE_WALL_RUNTIME_DROP_LARGE,
                       POSE_WALL_RUNTIME_DROP_BUSY,        POSE_WALL_RUNTIME_DROP_OVERTAKEN,
                       POSE_WALL_RUNTIME_DROP_STOPPED,     POSE_WALL_RUNTIME_DROP_ENGINE,
                       POSE_WALL_RUNTIME_DROP_LATE,        POSE_WALL_RUNTIME_DROPS};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(drops[i], i);
  EXPECT_EQ(POSE_WALL_RUNTIME_FRAME, 1);
  EXPECT_EQ(POSE_WALL_RUNTIME_SILENCE, 2);
  const int activities[] = {POSE_WALL_RUNTIME_AT_NOTHING, POSE_WALL_RUNTIME_AT_WAIT,    POSE_WALL_RUNTIME_AT_CHOICE,
                            POSE_WALL_RUNTIME_AT_FRAME,   POSE_WALL_RUNTIME_AT_SILENCE, POSE_WALL_RUNTIME_AT_CALLBACK,
                            POSE_WALL_RUNTIME_ACTIVITIES};
  for (int i = 0; i < 7; ++i) EXPECT_EQ(activities[i], i);
}

TEST(RuntimeOptions, NullMeansTheDefaults) {
  pose_wall_config config;
  ASSERT_EQ(pose_wall_config_init(&config), POSE_WALL_OK);
  pose_wall_runtime_options options;
  ASSERT_EQ(pose_wall_runtime_options_init(&options), POSE_WALL_OK);
  std::uint64_t bytes = 0, of_null = 0;
  ASSERT_EQ(pose_wall_runtime_memory_needed(&config, &options, &bytes), POSE_WALL_OK);
  ASSERT_EQ(pose_wall_runtime_memory_needed(&config, nullptr, &of_null), POSE_WALL_OK);
  EXPECT_EQ(of_null, bytes);
  AlignedBlock block(bytes, Dirt::kRandom);
  pose_wall_runtime* runtime = nullptr;
  ASSERT_EQ(pose_wall_runtime_open(&config, nullptr, block.data(), block.size(), &runtime), POSE_WALL_OK);
  EXPECT_EQ(pose_wall_runtime_close(runtime), POSE_WALL_OK);
}

TEST(RuntimeAbi, EveryDropAndActivityHasAName) {
  std::set<std::string> names;
  for (std::uint32_t d = 0; d <= POSE_WALL_RUNTIME_DROPS; ++d) names.insert(pose_wall_runtime_drop_name(d));
  EXPECT_EQ(names.size(), POSE_WALL_RUNTIME_DROPS + 1U);
  std::set<std::string> activities;
  for (std::uint32_t a = 0; a <= POSE_WALL_RUNTIME_ACTIVITIES; ++a) {
    activities.insert(pose_wall_runtime_activity_name(a));
  }
  EXPECT_EQ(activities.size(), POSE_WALL_RUNTIME_ACTIVITIES + 1U);
}

TEST(RuntimeOptions, OutOfRange) {
  const pose_wall_config config = small_config();
  using Spoil = std::function<void(pose_wall_runtime_options*)>;
  constexpr std::int64_t kHour_ns = 3600000 * kMs;
  const struct {
    const char* option;
    Spoil change;
  } wrong[] = {
      {"queue_frames", [](auto* o) { o->queue_frames = 0; }},
      {"queue_frames", [](auto* o) { o->queue_frames = 65; }},
      {"cloud_points_max", [](auto* o) { o->cloud_points_max = 0; }},
      {"cloud_points_max", [](auto* o) { o->cloud_points_max = (1U << 26) + 1; }},
      {"point_bytes_max", [](auto* o) { o->point_bytes_max = 11; }},
      {"point_bytes_max", [](auto* o) { o->point_bytes_max = 49; }},
      {"thinning_max", [](auto* o) { o->thinning_max = 0; }},
      {"thinning_max", [](auto* o) { o->thinning_max = 3; }},
      {"thinning_max", [](auto* o) { o->thinning_max = 32; }},
      {"box_clouds", [](auto* o) { o->box_clouds = 2; }},
      {"box_backlog", [](auto* o) { o->box_backlog = 0; }},
      {"box_backlog", [](auto* o) { o->box_backlog = 65; }},
      {"worker_priority", [](auto* o) { o->worker_priority = -1; }},
      {"worker_priority", [](auto* o) { o->worker_priority = 100; }},
      {"worker_cpu", [](auto* o) { o->worker_cpu = -2; }},
      {"worker_cpu", [](auto* o) { o->worker_cpu = 1024; }},
      {"lock_memory", [](auto* o) { o->lock_memory = 2; }},
      {"required", [](auto* o) { o->required = 8; }},
      {"reserved", [](auto* o) { o->reserved = 1; }},
      {"reserved_2", [](auto* o) { o->reserved_2 = 1; }},
      {"frame_period_max_ns", [](auto* o) { o->frame_period_max_ns = 0; }},
      {"watchdog_ns", [](auto* o) { o->watchdog_ns = -1; }},
      {"watchdog_every_ns", [](auto* o) { o->watchdog_every_ns = 0; }},
      {"box_bytes", [](auto* o) { o->sink = sink; }},
      {"watchdog_ns", [](auto* o) { o->watchdog_ns = kHour_ns + 1; }},
      {"frame_period_max_ns", [](auto* o) { o->frame_period_max_ns = kMs - 1; }},
      {"frame_period_max_ns", [](auto* o) { o->frame_period_max_ns = kHour_ns + 1; }},
      {"watchdog_every_ns", [](auto* o) { o->watchdog_every_ns = kMs - 1; }},
      {"watchdog_every_ns", [](auto* o) { o->watchdog_every_ns = kHour_ns + 1; }},
  };
  for (const auto& [name, change] : wrong) {
    SCOPED_TRACE(name);
    pose_wall_runtime_options options;
    pose_wall_runtime_options_init(&options);
    std::uint64_t bytes = 7;
    ASSERT_EQ(pose_wall_runtime_memory_needed(&config, &options, &bytes), POSE_WALL_OK);
    const char* option = "untouched";
    EXPECT_EQ(pose_wall_runtime_options_check(&options, &option), POSE_WALL_OK);
    EXPECT_STREQ(option, "untouched");
    bytes = 7;
    change(&options);
    EXPECT_EQ(pose_wall_runtime_memory_needed(&config, &options, &bytes), POSE_WALL_RUNTIME_E_OPTION);
    EXPECT_EQ(bytes, 7U);
    EXPECT_EQ(pose_wall_runtime_options_check(&options, nullptr), POSE_WALL_RUNTIME_E_OPTION);
    EXPECT_EQ(pose_wall_runtime_options_check(&options, &option), POSE_WALL_RUNTIME_E_OPTION);
    EXPECT_STREQ(option, name);
  }
}

TEST(RuntimeOptions, AtTheirLimits) {
  const auto accepted = [](const std::function<void(pose_wall_runtime_options*)>& change) {
    pose_wall_runtime_options options;
    pose_wall_runtime_options_init(&options);
    change(&options);
    return pose_wall_runtime_options_check(&options, nullptr) == POSE_WALL_OK;
  };
  for (const std::int64_t ns : {kMs, 3600000 * kMs}) {
    EXPECT_TRUE(accepted([&](auto* o) { o->frame_period_max_ns = o->watchdog_ns = o->watchdog_every_ns = ns; }));
  }
  EXPECT_TRUE(accepted([](auto* o) { o->watchdog_ns = 0; }));
  EXPECT_TRUE(accepted([](auto* o) { o->watchdog_ns = 1; }));
  // The smallest black box, as the header says.
  const auto up = [](std::uint64_t bytes) { return (bytes + 63) / 64 * 64; };
  for (const std::uint32_t clouds : {0U, 1U}) {
    const std::uint64_t least = 4288 + up(sizeof(pose_wall_inputs)) + up(pose_wall_memento_bytes()) +
                                up(sizeof(pose_wall_result)) + up(sizeof(pose_wall_motion_result)) +
                                (clouds != 0 ? up(101 * 13) : 0);
    for (const std::uint64_t less : {0U, 1U}) {
      EXPECT_EQ(accepted([&](pose_wall_runtime_options* o) {
                  o->sink = sink;
                  o->box_clouds = clouds;
                  o->cloud_points_max = 101;
                  o->point_bytes_max = 13;
                  o->box_bytes = least - less;
                }),
                less == 0);
    }
  }
}

}  // namespace
}  // namespace pose_wall::test
