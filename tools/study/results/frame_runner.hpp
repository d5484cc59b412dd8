// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Puts frames through the engine, with times.

#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "io/config_file/motion_settings.hpp"
#include "io/frames/frame_source.hpp"
#include "io/frames/frame_stamps.hpp"
#include "pose_wall.hpp"
#include "study/motion/moving_engine.hpp"
#include "study/results/result_csv.hpp"

namespace pose_wall::tools {

class FrameRunner {
 public:
  // Throws ConfigError when the engine or the motion refuses the config.
  FrameRunner(const api::Config& config, double rate_hz,
              const pose_wall_motion_settings& motion = default_motion_settings());

  // A processed frame: the cloud as the engine was given it and what became of its points. For the call only.
  using Notice = std::function<void(const pose_wall_cloud&, const pose_wall_points&, const pose_wall_result&)>;

  // Frames are numbered in the order of the calls. Never throws: what is wrong with a frame stands in the outcome.
  FrameOutcome run(SourcedFrame sourced, const Notice& notice = {});

  // What it remembers can be saved before a frame.
  pose_wall_engine* engine() { return engine_.engine().get(); }

  // How the machine moved up to the last frame that was measured; none where the key `motion` is off.
  const std::optional<pose_wall_motion_result>& moved() const { return engine_.moved(); }

  std::size_t block_bytes() const { return engine_.engine().block_bytes(); }

 private:
  MovingEngine engine_;
  const AlertLimits limits_;
  FrameStamps stamps_;
  std::uint64_t next_frame_ = 0;
};

}  // namespace pose_wall::tools
