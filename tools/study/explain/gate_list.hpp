// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// All gates of the engine: their names, limits and where the limits are from.

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pose_wall_trace.h"

namespace pose_wall::tools::explain {

// In the order of the pipeline; a gate's place is its pose_wall_trace_gate_id.
const std::vector<pose_wall_trace_info>& gate_list();
std::optional<std::uint32_t> find_gate(const std::string& name);
// "'wall_lenght' is no gate; did you mean 'wall_length'?", or with `otherwise` where no name is near.
std::string no_gate_text(const std::string& name, const char* otherwise);

// "at least", "at most", "below", "is so".
const char* sense_name(std::uint32_t sense);
// "tells", "doubts", "refuses".
const char* effect_name(std::uint32_t effect);

// One row for each gate: limit as in the table of gates, unit, key, effect, what is measured, and the limit's origin.
std::string gate_list_text();

}  // namespace pose_wall::tools::explain
