// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What all that is told as JSON has in common.

#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "pose_wall.h"

namespace pose_wall::tools {

using Json = nlohmann::ordered_json;

// On one line, or with every level so many blanks further in. What is not a number, which JSON does not know, becomes
// null; bytes of names that are no UTF-8 are replaced, so that they do not cost the rest.
std::string json_text(const Json& json);
std::string json_text(const Json& json, int indent);

// Names of reason bits.
Json reason_list(std::uint32_t reasons);

// By pose_wall_part_name, in the value's own unit.
Json parts_json(const pose_wall_value& value);

}  // namespace pose_wall::tools
