// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/results/frame_runner.hpp"

#include <chrono>
#include <ctime>
#include <string>
#include <utility>

#include "io/config_file/load_config.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

std::int64_t steady_ns(void* /*user*/) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

double millis_since(std::int64_t start_ns) {
  return static_cast<double>(steady_ns(nullptr) - start_ns) * 1e-6;
}

double processor_millis() {
  std::timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

}  // namespace

FrameRunner::FrameRunner(const api::Config& config, double rate_hz, const pose_wall_motion_settings& motion)
    : limits_(alert_limits_of(config)), stamps_(rate_hz) {
  const std::int32_t status = engine_.open(config, motion);
  if (status != POSE_WALL_OK) throw ConfigError(say("the engine: {}", pose_wall_status_text(status)));
  engine_.engine().set_clock(steady_ns);
}

FrameOutcome FrameRunner::run(SourcedFrame sourced, const Notice& notice) {
  FrameOutcome outcome;
  outcome.frame = next_frame_++;
  outcome.source = std::move(sourced.name);
  outcome.stamp_ns = stamps_.next(sourced.stamp_ns);
  outcome.load_ms = sourced.load_ms;
  outcome.limits = limits_;
  if (!sourced.frame) {
    outcome.error = std::move(sourced.error);
    return outcome;
  }
  try {
    Frame& frame = *sourced.frame;
    frame.cloud.stamp_ns = outcome.stamp_ns;
    pose_wall_result result = api::make_result();
    const double start_processor_ms = processor_millis();
    const std::int64_t start_ns = steady_ns(nullptr);
    const std::int32_t status = engine_.process(frame.cloud, result);
    outcome.total_ms = millis_since(start_ns);
    outcome.processor_ms = processor_millis() - start_processor_ms;
    if (status != POSE_WALL_OK) throw FrameError(pose_wall_status_text(status));
    outcome.result = result;
    if (notice) {
      pose_wall_points points{};
      engine_.engine().last_points(points);
      notice(engine_.given(), points, result);
    }
  } catch (const std::exception& error) {
    outcome.result.reset();  // also where it was the notice that failed
    outcome.error = error.what();
  }
  return outcome;
}

}  // namespace pose_wall::tools
