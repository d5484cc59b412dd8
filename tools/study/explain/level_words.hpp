// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The parts of a protection level, as a sum that people can check.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pose_wall.h"

namespace pose_wall::tools::explain {

// Parts that are above zero, largest first. Empty where there is no level.
std::vector<std::uint32_t> parts_by_size(const pose_wall_value& value);

// "3.64° = 2.10° rival + 0.90° range bias + 0.64° random; lag 0". The figures add up as they stand. Lag is named
// even at 0 where this frame measured the value. Empty where there is no level.
std::string level_sum(const pose_wall_value& value, std::uint32_t quantity);

// Whether that sum has a lag above zero, as its figures are rounded.
bool shows_lag(const pose_wall_value& value, std::uint32_t quantity);

}  // namespace pose_wall::tools::explain
