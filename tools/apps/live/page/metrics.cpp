// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>

#include "apps/live/page/open_metrics.hpp"
#include "apps/live/page/probes.hpp"
#include "io/config_file/key_table.hpp"
#include "study/steer/steering.hpp"

namespace pose_wall::tools::live {
namespace {

constexpr double kSecondsPerNs = 1e-9;                // OpenMetrics wants seconds
constexpr std::uint32_t kAngles = POSE_WALL_YAW + 1;  // roll, pitch, yaw come first

double seconds(std::int64_t ns) {
  return static_cast<double>(ns) * kSecondsPerNs;
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

void add_result(OpenMetrics* metrics, const Moment& moment) {
  const pose_wall_result* result = moment.is_fresh() ? &moment.newest->publication.result : nullptr;
  metrics->family("pose_wall_may_steer", "gauge", "",
                  "1: this value may steer at this moment. Without a fresh result none may.");
  std::optional<Steering> steering;
  if (result != nullptr) {
    api::Config config;
    *config.get() = moment.newest->config;
    steering = steering_of(*result, alert_limits_of(config));
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
  add_values(metrics, result, "", "The value, unless it is invalid.", &pose_wall_value::value);
  add_values(metrics, result, "_protection_level", "Bound of the value's error.", &pose_wall_value::protection_level);
  add_values(metrics, result, "_sigma", "Standard deviation of the last measurement.", &pose_wall_value::sigma);
  metrics->family("pose_wall_value_age_seconds", "gauge", "seconds", "Since the frame that the value was measured in.");
  for (std::uint32_t q = 0; result != nullptr && q < POSE_WALL_QUANTITIES; ++q) {
    if (result->quantity[q].state != POSE_WALL_INVALID) metrics->sample(of_value(q), result->quantity[q].age_s);
  }
  metrics->family("pose_wall_result_age_seconds", "gauge", "seconds",
                  "Since the newest result was published, of a frame or of silence.");
  if (moment.newest) metrics->sample({}, seconds(moment.now_ns - moment.newest->publication.published_ns));
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
  add_times(metrics, "pose_wall_latency_seconds", "From the reception of a frame to its result, since the start.",
            now.latency);
  add_times(metrics, "pose_wall_work_seconds", "A frame in the engine, since the start.", now.work);
}

void add_stop(OpenMetrics* metrics, const StopNews& stop) {
  metrics->family("pose_wall_stop_state", "stateset", "", "The obstacle stop at this moment.");
  std::vector<std::string> states;
  for (std::uint32_t state = POSE_WALL_PLANAR_STOP_STOP; state <= POSE_WALL_PLANAR_STOP_GO; ++state) {
    states.emplace_back(pose_wall_planar_stop_state_name(state));
  }
  metrics->states({}, states, pose_wall_planar_stop_state_name(stop.result.state));
  metrics->family("pose_wall_stop_allowed_speed_meters_per_second", "gauge", "meters_per_second",
                  "The fastest point of the machine may have this speed.");
  metrics->sample({}, stop.result.allowed_speed_m_s);
  metrics->family("pose_wall_stop_answers", "counter", "", "Answers of the obstacle stop: its heartbeat.");
  metrics->count({}, stop.rounds);
}

// Nothing where the text is no number as a whole.
std::optional<double> number_in(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool is_whole = !text.empty() && end == text.c_str() + text.size();
  return is_whole && std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

void add_parts(OpenMetrics* metrics, const std::vector<PartHealth>& parts) {
  metrics->family("pose_wall_part_grade", "stateset", "", "How each part of the daemon fares.");
  const std::vector<std::string> grades = {grade_name(Grade::kGood), grade_name(Grade::kWarning),
                                           grade_name(Grade::kBad), grade_name(Grade::kStale)};
  std::map<std::string, std::map<std::string, double>> facts;  // each once, whatever a part says
  for (const PartHealth& part : parts) {
    const auto [facts_of, is_new] = facts.try_emplace(part.part);
    if (!is_new) continue;
    metrics->states({{"part", part.part}}, grades, grade_name(part.grade));
    for (const auto& [name, value] : part.facts) {
      if (const std::optional<double> number = number_in(value)) facts_of->second[name] = *number;
    }
  }
  metrics->family("pose_wall_part_fact", "unknown", "", "Counts and numbers of each part, as /health has them.");
  for (const auto& [part, numbers] : facts) {
    for (const auto& [name, number] : numbers) metrics->sample({{"part", part}, {"fact", name}}, number);
  }
}

// Under the names that all clients of Prometheus give them.
void add_process(OpenMetrics* metrics) {
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) == 0) {
    const auto of = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    metrics->family("process_cpu_seconds", "counter", "seconds", "Time of processors that the daemon took.");
    metrics->sample({}, of(usage.ru_utime) + of(usage.ru_stime), "_total");
  }
  std::uint64_t pages = 0, resident = 0;
  if (std::ifstream("/proc/self/statm") >> pages >> resident) {
    metrics->family("process_resident_memory_bytes", "gauge", "bytes", "Memory that the daemon has in use.");
    metrics->count({}, resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)), "");
  }
}

}  // namespace

std::string metrics_text(const Moment& moment) {
  OpenMetrics metrics;
  metrics.family("pose_wall_build", "info", "", "Version, and CRC of the engine's settings.");
  OpenMetrics::Labels labels = {{"version", pose_wall_version()}};
  if (moment.newest) {
    labels.emplace_back("config_crc32", fmt::format("16#{:08X}", moment.newest->publication.result.config_crc32));
  }
  metrics.count(labels, 1, "_info");
  add_result(&metrics, moment);
  if (moment.statistics) add_runtime(&metrics, *moment.statistics);
  if (moment.stop) add_stop(&metrics, *moment.stop);
  add_parts(&metrics, moment.parts);
  add_process(&metrics);
  return std::move(metrics).text();
}

}  // namespace pose_wall::tools::live
