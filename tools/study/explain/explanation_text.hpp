// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// An explanation for a terminal: sentences, a table of planes and a table of gates.

#pragma once

#include <string>

#include "study/explain/explanation.hpp"

namespace pose_wall::tools::explain {

std::string sentences_text(const Explanation& explanation);

// coloured: gates that failed in red (refuses), yellow (doubts) or blue (tells), by escape sequences.
std::string planes_text(const pose_wall_config& config, const pose_wall_result& result, const Notes& notes);
std::string gates_text(const Notes& notes, bool coloured);

}  // namespace pose_wall::tools::explain
