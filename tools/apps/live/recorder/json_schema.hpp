// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The JSON Schema of a message, from one of its kind: viewers list a topic's members by it.

#pragma once

#include <string>

namespace pose_wall::tools::live {

// Members with one type each, as Lichtblick and Foxglove demand. Each may be null in other messages, which "nullable"
// says, as validators have it and viewers pass over it. A member that is null or an empty list in the example is left
// out: further members are allowed. Throws nlohmann::json::parse_error where the example is no JSON.
std::string json_schema_of(const std::string& example);

}  // namespace pose_wall::tools::live
