// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What would be valid, and wrong, if all levels were so much smaller or larger.

#pragma once

#include <array>
#include <cstddef>

#include "lab/campaign/record.hpp"

namespace pose_wall::tools::campaign {

inline constexpr std::array<double, 7> kLevelScales = {0.3, 0.5, 0.7, 0.85, 1.0, 1.2, 1.5};

// Under a scale a value is valid if its level times the scale is within the alert limit, and nothing but its level kept
// it from being valid: it was valid, or degraded by the reason alert_limit, with or without doubts that the level
// holds. What depends on earlier frames (a hold, a jump to be confirmed) stays as it was.
bool is_valid_under(double scale, const QuantityRecord& value, double alert_limit);

// Of the frames of some runs, under one scale.
struct ScaledCounts {
  std::size_t frames = 0;
  std::size_t misleading = 0;  // frames with a value that is valid under the scale and wrong as in judge()
  std::size_t beyond = 0;      // frames with an error of value or raw beyond the scaled level
  std::size_t angles = 0, valid_angles = 0;        // values with a truth, not of the way in
  std::size_t distances = 0, valid_distances = 0;  // the same

  void add(const FrameRecord& frame, double scale, const AlertLimits& limits);
};

using LevelCurve = std::array<ScaledCounts, kLevelScales.size()>;

void add_run(LevelCurve& curve, const RunRecord& record, const AlertLimits& limits);

}  // namespace pose_wall::tools::campaign
