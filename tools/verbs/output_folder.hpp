// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The folder behind --output.

#pragma once

#include <string>

namespace pose_wall::tools {

// Makes the folder where it is not there yet. Throws std::invalid_argument where a file is in its way, and
// std::runtime_error where the system refuses; both name the path.
void make_output_folder(const std::string& path);

}  // namespace pose_wall::tools
