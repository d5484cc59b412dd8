// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the last value that a broker keeps tells its age and its end. Without a fresh result it has no values, and
// nothing may steer by it.

#include "apps/live/mqtt/last_value.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "pose_wall.hpp"

namespace pose_wall::tools::live {
namespace {

// Any: 50 s after a start, in January 2027.
constexpr std::int64_t kPublished_ns = 50'000'000'000, kWall_ns = 1'800'000'000'000'000'000;

Newest good_newest() {
  Newest newest;
  newest.status = POSE_WALL_OK;
  LiveResult& result = newest.result;
  const api::Config config;
  result.config = *config.get();
  result.publication.cause = POSE_WALL_RUNTIME_FRAME;
  result.publication.received_ns = kPublished_ns - 40'000'000;
  result.publication.published_ns = kPublished_ns;
  result.publication.age_ns = 100'000'000;
  for (pose_wall_value& value : result.publication.result.quantity) {
    value.state = value.raw_state = POSE_WALL_VALID;
    value.value = 0.25;
    value.protection_level = 0.001;
  }
  return newest;
}

nlohmann::json told(const Newest& newest, std::int64_t later_ns) {
  return nlohmann::json::parse(last_value(newest, kPublished_ns + later_ns, kWall_ns).json);
}

TEST(LastValue, OfAFreshFrameTellsAgeAndEnd) {
  const nlohmann::json last = told(good_newest(), 60'000'000);
  EXPECT_EQ(last["state"], "live");
  EXPECT_EQ(last["schema"], 1);
  EXPECT_NEAR(last["age_s"], 0.1, 1e-9);
  EXPECT_EQ(last["told_at_ns"], kWall_ns);
  EXPECT_EQ(last["valid_until_ns"], kWall_ns + 3'000'000'000);
  EXPECT_EQ(last["may_steer"].size(), std::size_t{POSE_WALL_QUANTITIES});
  EXPECT_EQ(last["values"]["yaw"]["value_rad"], 0.25);
  EXPECT_NEAR(last["values"]["yaw"]["age_s"], 0.1, 1e-9) << "from its frame's reception until now";
  EXPECT_EQ(last["values"]["d_lf"]["protection_level_m"], 0.001);
  EXPECT_EQ(std::string(last["line"]["en"]).rfind("may steer: roll, ", 0), 0U);
}

TEST(LastValue, OfAWorkerThatHangsHasNoValues) {
  Newest newest = good_newest();
  newest.status = POSE_WALL_RUNTIME_E_STALE;
  newest.result.publication.age_ns = 1'540'000'000;
  const nlohmann::json last = told(newest, 1'500'000'000);
  EXPECT_EQ(last["state"], "stale");
  EXPECT_NEAR(last["age_s"], 1.54, 1e-9);
  EXPECT_TRUE(last["may_steer"].empty());
  EXPECT_TRUE(last["values"].empty());
  EXPECT_EQ(last["line"]["zh"], "可用于控制：无。没有结果，或结果已陈旧。");
}

TEST(LastValue, OfSilenceIsTold) {
  Newest newest = good_newest();
  newest.result.publication.cause = POSE_WALL_RUNTIME_SILENCE;
  for (pose_wall_value& value : newest.result.publication.result.quantity) value.state = POSE_WALL_INVALID;
  const nlohmann::json last = told(newest, 0);
  EXPECT_EQ(last["state"], "silent");
  EXPECT_TRUE(last["may_steer"].empty());
  EXPECT_TRUE(last["values"]["yaw"]["value_rad"].is_null());
}

TEST(LastValue, BeforeTheFirstResultAndAfterTheEndThereIsNone) {
  const nlohmann::json none = told({}, 0), gone = nlohmann::json::parse(no_last_value());
  EXPECT_EQ(none["state"], "stale");
  EXPECT_TRUE(none["age_s"].is_null());
  EXPECT_EQ(gone["state"], "gone");
  EXPECT_TRUE(gone["may_steer"].empty());
  EXPECT_TRUE(gone["valid_until_ns"].is_null());
  Newest never = good_newest();
  never.result.publication.age_ns = INT64_MAX;  // the clock went back
  EXPECT_TRUE(told(never, 10)["age_s"].is_null());
}

TEST(LastValue, WhatChangesItIsToldAtOnce) {
  Newest newest = good_newest();
  const std::string all = last_value(newest, kPublished_ns, kWall_ns).gist;
  EXPECT_EQ(last_value(newest, kPublished_ns + 200'000'000, kWall_ns + 200'000'000).gist, all);
  newest.result.publication.result.quantity[POSE_WALL_YAW].state = POSE_WALL_DEGRADED;
  EXPECT_NE(last_value(newest, kPublished_ns, kWall_ns).gist, all);
  EXPECT_EQ(with_end("{\"a\":1}", 5), "{\"a\":1,\"valid_until_ns\":3000000005}");
}

}  // namespace
}  // namespace pose_wall::tools::live
