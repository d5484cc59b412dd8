// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The help of a command in the language of the reader: headings, marks behind options, columns of wide signs.

#pragma once

#include <CLI/CLI.hpp>

namespace pose_wall::tools {

// Call it before verbs are added: they inherit it.
void use_help_format(CLI::App& app);

// Names the group of the verbs. Call it when all are added.
void name_verb_group(CLI::App& app);

}  // namespace pose_wall::tools
