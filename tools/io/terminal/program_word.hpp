// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How the user called this program, for commands that are proposed to him.

#pragma once

#include <string>

namespace pose_wall::tools {

// argv[0] as it was typed.
void set_program_word(const std::string& typed);

// As a shell reads it; `pose_wall` where nothing was set.
const std::string& program_word();

}  // namespace pose_wall::tools
