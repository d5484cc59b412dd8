// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A comparison of motion with the truth in words: tables for people in the chosen language, JSON for scripts.

#pragma once

#include <string>

#include "io/json/json_words.hpp"
#include "study/motion/motion_comparison.hpp"

namespace pose_wall::tools {

std::string motion_comparison_text(const MotionComparison& comparison);

// In m and rad; null where there is no number.
Json motion_comparison_json(const MotionComparison& comparison);

}  // namespace pose_wall::tools
