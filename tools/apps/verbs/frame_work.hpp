// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What verbs that turn frames into rows have in common: when they do not begin, and what they say when they are
// stopped.

#pragma once

#include <cstddef>
#include <string>

#include "io/inputs/frame_sequence.hpp"

namespace pose_wall::tools {

// True, and said on stderr, where there is nothing to read at all: a mistyped input must not cost the results of the
// last run, nor leave a file that looks like some.
bool has_no_input(const char* verb, const FrameSequence& inputs, const std::string& output);

// The exit status after Ctrl-C, which is said on stderr.
int tell_interrupted(std::size_t frames);

}  // namespace pose_wall::tools
