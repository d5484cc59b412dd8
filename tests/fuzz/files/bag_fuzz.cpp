// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as a bag: ROS 1, MCAP or SQLite.

#include "fuzz/files/recording_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const pose_wall::test::MemoryFile file(data, size);
  pose_wall::test::take_frames(file.path(), "");
  return 0;
}
