// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The commands to give next, ready to be copied into a shell.

#pragma once

#include <string>
#include <vector>

#include "io/inputs/frame_sequence.hpp"

namespace pose_wall::tools {

struct NextStep {
  std::string why;
  std::vector<std::string> words;  // behind `pose_wall`
};

// Under a heading, each with its reason as a comment of the shell; empty without steps.
std::string next_steps_text(const std::vector<NextStep>& steps);

// Inputs, and the options by which they were opened: the end of a command that reads the same frames.
std::vector<std::string> input_words(const std::vector<std::string>& inputs, const InputOptions& options);

}  // namespace pose_wall::tools
