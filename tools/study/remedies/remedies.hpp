// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What helps against a gate that failed, or against a part of a level, without the figures of a frame. In clauses.

#pragma once

#include <cstdint>
#include <string>

#include "io/language/language.hpp"

namespace pose_wall::tools {

// gate: pose_wall_trace_gate_id. Empty where nothing is to be done.
std::string help_of_gate(Language language, std::uint32_t gate);

// What lowers a level whose largest part this is (pose_wall_part).
std::string help_of_part(Language language, std::uint32_t part);

}  // namespace pose_wall::tools
