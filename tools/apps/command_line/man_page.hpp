// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// pose_wall(1), from what the command's parser and the engine's table of keys say of themselves.

#pragma once

#include <string>

#include "apps/command_line/grammar.hpp"

namespace pose_wall::tools {

// Source for groff and mandoc, in ASCII.
std::string man_page(const CommandGrammar& grammar, const std::string& description, const std::string& version);

// Text as the source of a page wants it: no sign of it is taken for a command.
std::string roff_text(const std::string& text);

}  // namespace pose_wall::tools
