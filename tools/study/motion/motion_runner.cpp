// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/motion/motion_runner.hpp"

#include <chrono>
#include <exception>
#include <utility>

#include "io/config_file/load_config.hpp"
#include "io/frames/frame.hpp"

namespace pose_wall::tools {

MotionRunner::MotionRunner(const api::Config& config, const pose_wall_motion_settings& settings, double rate_hz,
                           MotionLibrary library)
    : library_(std::move(library)),
      block_(static_cast<std::size_t>((pose_wall_motion_memory_needed() + sizeof(Line) - 1) / sizeof(Line))),
      stamps_(rate_hz) {
  pose_wall_motion_fault fault{};
  if (pose_wall_motion_settings_check(&settings, &fault) == POSE_WALL_E_VALUE_RANGE) {
    throw ConfigError(std::string("motion: ") + fault.rule);
  }
  const std::int32_t status = library_.open(config.get(), &settings, block_.data(), block_bytes(), &motion_);
  if (status != POSE_WALL_OK) throw ConfigError(std::string("motion: ") + pose_wall_status_text(status));
}

MotionOutcome MotionRunner::run(SourcedFrame sourced) {
  using Clock = std::chrono::steady_clock;
  MotionOutcome outcome;
  outcome.frame = next_frame_++;
  outcome.source = std::move(sourced.name);
  outcome.stamp_ns = stamps_.next(sourced.stamp_ns);
  if (!sourced.frame) {
    outcome.error = std::move(sourced.error);
    return outcome;
  }
  sourced.frame->cloud.stamp_ns = outcome.stamp_ns;
  pose_wall_motion_result result{};
  result.struct_size = sizeof result;
  const Clock::time_point start = Clock::now();
  const std::int32_t status = library_.process(motion_, &sourced.frame->cloud, &result);
  outcome.total_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  if (status == POSE_WALL_OK) {
    outcome.result = result;
  } else {
    outcome.error = pose_wall_status_text(status);
  }
  return outcome;
}

std::vector<float> MotionRunner::map_points() const {
  std::uint32_t total = 0;
  if (pose_wall_motion_map(motion_, 0, nullptr, 0, &total) != POSE_WALL_OK) return {};
  std::vector<float> xyz_m(std::size_t{3} * total);
  if (pose_wall_motion_map(motion_, 0, xyz_m.data(), total, &total) != POSE_WALL_OK) return {};
  return xyz_m;
}

}  // namespace pose_wall::tools
