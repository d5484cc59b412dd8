// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a result that is old, of silence or missing makes the daemon not ready, and then nothing may steer and no
// value is told. A thread that hangs makes it not live. Texts of others, as names of parts, cannot break the metrics.
// Their format is judged by a parser of others: monitor_peer.py.

#include "apps/live/page/probes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "apps/live/page/open_metrics.hpp"
#include "pose_wall.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr std::int64_t kNow_ns = 50'000'000'000;  // any, and later than all ages of these tests

// All seven values valid, of a frame that was published 0.1 s ago.
Moment good_moment() {
  Moment moment;
  moment.now_ns = kNow_ns;
  moment.parts = {{"runtime", Grade::kGood, "measures", {{"age ms", "12.5"}, {"activity", "waits"}}},
                  {"source udp", Grade::kGood, "receives", {{"packets", "75"}}}};
  LiveResult result;
  const api::Config config;
  result.config = *config.get();
  result.publication.cause = POSE_WALL_RUNTIME_FRAME;
  result.publication.published_ns = kNow_ns - 100'000'000;
  for (pose_wall_value& value : result.publication.result.quantity) {
    value.state = value.raw_state = POSE_WALL_VALID;
    value.value = value.raw = 0.25;
    value.protection_level = value.raw_protection_level = 0.001;
    value.sigma = std::numeric_limits<double>::quiet_NaN();
  }
  moment.newest = result;
  return moment;
}

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

TEST(Probes, AFreshFrameIsReady) {
  const Probe probe = ready_probe(good_moment());
  EXPECT_TRUE(probe.is_well);
  EXPECT_EQ(probe_json("ready", probe), R"({"schema":1,"ready":true,"why":[]})");
}

TEST(Probes, WhatIsOldOrSilentOrMissingIsNotReadyAndSaysWhy) {
  Moment moment = good_moment();
  moment.newest.reset();
  EXPECT_EQ(ready_probe(moment).why.at(0), "nothing was published yet");
  moment = good_moment();
  moment.now_ns += 950'000'000;
  EXPECT_EQ(ready_probe(moment).why.at(0), "the newest result is older than a second");
  moment = good_moment();
  moment.newest->publication.cause = POSE_WALL_RUNTIME_SILENCE;
  moment.parts[1] = {"source udp", Grade::kBad, "the sensor is silent", {}};
  const Probe silent = ready_probe(moment);
  EXPECT_FALSE(silent.is_well);
  EXPECT_EQ(silent.why, (std::vector<std::string>{"no frame comes", "source udp: the sensor is silent"}));
  EXPECT_TRUE(live_probe(moment).is_well) << "a silent sensor is no reason to be started anew";
}

TEST(Probes, AThreadThatHangsIsNotLive) {
  Moment moment = good_moment();
  moment.hung = {"the obstacle stop hangs"};
  EXPECT_FALSE(live_probe(moment).is_well);
  EXPECT_EQ(probe_json("live", live_probe(moment)), R"({"schema":1,"live":false,"why":["the obstacle stop hangs"]})");
}

TEST(Metrics, AFreshResultHasValuesAndMaySteer) {
  const std::string text = metrics_text(good_moment());
  EXPECT_TRUE(has_line(text, "pose_wall_may_steer{value=\"yaw\"} 1"));
  EXPECT_TRUE(has_line(text, "pose_wall_angle_radians{value=\"yaw\"} 0.25"));
  EXPECT_TRUE(has_line(text, "pose_wall_distance_protection_level_meters{value=\"d_lf\"} 0.001"));
  EXPECT_TRUE(has_line(text, "pose_wall_value_state{value=\"yaw\",pose_wall_value_state=\"valid\"} 1"));
  EXPECT_TRUE(has_line(text, "pose_wall_result_age_seconds 0.1"));
  EXPECT_TRUE(has_line(text, "pose_wall_part_fact{part=\"runtime\",fact=\"age ms\"} 12.5"));
  EXPECT_EQ(text.find("fact=\"activity\""), std::string::npos) << "no number";
  EXPECT_EQ(text.find("nan"), std::string::npos) << "what is not known is left out";
  EXPECT_EQ(text.substr(text.size() - 6), "# EOF\n");
}

TEST(Metrics, AnOldResultHasNoValuesAndNothingMaySteer) {
  Moment moment = good_moment();
  moment.now_ns += 2'000'000'000;
  const std::string text = metrics_text(moment);
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const std::string name = pose_wall_quantity_name(q);
    EXPECT_TRUE(has_line(text, "pose_wall_may_steer{value=\"" + name + "\"} 0"));
    EXPECT_TRUE(has_line(text, "pose_wall_value_state{value=\"" + name + "\",pose_wall_value_state=\"invalid\"} 1"));
  }
  EXPECT_EQ(text.find("pose_wall_angle_radians{"), std::string::npos);
  EXPECT_EQ(text.find("pose_wall_distance_meters{"), std::string::npos);
  moment.newest.reset();
  EXPECT_EQ(metrics_text(moment).find("\npose_wall_result_age_seconds "), std::string::npos);
}

TEST(Metrics, AnInvalidValueIsNotTold) {
  Moment moment = good_moment();
  moment.newest->publication.result.quantity[POSE_WALL_ROLL].state = POSE_WALL_INVALID;
  const std::string text = metrics_text(moment);
  EXPECT_EQ(text.find("pose_wall_angle_radians{value=\"roll\"}"), std::string::npos);
  EXPECT_TRUE(has_line(text, "pose_wall_angle_radians{value=\"pitch\"} 0.25"));
}

TEST(Metrics, TextsOfOthersForgeNoLines) {
  Moment moment = good_moment();
  moment.parts = {{"a\"} 9\nb\\\xff\x01", Grade::kBad, "", {{"n\n", "1"}, {"n\n", "2"}}},
                  {"a\"} 9\nb\\\xff\x01", Grade::kBad, "", {{"n\n", "3"}}}};
  const std::string text = metrics_text(moment);
  EXPECT_TRUE(has_line(text, "pose_wall_part_fact{part=\"a\\\"} 9\\nb\\\\\xEF\xBF\xBD\",fact=\"n\\n\"} 2")) << text;
  EXPECT_EQ(text.find("} 3\n"), std::string::npos) << "each name comes once";
}

}  // namespace
}  // namespace pose_wall::tools::live
