// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Colours: for people at a terminal who have not said that they want none.

#pragma once

namespace pose_wall::tools {

// `no_color` and `term`: the variables NO_COLOR (any text forbids colours) and TERM ("dumb" knows none), or nullptr.
bool wants_colours(bool is_terminal, const char* no_color, const char* term);

// The same of a stream (1: stdout, 2: stderr) and this process's variables.
bool wants_colours(int stream);

}  // namespace pose_wall::tools
