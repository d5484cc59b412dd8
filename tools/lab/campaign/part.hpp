// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A campaign in parts, for several processes or machines.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lab/campaign/plan.hpp"

namespace pose_wall::tools::campaign {

struct Part {
  std::uint32_t number = 1;  // from 1
  std::uint32_t of = 1;
};

inline constexpr std::uint32_t kPartsMax = 10000;

// "3/16"
std::string part_text(const Part& part);
// Throws std::invalid_argument that says what is allowed.
Part parse_part(const std::string& text);

// The part's runs, in the order of the plan. All parts together have each run once. The dearest runs (frames times the
// sensor's points) are dealt first, each to the part that has the least yet, so parts cost about the same. Throws
// std::invalid_argument if there are more parts than runs.
std::vector<Run> runs_of_part(const std::vector<Run>& runs, const Part& part);

}  // namespace pose_wall::tools::campaign
