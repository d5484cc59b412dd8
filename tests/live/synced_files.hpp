// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the program under test has asked the system to put on the disk: fsync of these tests notes it.

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace pose_wall::test {

struct Synced {
  std::filesystem::path path;
  std::string beside;  // what the file that is watched held then
};

// Of which file a sync notes what it holds, and whether syncs fail from now on as those of a broken disk do. Forgets
// earlier ones.
void watch_syncs(const std::filesystem::path& watched, bool fail = false);
std::vector<Synced> synced_files();

}  // namespace pose_wall::test
