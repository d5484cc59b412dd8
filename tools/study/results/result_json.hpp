// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The row of a frame as JSON: what the CSV holds, nested by what it belongs to, with units in the names.

#pragma once

#include <string>

#include "io/json/json_words.hpp"
#include "study/results/result_csv.hpp"

namespace pose_wall::tools {

// Raised when a member moves or changes its meaning; new members do not raise it.
constexpr int kResultJsonSchema = 1;

Json result_as_json(const FrameOutcome& outcome);

// On one line, ending with a line break. Every frame has the same members: what is not a number, and all of a frame
// that could not be read, is null.
std::string result_json_line(const FrameOutcome& outcome);

}  // namespace pose_wall::tools
