// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a result that is old, of silence or missing makes the daemon not ready, and then nothing may steer and no
// value is told. A thread that hangs makes it not live. Texts of others, as names of parts, cannot break the metrics.
// Their format is judged by a parser of others: monitor_peer.py.

#include "apps/live/page/probes.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <ctime>
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
  moment.newest.status = POSE_WALL_OK;
  LiveResult& result = moment.newest.result;
  const api::Config config;
  result.config = *config.get();
  result.publication.cause = POSE_WALL_RUNTIME_FRAME;
  result.publication.received_ns = kNow_ns - 150'000'000;
  result.publication.published_ns = kNow_ns - 100'000'000;
  for (pose_wall_value& value : result.publication.result.quantity) {
    value.state = value.raw_state = POSE_WALL_VALID;
    value.value = value.raw = 0.25;
    value.protection_level = value.raw_protection_level = 0.001;
    value.sigma = std::numeric_limits<double>::quiet_NaN();
  }
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
  moment.newest = {};
  EXPECT_EQ(ready_probe(moment).why.at(0), "nothing was published yet");
  moment = good_moment();
  moment.newest.status = POSE_WALL_RUNTIME_E_STALE;
  EXPECT_EQ(ready_probe(moment).why.at(0), "the newest result is stale");
  moment = good_moment();
  moment.newest.result.publication.cause = POSE_WALL_RUNTIME_SILENCE;
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
  EXPECT_NE(text.find("\npose_wall_value_age_seconds{value=\"yaw\"} 0.15"), std::string::npos) << "until now";
  EXPECT_TRUE(has_line(text, "pose_wall_part_fact{part=\"runtime\",fact=\"age ms\"} 12.5"));
  EXPECT_EQ(text.find("fact=\"activity\""), std::string::npos) << "no number";
  EXPECT_EQ(text.find("nan"), std::string::npos) << "what is not known is left out";
  EXPECT_EQ(text.substr(text.size() - 6), "# EOF\n");
}

TEST(Metrics, AnOldResultHasNoValuesAndNothingMaySteer) {
  Moment moment = good_moment();
  moment.newest.status = POSE_WALL_RUNTIME_E_STALE;  // though whoever filled it forgot to make the values invalid
  const std::string text = metrics_text(moment);
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const std::string name = pose_wall_quantity_name(q);
    EXPECT_TRUE(has_line(text, "pose_wall_may_steer{value=\"" + name + "\"} 0"));
    EXPECT_TRUE(has_line(text, "pose_wall_value_state{value=\"" + name + "\",pose_wall_value_state=\"invalid\"} 1"));
  }
  EXPECT_EQ(text.find("pose_wall_angle_radians{"), std::string::npos);
  EXPECT_EQ(text.find("pose_wall_distance_meters{"), std::string::npos);
  moment.newest = {};
  EXPECT_EQ(metrics_text(moment).find("\npose_wall_result_age_seconds "), std::string::npos);
}

TEST(Metrics, AnInvalidValueIsNotTold) {
  Moment moment = good_moment();
  moment.newest.result.publication.result.quantity[POSE_WALL_ROLL].state = POSE_WALL_INVALID;
  const std::string text = metrics_text(moment);
  EXPECT_EQ(text.find("pose_wall_angle_radians{value=\"roll\"}"), std::string::npos);
  EXPECT_TRUE(has_line(text, "pose_wall_angle_radians{value=\"pitch\"} 0.25"));
}

TEST(Metrics, TellWhyAValueMayNotSteer) {
  Moment moment = good_moment();
  pose_wall_value& yaw = moment.newest.result.publication.result.quantity[POSE_WALL_YAW];
  yaw.state = POSE_WALL_INVALID;
  yaw.reasons = POSE_WALL_R_NO_FRAME;
  std::string text = metrics_text(moment);
  EXPECT_TRUE(has_line(text, "pose_wall_value_reason{value=\"yaw\",reason=\"no_frame\"} 1")) << text;
  EXPECT_TRUE(has_line(text, "pose_wall_value_cause{value=\"yaw\",cause=\"no_frame\"} 1"));
  EXPECT_EQ(text.find("pose_wall_value_reason{value=\"roll\""), std::string::npos) << "nothing stands against it";
  moment.newest.status = POSE_WALL_RUNTIME_E_STALE;
  text = metrics_text(moment);
  EXPECT_TRUE(has_line(text, "pose_wall_value_reason{value=\"yaw\",reason=\"no_frame\"} 1"))
      << "stale ones have it too";
}

TEST(Metrics, TheStopTellsReasonsCauseAndTimes) {
  Moment moment = good_moment();
  moment.stop.emplace();
  moment.stop->result.reasons = POSE_WALL_PLANAR_STOP_R_STALE;
  moment.stop->result.settings_crc32 = 0xAB;
  moment.stop_ns = {2'500'000'000, 0, 7'000'000'000};
  moment.config_crc32 = 0xD5FB5C72;
  const std::string text = metrics_text(moment);
  EXPECT_TRUE(has_line(text, "pose_wall_stop_reason{reason=\"stale\"} 1")) << text;
  EXPECT_TRUE(has_line(text, "pose_wall_stop_cause{cause=\"no_frame\"} 1"));
  EXPECT_TRUE(has_line(text, "pose_wall_stop_seconds_total{state=\"stop\"} 2.5"));
  EXPECT_TRUE(has_line(text, "pose_wall_stop_seconds_total{state=\"go\"} 7"));
  EXPECT_NE(text.find("config_crc32=\"16#D5FB5C72\",planar_stop_crc32=\"16#000000AB\"} 1\n"), std::string::npos);
}

