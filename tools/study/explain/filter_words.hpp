// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Points that the filters dropped, and those that are left for the search for planes.

#pragma once

#include <string>

#include "pose_wall.h"

namespace pose_wall::tools::explain {

struct FilterWords {
  std::string sentence;  // "65536 points came in. Of these 65000 are farther than range_max (30.00 m). ..."
  std::string help;      // what the largest part of the dropped ones asks for; empty where most were kept
};

FilterWords filter_words(const pose_wall_config& config, const pose_wall_result& result);

}  // namespace pose_wall::tools::explain
