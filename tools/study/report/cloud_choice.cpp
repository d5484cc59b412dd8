// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/report/cloud_choice.hpp"

#include <algorithm>

namespace pose_wall::tools::report {

CloudChoice::CloudChoice(std::size_t frames, std::size_t points_max)
    : stride_(std::max<std::size_t>(1, (frames + kFramesMax - 1) / kFramesMax)) {
  const std::size_t even = (frames + stride_ - 1) / stride_;
  const std::size_t shown = stride_ == 1 ? even : even + kChangesMax;
  points_per_frame_ = std::clamp<std::size_t>(points_max / std::max<std::size_t>(1, shown), 1, kPointsPerFrameMax);
}

bool CloudChoice::takes(std::size_t frame, const pose_wall_result& result) {
  std::array<std::uint32_t, POSE_WALL_QUANTITIES> states{};
  for (std::size_t q = 0; q < states.size(); ++q) states[q] = result.quantity[q].state;
  const bool changed = last_states_ && *last_states_ != states;
  last_states_ = states;
  if (frame % stride_ == 0) return true;
  if (!changed || changes_ == kChangesMax) return false;
  ++changes_;
  return true;
}

}  // namespace pose_wall::tools::report
