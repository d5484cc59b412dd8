// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a log of CARMEN holds, for `pose_wall info`.

#pragma once

#include <string>

#include "planar/carmen_log.hpp"

namespace pose_wall::tools {

// A name and what was found, a line each.
std::string carmen_facts_text(const CarmenLog& log);

// One object, without a language.
std::string carmen_facts_json(const std::string& input, const CarmenLog& log);

}  // namespace pose_wall::tools
