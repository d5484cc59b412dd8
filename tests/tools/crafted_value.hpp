// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Values as the engine tells them: the parts add up to the level, and the cause is the largest of them.

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>

#include "pose_wall.h"

namespace pose_wall::tools::test {

using Parts = std::array<double, POSE_WALL_PARTS>;

inline pose_wall_value unmeasured_value() {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  pose_wall_value v{};
  v.value = v.raw = v.sigma = v.protection_level = v.raw_protection_level = kNone;
  std::fill(std::begin(v.part), std::end(v.part), kNone);
  v.cause = POSE_WALL_PARTS;
  return v;
}

// raw NaN: held.
inline pose_wall_value crafted_value(std::uint32_t state, double value, double raw, const Parts& parts) {
  pose_wall_value v = unmeasured_value();
  v.value = value;
  v.raw = raw;
  v.state = state;
  v.protection_level = std::accumulate(parts.begin(), parts.end(), 0.0);
  std::copy(parts.begin(), parts.end(), std::begin(v.part));
  v.cause = static_cast<std::uint32_t>(std::max_element(parts.begin(), parts.end()) - parts.begin());
  if (!std::isfinite(raw)) return v;
  v.raw_state = state;
  v.raw_protection_level = v.protection_level - parts[POSE_WALL_PART_LAG];
  return v;
}

}  // namespace pose_wall::tools::test
