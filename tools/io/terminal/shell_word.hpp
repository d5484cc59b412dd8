// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Words as a shell reads them, for commands and scripts that are printed.

#pragma once

#include <string>

namespace pose_wall::tools {

// In single quotes, as bash, zsh and fish read them.
std::string shell_quoted(const std::string& text);

// In quotes only where it must be.
std::string shell_word(const std::string& word);

}  // namespace pose_wall::tools