TEST(Metrics, SumsComeAsCountersAndAHistogram) {
  Moment moment = good_moment();
  moment.sums.not_steering_ns[POSE_WALL_D_LF] = 1'500'000'000;
  moment.sums.latency[1] = 3;
  moment.sums.latency.back() = 1;
  moment.sums.latency_sum_ns = 400'000'000;
  const std::string text = metrics_text(moment);
  EXPECT_TRUE(has_line(text, "pose_wall_value_not_steering_seconds_total{value=\"d_lf\"} 1.5"));
  EXPECT_TRUE(has_line(text, "pose_wall_result_latency_seconds_bucket{le=\"0.002\"} 0"));
  EXPECT_TRUE(has_line(text, "pose_wall_result_latency_seconds_bucket{le=\"0.3\"} 3"));
  EXPECT_TRUE(has_line(text, "pose_wall_result_latency_seconds_bucket{le=\"+Inf\"} 4"));
  EXPECT_TRUE(has_line(text, "pose_wall_result_latency_seconds_count 4"));
  EXPECT_TRUE(has_line(text, "pose_wall_result_latency_seconds_sum 0.4"));
}

TEST(Metrics, WhatPeopleAlertOnHasNamesThatStayAndNoAddresses) {
  Moment moment = good_moment();
  moment.parts[1].part = "source udp 127.0.0.1:2368";
  moment.parts[1].facts = {{"packets", "75"}, {"packets lost by the kernel", "2"}, {"packets lost on the way", "3"}};
  moment.parts.push_back({"sink mqtt 127.0.0.1:1883",
                          Grade::kGood,
                          "connected",
                          {{"messages not sent", "4"}, {"results lost to slowness", "5"}}});
  moment.parts.push_back({"sink recorder /a b/c",
                          Grade::kGood,
                          "records",
                          {{"results not recorded", "6"}, {"results lost to slowness", "7"}, {"disk free MB", "12"}}});
  moment.parts.push_back({"commands ros2 /packets", Grade::kGood, "", {{"packets", "9"}}});
  const std::string text = metrics_text(moment);
  EXPECT_TRUE(has_line(text, "pose_wall_packets_lost_by_kernel_total 2")) << text;
  EXPECT_TRUE(has_line(text, "pose_wall_packets_lost_on_the_way_total 3"));
  EXPECT_TRUE(has_line(text, "pose_wall_packets_received_total 75")) << "those of the source alone";
  EXPECT_TRUE(has_line(text, "pose_wall_mqtt_messages_not_sent_total 4"));
  EXPECT_TRUE(has_line(text, "pose_wall_results_lost_total{sink=\"mqtt\"} 5"));
  EXPECT_TRUE(has_line(text, "pose_wall_results_lost_total{sink=\"recorder\"} 7"));
  EXPECT_TRUE(has_line(text, "pose_wall_results_not_recorded_total 6"));
  EXPECT_TRUE(has_line(text, "pose_wall_recording_disk_free_bytes 12000000"));
  EXPECT_TRUE(has_line(text, "pose_wall_part_fact{part=\"source udp\",place=\"127.0.0.1:2368\",fact=\"packets\"} 75"));
  EXPECT_TRUE(has_line(text,
                       "pose_wall_part_grade{part=\"sink recorder\",place=\"/a b/c\","
                       "pose_wall_part_grade=\"ok\"} 1"));
}

TEST(Metrics, WhoAsksForPlainTextGetsTheOlderFormat) {
  EXPECT_EQ(metrics_format(""), MetricsFormat::kOpenMetrics);
  EXPECT_EQ(metrics_format("*/*"), MetricsFormat::kOpenMetrics);
  EXPECT_EQ(metrics_format("text/plain"), MetricsFormat::kText);
  // As Prometheus 2 and 3 ask.
  EXPECT_EQ(metrics_format("application/openmetrics-text;version=1.0.0,text/plain;version=0.0.4;q=0.5,*/*;q=0.1"),
            MetricsFormat::kOpenMetrics);
  Moment moment = good_moment();
  moment.parts[1] = {"source udp", Grade::kGood, "receives", {{"packets", "75"}}};
  const std::string text = metrics_text(moment, MetricsFormat::kText);
  EXPECT_TRUE(has_line(text, "# TYPE pose_wall_build_info gauge"));
  EXPECT_TRUE(has_line(text, "# TYPE pose_wall_value_state gauge"));
  EXPECT_TRUE(has_line(text, "# TYPE pose_wall_packets_received_total counter"));
  EXPECT_TRUE(has_line(text, "# TYPE pose_wall_part_fact untyped"));
  EXPECT_TRUE(has_line(text, "# TYPE pose_wall_result_latency_seconds histogram"));
  EXPECT_EQ(text.find("# EOF"), std::string::npos);
  EXPECT_EQ(text.find("# UNIT"), std::string::npos);
}

TEST(Metrics, OfTheProcessHaveItsStartAndOpenFiles) {
  const std::string text = metrics_text(good_moment());
  const auto number = [&text](const std::string& name) {
    const std::size_t at = text.find("\n" + name + " ");
    return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + name.size() + 2));
  };
  const auto now_s = static_cast<double>(std::time(nullptr));
  EXPECT_LE(number("process_start_time_seconds"), now_s + 1.0);
  EXPECT_GT(number("process_start_time_seconds"), now_s - 3600.0) << "this test takes no hour";
  EXPECT_GE(number("process_open_fds"), 3.0);
  const int file = dup(STDERR_FILENO);
  const double before = number("process_open_fds");
  const std::string later = metrics_text(good_moment());
  close(file);
  EXPECT_NE(later.find(fmt::format("\nprocess_open_fds {}\n", before + 1.0)), std::string::npos);
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
