// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// One field of one point as a number, for tools that look at clouds themselves.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "pose_wall.h"

namespace pose_wall::tools {

// The field lies within the point; the cloud is one that a reader described. NaN for a field that is absent.
double field_value(const pose_wall_cloud& cloud, std::uint32_t row, std::uint32_t column, const pose_wall_field& field);

// "float32"
std::string_view field_type_name(std::uint32_t type);

}  // namespace pose_wall::tools
