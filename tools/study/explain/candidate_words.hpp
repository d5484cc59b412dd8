// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The planes that were considered: where each lies, what it shows, and its result.

#pragma once

#include <string>
#include <vector>

#include "study/explain/notes.hpp"

namespace pose_wall::tools::explain {

struct PlaneWords {
  pose_wall_trace_candidate candidate;
  std::string where;  // "at 2.41 m, turned by 1.20°"
  std::string shows;  // "3.50 m long, 4.20 m²": what of it is solid
  std::string fate;   // "wall_length_min requires 2.00 m"
};

// Strongest first. Planes that repeat another are left out, and of rejected ones at most a few are listed.
std::vector<PlaneWords> planes_of(const pose_wall_config& config, const pose_wall_result& result, const Notes& notes,
                                  std::uint32_t subject);

// "2 other planes were considered: ...". Empty where the first is the only one.
std::string others_sentence(const std::vector<PlaneWords>& planes);

}  // namespace pose_wall::tools::explain
