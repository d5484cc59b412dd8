// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What is asked of a class of scenes: the table of scenes says it, this only reads it.

#pragma once

#include <string_view>

namespace pose_wall::tools::campaign {

// A working day: no error beyond its protection level is allowed at all.
bool is_nominal(std::string_view scene);

// Least share of the values with a truth that is valid or degraded.
double available_floor(std::string_view scene);

}  // namespace pose_wall::tools::campaign
