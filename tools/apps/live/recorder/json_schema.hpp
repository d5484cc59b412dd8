// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The JSON Schema of a message, from one of its kind: viewers list a topic's members by it.

#pragma once

#include <string>

namespace pose_wall::tools::live {

// Members with their types. A number may be null in other messages. Of what is null in the example, and of what an
// empty list holds, nothing is said. Further members are allowed. Throws nlohmann::json::parse_error where the example
// is no JSON.
std::string json_schema_of(const std::string& example);

}  // namespace pose_wall::tools::live
