// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// An option that takes one of some words.

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace pose_wall::tools {

// Refuses any other word by naming the nearest and all that are allowed. Help and completion show the words.
CLI::Validator one_of(const std::vector<std::string>& words);

}  // namespace pose_wall::tools
