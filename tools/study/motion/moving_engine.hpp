// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The engine with the motion library beside it, as pose_wall_motion_process_both has them; the engine alone with the
// key `motion` off.

#pragma once

#include <optional>
#include <vector>

#include "pose_wall.hpp"
#include "pose_wall_motion.h"

namespace pose_wall::tools {

class MovingEngine {
 public:
  // POSE_WALL_OK, or what either refused the config with.
  std::int32_t open(const api::Config& config, const pose_wall_motion_settings& settings);

  std::int32_t process(const pose_wall_cloud& cloud, pose_wall_result& result);

  // The same cloud as the engine was given it last, with what the motion told among its inputs; good until the next
  // frame, and as long as that cloud.
  const pose_wall_cloud& given() const { return given_; }
  // Of the last frame; none with the key off.
  const std::optional<pose_wall_motion_result>& moved() const { return moved_; }
  api::Engine& engine() { return engine_; }
  const api::Engine& engine() const { return engine_; }

 private:
  struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Line {
    unsigned char bytes[POSE_WALL_BLOCK_ALIGNMENT];
  };
  api::Engine engine_;
  std::vector<Line> block_;
  pose_wall_motion* motion_ = nullptr;
  std::optional<pose_wall_motion_result> moved_;
  pose_wall_cloud given_{};
  pose_wall_inputs inputs_{};
};

}  // namespace pose_wall::tools
