// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pose_wall_planar_stop.h"

namespace pose_wall::tools {

// Names of the stop's reasons, in the order of their bits.
inline std::vector<std::string> stop_reason_names(std::uint32_t reasons) {
  std::vector<std::string> names;
  for (std::uint32_t bit = 0; bit < POSE_WALL_PLANAR_STOP_REASON_COUNT; ++bit) {
    if ((reasons >> bit & 1U) != 0) names.emplace_back(pose_wall_planar_stop_reason_name(bit));
  }
  return names;
}

// As a person reads them: "a thing in the way, low".
std::string stop_reasons_text(std::uint32_t reasons);

}  // namespace pose_wall::tools
