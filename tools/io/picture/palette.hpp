// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The picture's colours, in one place so that views and legend agree.
#pragma once

#include <string_view>

#include "pose_wall.h"

namespace pose_wall::tools::picture {

inline constexpr std::string_view kPaper = "#f6f4ef";
inline constexpr std::string_view kPanel = "#ffffff";
inline constexpr std::string_view kGrid = "#ebe8e1";
inline constexpr std::string_view kInk = "#22282e";
inline constexpr std::string_view kFaintInk = "#737b83";

inline constexpr std::string_view kLeft = "#2274a5";
inline constexpr std::string_view kRight = "#7a4ea3";
inline constexpr std::string_view kFloor = "#b98b4e";
inline constexpr std::string_view kOther = "#b3b8bc";
inline constexpr std::string_view kMachine = "#e9a820";
inline constexpr std::string_view kMachineRim = "#8a6209";

inline std::string_view state_colour(uint32_t state) {
  switch (state) {
    case POSE_WALL_VALID:
      return "#1e8e4f";
    case POSE_WALL_DEGRADED:
      return "#d9720f";
    case POSE_WALL_HELD:
      return "#3f6fd1";
    default:
      return "#b3261e";
  }
}

inline std::string_view label_colour(uint8_t label) {
  switch (label) {
    case POSE_WALL_LABEL_FLOOR:
      return kFloor;
    case POSE_WALL_LABEL_LEFT:
      return kLeft;
    case POSE_WALL_LABEL_RIGHT:
      return kRight;
    default:
      return kOther;
  }
}

}  // namespace pose_wall::tools::picture
