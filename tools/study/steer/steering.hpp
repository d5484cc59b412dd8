// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What may steer, as the first line of all that shows results says it: of each value yes or no, and the cause.

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include "io/json/json_words.hpp"
#include "io/language/language.hpp"
#include "pose_wall.h"
#include "study/steer/steer_cause.hpp"
#include "study/truth/alert_limits.hpp"

namespace pose_wall::tools {

struct SteerValue {
  std::uint32_t quantity = 0;  // pose_wall_quantity
  std::uint32_t cause = kMaySteer;
  bool is_measured = false;  // in this frame
  double level = 0.0;        // rad or m; NaN where nothing bounds the error
  double limit = 0.0;        // rad or m; 0: not known
  // Of a recording: the frames in which it may, 0 to 1; the others are then those of its most frequent cause. NaN: of
  // one frame.
  double valid_share = std::numeric_limits<double>::quiet_NaN();

  bool may_steer() const { return cause == kMaySteer; }
};

// By quantity.
using Steering = std::array<SteerValue, POSE_WALL_QUANTITIES>;

// "0.140 m", "1.203°"; "> 1 m" where it is too large to be worth its digits, "-" where there is none. level and limit
// in rad or m; without a limit, 0, all are shown.
std::string level_text(std::size_t quantity, double level, double limit);

Steering steering_of(const pose_wall_result& result, const AlertLimits& limits);

// "may steer: roll, pitch, yaw; may not: d_lf (level 0.140 m, limit 0.100 m: the wall is unseen beside the machine). To
// look at: mount the sensor where ...." Of a recording: "d_lf (valid in 12 % of the frames, else mostly
// level 0.140 m, ...)". Values with one cause are told together, and each remedy once.
std::string steer_line(Language language, const Steering& steering);

// For programs: value, may_steer, measured, level_rad and limit_rad (or _m), cause and remedy, which are null where the
// value may steer. The remedy is in both languages.
Json steer_json(const Steering& steering);
// The line in both languages: {"en": ..., "zh": ...}.
Json steer_line_json(const Steering& steering);

}  // namespace pose_wall::tools
