// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// An explanation for a terminal: sentences, the planes that were considered, and a table of all gates.

#pragma once

#include <string>

#include "explain/explanation.hpp"

namespace pose_wall::tools::explain {

std::string sentences_text(const Explanation& explanation);

// coloured: what did not hold in red (refuses), yellow (doubts) or blue (told only), by escape sequences.
std::string planes_text(const pose_wall_config& config, const pose_wall_result& result, const Notes& notes);
std::string gates_text(const Notes& notes, bool coloured);

}  // namespace pose_wall::tools::explain
