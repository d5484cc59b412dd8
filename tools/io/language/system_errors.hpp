// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Why the system refuses a file, in the language of the reader.

#pragma once

#include <string>

namespace pose_wall::tools {

// Of an errno: "No such file or directory". One that no catalogue has stays English.
std::string system_error_text(int error);

}  // namespace pose_wall::tools
