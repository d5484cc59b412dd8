// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What is wrong with the words of a command line, in the language of the reader. CLI11 writes its messages in English
// and keeps only the kind of a fault; the parser tells the rest: which options were given and which words are left.

#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace pose_wall::tools {

// One sentence without a full stop, with the option that may be meant.
std::string parse_fault_text(const CLI::App& app, const CLI::ParseError& error);

}  // namespace pose_wall::tools
