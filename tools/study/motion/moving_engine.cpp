// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/motion/moving_engine.hpp"

#include <cstring>

namespace pose_wall::tools {

std::int32_t MovingEngine::open(const api::Config& config, const pose_wall_motion_settings& settings) {
  motion_ = nullptr;
  moved_.reset();
  const std::int32_t status = engine_.open(config);
  char motion[POSE_WALL_TEXT_MAX] = {};
  if (status != POSE_WALL_OK) return status;
  const std::int32_t read = pose_wall_config_get_text(config.get(), "motion", motion, sizeof(motion));
  if (read != POSE_WALL_OK || std::strcmp(motion, "on") != 0) return read;
  block_.resize(static_cast<std::size_t>((pose_wall_motion_memory_needed() + sizeof(Line) - 1) / sizeof(Line)));
  return pose_wall_motion_open(config.get(), &settings, block_.data(), block_.size() * sizeof(Line), &motion_);
}

std::int32_t MovingEngine::process(const pose_wall_cloud& cloud, pose_wall_result& result) {
  given_ = cloud;
  moved_.reset();
  if (motion_ == nullptr) return engine_.process(cloud, result);
  pose_wall_motion_result moved{};
  moved.struct_size = sizeof(moved);
  std::int32_t status = pose_wall_motion_process(motion_, &cloud, &moved);
  if (status != POSE_WALL_OK) return status;
  moved_ = moved;
  inputs_ = cloud.inputs != nullptr ? *cloud.inputs : pose_wall_inputs{};
  inputs_.struct_size = sizeof(inputs_);
  status = pose_wall_motion_give(motion_, &inputs_);
  if (status != POSE_WALL_OK) return status;
  given_.inputs = &inputs_;
  return engine_.process(given_, result);
}

}  // namespace pose_wall::tools
