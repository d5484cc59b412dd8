// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the daemon gives by HTTP and MQTT, for programs: OpenAPI 3.1 with JSON Schemas, of api/openapi.json.

#pragma once

#include <string_view>

namespace pose_wall::tools::live {

std::string_view openapi();

}  // namespace pose_wall::tools::live
