// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Which frame showed a quantity's rival wall last. The engine keeps its doubt for some frames, and only counts these.

#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "pose_wall.h"

namespace pose_wall::tools::explain {

class RivalsSeen {
 public:
  void add(const pose_wall_result& result, std::uint64_t frame) {
    const bool left = is_rivalled(result, result.left, POSE_WALL_D_LF);
    const bool right = is_rivalled(result, result.right, POSE_WALL_D_RF);
    note(left || right, result, POSE_WALL_YAW, frame);
    for (const std::uint32_t quantity : {POSE_WALL_D_LF, POSE_WALL_D_LB}) note(left, result, quantity, frame);
    for (const std::uint32_t quantity : {POSE_WALL_D_RF, POSE_WALL_D_RB}) note(right, result, quantity, frame);
  }
  // Nothing where no frame showed one.
  std::optional<std::uint64_t> last(std::uint32_t quantity) const { return last_[quantity]; }

 private:
  // A wall that is refused has no distance, and its rival is nobody's.
  static bool is_rivalled(const pose_wall_result& result, const pose_wall_plane& wall, std::uint32_t distance) {
    return (wall.reasons & POSE_WALL_R_WALL_AMBIGUOUS) != 0 && std::isfinite(result.quantity[distance].raw);
  }
  void note(bool is_seen, const pose_wall_result& result, std::uint32_t quantity, std::uint64_t frame) {
    if (is_seen && std::isfinite(result.quantity[quantity].raw)) last_[quantity] = frame;
  }

  std::array<std::optional<std::uint64_t>, POSE_WALL_QUANTITIES> last_{};
};

}  // namespace pose_wall::tools::explain
