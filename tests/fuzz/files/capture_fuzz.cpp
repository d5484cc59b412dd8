// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as a capture of packets. What begins with a brace is, up to the first empty line, the metadata of
// an Ouster sensor.

#include <string_view>

#include "fuzz/files/recording_target.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using pose_wall::test::MemoryFile;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  const std::size_t end = size > 0 && data[0] == '{' ? bytes.find("\n\n") : std::string_view::npos;
  if (end == std::string_view::npos) {
    const MemoryFile file(data, size);
    pose_wall::test::take_frames(file.path(), "");
    return 0;
  }
  const MemoryFile metadata(data, end), file(data + end + 2, size - end - 2);
  pose_wall::test::take_frames(file.path(), metadata.path());
  return 0;
}
