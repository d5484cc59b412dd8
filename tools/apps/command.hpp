// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The pose_wall command: finds the verb and runs it.

#pragma once

#include "apps/command_line/grammar.hpp"

namespace pose_wall::tools {

// What main() does; returns the exit status.
int run_command(int argc, const char* const* argv);

// All that can be said to it.
CommandGrammar command_grammar();

}  // namespace pose_wall::tools
