// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// One rule for the use of a recording's values, the same in run, report and doctor. A value is judged by the share of
// frames in which it is valid. A recording is usable if all seven values are, and usable in part if at least one is
// usable in part.

#pragma once

#include <array>
#include <string>

#include "pose_wall.h"

namespace pose_wall::tools {

enum class Usability { kNotUsable, kInPart, kUsable };

// A controller bridges single frames by held values, for hold_max at most.
inline constexpr double kUsableShare = 0.9;
// Below it a value is missing more often than it is there.
inline constexpr double kInPartShare = 0.5;

// By quantity: frames in which it is valid, as a share of those that were read.
using ValidShares = std::array<double, POSE_WALL_QUANTITIES>;

Usability usability_of(double valid_share);
Usability usability_of(const ValidShares& valid);

// The verdict with its reasons in one line, in the chosen language: "usable in part: roll, pitch valid in at least
// 90 % of the frames; never valid: yaw".
std::string usability_text(const ValidShares& valid);

}  // namespace pose_wall::tools
