// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "apps/live/page/open_metrics.hpp"
#include "apps/live/page/part_metrics.hpp"
#include "apps/live/page/probes.hpp"
#include "apps/live/page/process_metrics.hpp"
#include "io/config_file/key_table.hpp"
#include "study/planar/stop_line.hpp"
#include "study/planar/stop_reasons.hpp"
#include "study/steer/steering.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr double kSecondsPerNs = 1e-9;                // OpenMetrics wants seconds
constexpr std::uint32_t kAngles = POSE_WALL_YAW + 1;  // roll, pitch, yaw come first

double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * kSecondsPerNs;
}

// As the log and a controller have it.
std::string crc_text(std::uint32_t crc32) {
  return fmt::format("16#{:08X}", crc32);
}

const char* cause_name(StopCause cause) {
  switch (cause) {
    case StopCause::kNothing:
      return "nothing";
    case StopCause::kNoFrame:
      return "no_frame";
    case StopCause::kStale:
      return "stale";
    case StopCause::kInvalid:
      return "invalid";
    case StopCause::kFrozen:
      return "frozen";
    case StopCause::kRestart:
      return "restart";
    case StopCause::kNoFloor:
      return "no_floor";
    case StopCause::kThing:
      return "thing";
    case StopCause::kNearing:
      return "nearing";
    case StopCause::kBlind:
      return "blind";
    case StopCause::kSpeed:
      return "speed";
    case StopCause::kMissing:
      return "missing";
    case StopCause::kDust:
      return "dust";
  }
  return "?";
}

OpenMetrics::Labels of_value(std::uint32_t quantity) {
  return {{"value", pose_wall_quantity_name(quantity)}};
}

// One family for the angles and one for the distances, for each has a unit.
void add_values(OpenMetrics* metrics, const pose_wall_result* result, const char* what, const char* help,
                double pose_wall_value::*member) {
  const auto add = [&](const std::string& name, const char* unit, std::uint32_t begin, std::uint32_t end) {
    metrics->family(fmt::format("pose_wall_{}{}_{}", name, what, unit), "gauge", unit, help);
    for (std::uint32_t q = begin; result != nullptr && q < end; ++q) {
      const pose_wall_value& value = result->quantity[q];
      if (value.state != POSE_WALL_INVALID) metrics->sample(of_value(q), value.*member);
    }
  };
  add("angle", "radians", 0, kAngles);
  add("distance", "meters", kAngles, POSE_WALL_QUANTITIES);
}

void add_reasons(OpenMetrics* metrics, const pose_wall_result& result, const std::optional<Steering>& steering) {
  metrics->family("pose_wall_value_reason", "gauge", "", "1 for each reason that stands at this moment.");
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
      if ((result.quantity[q].reasons >> bit & 1U) == 0) continue;
      metrics->count({{"value", pose_wall_quantity_name(q)}, {"reason", pose_wall_reason_name(bit)}}, 1, "");
    }
  }
  metrics->family("pose_wall_value_cause", "gauge", "", "1 for what keeps a fresh value from steering first of all.");
  for (std::uint32_t q = 0; steering && q < POSE_WALL_QUANTITIES; ++q) {
    const SteerValue& value = (*steering)[q];
    if (value.may_steer()) continue;
    metrics->count({{"value", pose_wall_quantity_name(q)}, {"cause", steer_cause_name(value.cause)}}, 1, "");
  }
}

