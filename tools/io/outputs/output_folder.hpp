// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The folder behind --output, or an option like it.

#pragma once

#include <string>
#include <string_view>

namespace pose_wall::tools {

// Makes the folder where it is not there yet. Throws std::invalid_argument where a file is in its way, and
// std::runtime_error where the system refuses; both name the path.
void make_output_folder(const std::string& path, std::string_view option = "--output");

}  // namespace pose_wall::tools
