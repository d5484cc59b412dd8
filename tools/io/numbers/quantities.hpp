// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the seven quantities are measured in, what their signs mean, and what their levels are made of.

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "pose_wall.h"

namespace pose_wall::tools {

// In rad; the others are distances, in m.
inline bool is_angle(std::size_t quantity) {
  return quantity <= POSE_WALL_YAW;
}

// What a positive value means, by forward_axis: "right side down". Empty for distances and where nobody knows.
inline std::string positive_means(const pose_wall_result& result, std::size_t quantity) {
  const bool is_known = is_angle(quantity) && result.positive_means[quantity] != POSE_WALL_SENSE_UNKNOWN;
  return is_known ? pose_wall_sense_name(result.positive_means[quantity]) : "";
}

// A pose_wall_part as people read it: "range bias".
inline std::string part_words(std::uint32_t part) {
  std::string words = pose_wall_part_name(part);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

// The largest part of the protection level, "range_bias"; empty where there is no level.
inline std::string cause_name(const pose_wall_value& value) {
  return value.cause < POSE_WALL_PARTS ? pose_wall_part_name(value.cause) : "";
}

}  // namespace pose_wall::tools
