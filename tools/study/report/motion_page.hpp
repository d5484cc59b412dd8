// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The report on a motion table as one HTML file: path from above, states, travel and steps.

#pragma once

#include <optional>
#include <string>

#include "study/motion/motion_comparison.hpp"
#include "study/motion/motion_table.hpp"

namespace pose_wall::tools::report {

struct MotionPageHead {
  std::string title;
  std::string language;  // "en" or "zh": what it opens in
  std::string truth;     // the file, or empty
};

// The same data give the same text.
std::string motion_page(const MotionPageHead& head, const MotionTable& table,
                        const std::optional<MotionComparison>& comparison);

}  // namespace pose_wall::tools::report
