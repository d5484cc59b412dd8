// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Why a value may not steer: one cause, as a name for programs and as words for people, and what helps.

#pragma once

#include <cstdint>
#include <string>

#include "io/language/language.hpp"
#include "pose_wall.h"

namespace pose_wall::tools {

// Causes are the reasons, by their bits, and behind them the parts of a level.
inline constexpr std::uint32_t kSteerCauses = POSE_WALL_REASON_COUNT + POSE_WALL_PARTS;
inline constexpr std::uint32_t kMaySteer = kSteerCauses;  // no cause

// Of one of the seven values. kMaySteer: it is valid, which is the one state that may steer.
// Of a level beyond its limit: the reason that made its largest part grow, else this part. Of a value that was not
// measured: the first thing in the order of the pipeline that hindered it.
std::uint32_t steer_cause(const pose_wall_value& value);

// Measured in this frame, and only the level or a doubt stands against it.
bool is_measured(const pose_wall_value& value);

// Stable: a pose_wall_reason_name, or a pose_wall_part_name. "wall_not_found", "rival".
const char* steer_cause_name(std::uint32_t cause);

// "the wall is unseen beside the machine".
std::string steer_cause_words(Language language, std::uint32_t cause);

// Clauses that people may act by, as `explain` has them; empty where nothing helps.
std::string steer_remedy(Language language, std::uint32_t cause);

}  // namespace pose_wall::tools
