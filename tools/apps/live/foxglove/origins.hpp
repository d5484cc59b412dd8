// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Which pages may read from an address on this machine or its network. A browser tells the origin of the page that
// connects; any page that a person opens could try.

#pragma once

#include <string>

namespace pose_wall::tools::live {

// origin: "https://app.foxglove.dev", "http://localhost:8080", "file://"; empty for programs, which are free to lie.
// Admitted are these, origins of this machine, and the one that the key foxglove_origin names.
bool is_admitted_origin(const std::string& origin, const std::string& named);

}  // namespace pose_wall::tools::live
