// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The option --language, and the choice of the language before the words are parsed: their help speaks it, too.

#pragma once

#include <CLI/CLI.hpp>

namespace pose_wall::tools {

// By the words and the environment. An unknown POSE_WALL_LANGUAGE gives one line on stderr, unless --language overrides
// it. Call it before the options are added.
void choose_language_by(int argc, const char* const* argv, const char* program);

// Checks the word and explains it in the help.
void add_language_option(CLI::App& app);

}  // namespace pose_wall::tools
