// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the card shows of valid values: their shares and levels, and the curve over scaled levels.

#pragma once

#include <string>
#include <vector>

#include "lab/campaign/card.hpp"

namespace pose_wall::tools::campaign {

// "88.2 % ≥ 85.0"; "50.0 % < 85.0" below the floor, "88.2 %" without one.
std::string valid_text(const ErrorStatistics& statistics, const ValidCount& count);
// Of the four groups; `marks`: bold below the floor.
std::vector<std::string> valid_cells(const SevenStatistics& quantities, const ValidCounts& counts, bool marks);
// "0.350° (6.2 ×)": the median level of valid values, and over their 95 % error; "-" without valid values.
std::string level_text(const QuantityGroup& group);

// Of card.md.
std::string valid_section(const Card& card);
std::string frames_section(const Card& card);
// Of mine classes: their values against each of the two truths. Empty without any.
std::string truths_section(const Card& card);
std::string curve_section(const Card& card);
// For the terminal, as tables.
std::string valid_summary(const Card& card);
std::string frames_summary(const Card& card);
std::string curve_summary(const Card& card);
// level_curve.csv: shares, and counts of frames.
std::string curve_csv(const Card& card);

}  // namespace pose_wall::tools::campaign
