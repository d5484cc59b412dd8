// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Options that take one of some words, or a whole number.

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace pose_wall::tools {

// Refuses any other word by naming the nearest and all that are allowed. Help and completion show the words.
CLI::Validator one_of(const std::vector<std::string>& words);

// Refuses what is no whole number from 0: -1 would be taken for the greatest number there is.
CLI::Validator whole_number();

}  // namespace pose_wall::tools