void add_result(OpenMetrics* metrics, const Moment& moment) {
  const LiveResult& newest = moment.newest.result;
  const pose_wall_result* result = moment.newest.is_fresh() ? &newest.publication.result : nullptr;
  metrics->family("pose_wall_may_steer", "gauge", "",
                  "1: this value may steer at this moment. Without a fresh result none may.");
  std::optional<Steering> steering;
  if (result != nullptr) {
    steering = steering_of(*result, alert_limits_of(newest.config));
  }
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    metrics->count(of_value(q), steering && (*steering)[q].may_steer() ? 1 : 0, "");
  }
  metrics->family("pose_wall_value_state", "stateset", "", "State of each value; without a fresh result invalid.");
  std::vector<std::string> states;
  for (std::uint32_t state = POSE_WALL_INVALID; state <= POSE_WALL_VALID; ++state) {
    states.emplace_back(pose_wall_state_name(state));
  }
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const std::uint32_t state = result != nullptr ? result->quantity[q].state : std::uint32_t{POSE_WALL_INVALID};
    metrics->states(of_value(q), states, pose_wall_state_name(state));
  }
  add_reasons(metrics, newest.publication.result, steering);
  add_values(metrics, result, "", "The value, unless it is invalid.", &pose_wall_value::value);
  add_values(metrics, result, "_protection_level", "Bound of the value's error.", &pose_wall_value::protection_level);
  add_values(metrics, result, "_sigma", "Standard deviation of the last measurement.", &pose_wall_value::sigma);
  metrics->family("pose_wall_value_age_seconds", "gauge", "seconds",
                  "From the frame that the value was measured in until now.");
  for (std::uint32_t q = 0; result != nullptr && q < POSE_WALL_QUANTITIES; ++q) {
    if (result->quantity[q].state == POSE_WALL_INVALID) continue;
    metrics->sample(of_value(q), moment.newest.value_age_s(q, moment.now_ns));
  }
  metrics->family("pose_wall_result_age_seconds", "gauge", "seconds",
                  "Since the newest result was published, of a frame or of silence.");
  if (moment.newest.is_there()) metrics->sample({}, seconds(moment.now_ns - newest.publication.published_ns));
}

void add_times(OpenMetrics* metrics, const char* name, const char* help, const pose_wall_runtime_times& times) {
  metrics->family(name, "summary", "seconds", help);
  metrics->count({}, times.count, "_count");
  if (times.count == 0) return;
  metrics->sample({{"quantile", "0.5"}}, seconds(times.p50_ns));
  metrics->sample({{"quantile", "0.99"}}, seconds(times.p99_ns));
  metrics->sample({{"quantile", "0.999"}}, seconds(times.p999_ns));
  metrics->sample({{"quantile", "1.0"}}, seconds(times.worst_ns));
}

void add_runtime(OpenMetrics* metrics, const pose_wall_runtime_statistics& now) {
  const auto add_count = [&](const char* name, const char* help, std::uint64_t value) {
    metrics->family(name, "counter", "", help);
    metrics->count({}, value);
  };
  add_count("pose_wall_frames_pushed", "Frames that the runtime was given.", now.pushed);
  add_count("pose_wall_frames_measured", "Frames that the engine worked.", now.processed);
  add_count("pose_wall_frames_thinned", "Frames of which only a part of the returns was used.", now.thinned);
  metrics->family("pose_wall_frames_dropped", "counter", "", "Frames that were not worked, by the cause.");
  for (std::uint32_t why = 0; why < POSE_WALL_RUNTIME_DROPS; ++why) {
    metrics->count({{"why", pose_wall_runtime_drop_name(why)}}, now.dropped[why]);
  }
  add_count("pose_wall_results_published", "Results of frames and of silence.", now.published);
  add_count("pose_wall_silences", "Results that tell silence.", now.silences);
  metrics->family("pose_wall_frame_age_seconds", "gauge", "seconds", "Since the newest worked frame was received.");
  if (now.newest_age_ns >= 0) metrics->sample({}, seconds(now.newest_age_ns));
  metrics->family("pose_wall_frames_waiting", "gauge", "", "Frames that wait for the worker.");
  metrics->count({}, now.waiting, "");
  add_count("pose_wall_black_box_written", "Records of the black box that were written.", now.box_written);
  add_count("pose_wall_black_box_failed", "Records that its file refused.", now.box_failed);
  add_count("pose_wall_black_box_lost", "Records that a slow disk left no room for.", now.box_lost);
  add_times(metrics, "pose_wall_latency_seconds", "From the reception of a frame to its result, since the start.",
            now.latency);
  add_times(metrics, "pose_wall_work_seconds", "A frame in the engine, since the start.", now.work);
}

