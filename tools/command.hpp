// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The pose_wall command: finds the verb and runs it.

#pragma once

namespace pose_wall::tools {

// What main() does; returns the exit status.
int run_command(int argc, const char* const* argv);

}  // namespace pose_wall::tools
