// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Of which frames a page shows the points, and how many of each, so that ten thousand frames still make one file that
// opens from a memory stick.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "pose_wall.h"

namespace pose_wall::tools::report {

class CloudChoice {
 public:
  CloudChoice(std::size_t frames, std::size_t points_max);

  // Evenly over the recording, and where a value's state changes while there is room for that. In the order of frames.
  bool takes(std::size_t frame, const pose_wall_result& result);
  std::size_t points_per_frame() const { return points_per_frame_; }

 private:
  static constexpr std::size_t kFramesMax = 400;
  static constexpr std::size_t kChangesMax = 200;
  static constexpr std::size_t kPointsPerFrameMax = 12000;

  std::size_t stride_;
  std::size_t points_per_frame_;
  std::size_t changes_ = 0;
  std::optional<std::array<std::uint32_t, POSE_WALL_QUANTITIES>> last_states_;
};

}  // namespace pose_wall::tools::report
