// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Puts frames through the motion library, with times.

#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/frames/frame_source.hpp"
#include "io/frames/frame_stamps.hpp"
#include "pose_wall.hpp"
#include "pose_wall_motion.h"

namespace pose_wall::tools {

// What became of one frame.
struct MotionOutcome {
  std::uint64_t frame = 0;  // position in the list of inputs
  std::string source;
  std::int64_t stamp_ns = 0;
  std::optional<pose_wall_motion_result> result;  // none: the frame could not be read, or its layout was refused
  std::string error;                              // then why
  double total_ms = 0.0;                          // in the library, elapsed
};

// What opens a motion and gives it frames: the library as delivered, or another of the same sources in its place.
struct MotionLibrary {
  std::function<std::int32_t(const pose_wall_config*, const pose_wall_motion_settings*, void* block,
                             std::uint64_t block_bytes, pose_wall_motion**)>
      open = pose_wall_motion_open;
  std::function<std::int32_t(pose_wall_motion*, const pose_wall_cloud*, pose_wall_motion_result*)> process =
      pose_wall_motion_process;
};

class MotionRunner {
 public:
  // Throws ConfigError when the library refuses config or settings.
  MotionRunner(const api::Config& config, const pose_wall_motion_settings& settings, double rate_hz,
               MotionLibrary library = {});

  // Frames are numbered in the order of the calls. Never throws: what is wrong with a frame stands in the outcome.
  MotionOutcome run(SourcedFrame sourced);

  // The map's points in start, m: x, y, z of each.
  std::vector<float> map_points() const;

  std::size_t block_bytes() const { return block_.size() * sizeof(Line); }

 private:
  struct alignas(POSE_WALL_BLOCK_ALIGNMENT) Line {
    unsigned char bytes[POSE_WALL_BLOCK_ALIGNMENT];
  };

  MotionLibrary library_;
  std::vector<Line> block_;
  pose_wall_motion* motion_ = nullptr;
  FrameStamps stamps_;
  std::uint64_t next_frame_ = 0;
};

}  // namespace pose_wall::tools