void add_sums(OpenMetrics* metrics, const ResultSums& sums) {
  metrics->family("pose_wall_value_not_steering_seconds", "counter", "seconds",
                  "How long the value was not fit to steer by, since the start.");
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    metrics->sample(of_value(q), seconds(sums.not_steering_ns[q]), "_total");
  }
  metrics->family("pose_wall_result_latency_seconds", "histogram", "seconds",
                  "From the reception of a frame to its result, since the start.");
  std::uint64_t count = 0;
  for (std::size_t k = 0; k < sums.latency.size(); ++k) {
    count += sums.latency[k];
    const bool is_last = k == ResultSums::kUpTo_s.size();
    metrics->count({{"le", is_last ? "+Inf" : fmt::format("{}", ResultSums::kUpTo_s.at(k))}}, count, "_bucket");
  }
  metrics->count({}, count, "_count");
  metrics->sample({}, seconds(sums.latency_sum_ns), "_sum");
}

void add_stop(OpenMetrics* metrics, const StopNews& stop, const std::vector<std::int64_t>& state_ns) {
  metrics->family("pose_wall_stop_state", "stateset", "", "The obstacle stop at this moment.");
  std::vector<std::string> states;
  for (std::uint32_t state = POSE_WALL_PLANAR_STOP_STOP; state <= POSE_WALL_PLANAR_STOP_GO; ++state) {
    states.emplace_back(pose_wall_planar_stop_state_name(state));
  }
  metrics->states({}, states, pose_wall_planar_stop_state_name(stop.result.state));
  metrics->family("pose_wall_stop_seconds", "counter", "seconds", "How long it was in each state, since the start.");
  for (std::size_t state = 0; state < std::min(states.size(), state_ns.size()); ++state) {
    metrics->sample({{"state", states[state]}}, seconds(state_ns[state]), "_total");
  }
  metrics->family("pose_wall_stop_reason", "gauge", "", "1 for each reason that stands at this moment.");
  for (const std::string& reason : stop_reason_names(stop.result.reasons)) metrics->count({{"reason", reason}}, 1, "");
  metrics->family("pose_wall_stop_cause", "gauge", "", "1 for what a person must know of first, if there is anything.");
  const StopCause cause = stop_cause(stop.result);
  if (cause != StopCause::kNothing) metrics->count({{"cause", cause_name(cause)}}, 1, "");
  metrics->family("pose_wall_stop_allowed_speed_meters_per_second", "gauge", "meters_per_second",
                  "The fastest point of the machine may have this speed.");
  metrics->sample({}, stop.result.allowed_speed_m_s);
  metrics->family("pose_wall_stop_answers", "counter", "", "Answers of the obstacle stop: its heartbeat.");
  metrics->count({}, stop.rounds);
}

}  // namespace

std::string metrics_text(const Moment& moment, MetricsFormat format) {
  OpenMetrics metrics(format);
  metrics.family("pose_wall_build", "info", "", "Version, and CRCs of the settings of engine and obstacle stop.");
  OpenMetrics::Labels labels = {{"version", pose_wall_version()}, {"config_crc32", crc_text(moment.config_crc32)}};
  if (moment.stop) labels.emplace_back("planar_stop_crc32", crc_text(moment.stop->result.settings_crc32));
  metrics.count(labels, 1, "_info");
  add_result(&metrics, moment);
  add_sums(&metrics, moment.sums);
  if (moment.statistics) add_runtime(&metrics, *moment.statistics);
  if (moment.stop) add_stop(&metrics, *moment.stop, moment.stop_ns);
  add_stable_metrics(&metrics, moment.parts);
  add_part_metrics(&metrics, moment.parts);
  add_process_metrics(&metrics);
  return std::move(metrics).text();
}

}  // namespace pose_wall::tools::live
