// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Programs of ours that the daemon starts: what runs in them can fail, hang or end without the daemon.

#pragma once

#include <sys/types.h>

#include <string>
#include <utility>
#include <vector>

namespace pose_wall::tools::live {

// In one of these folders, seen from the daemon's own executable: "" in a build. Else throws std::runtime_error of what
// is missing and of where it was looked for.
std::string program_beside(const std::string& name, const std::string& missing,
                           const std::vector<std::string>& folders);

// The words begin with the program's path. It has no signal blocked and each at its default, as those of the daemon are
// none of its. descriptors: each is found in the child under the second number. Throws std::runtime_error.
pid_t start_child(const std::vector<std::string>& words, const std::vector<std::pair<int, int>>& descriptors);

// Of a status of waitpid: "ended by signal 6 (Aborted)".
std::string how_it_ended(int status);

}  // namespace pose_wall::tools::live
