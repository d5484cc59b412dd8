// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Options that take one of some words, a number of a range, or a file. Each names what is allowed, and help shows it.

#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>
#include <vector>

namespace pose_wall::tools {

// Refuses any other word by naming the nearest and all that are allowed. Help and completion show the words.
CLI::Validator one_of(const std::vector<std::string>& words);

// Refuses what is no whole number from 0: -1 would be taken for the greatest number there is.
CLI::Validator whole_number();

// Refuse what is no number, or lies outside.
CLI::Validator whole_number_within(std::uint64_t minimum, std::uint64_t maximum);
CLI::Validator number_within(double minimum, double maximum);

// Refuses what is no file that exists.
CLI::Validator existing_file();

}  // namespace pose_wall::tools
