// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The black box's sink as a file. Nothing is synced: a process that dies loses the record it was writing, a loss of
// power what the system had not written by then, on Linux as it is set by default the last half minute, in parts.

#pragma once

#include <cstdint>
#include <string>

namespace pose_wall::tools {

class FileSink {
 public:
  // Throws std::runtime_error that names the file; also when it holds something: who starts again after an incident
  // would erase what the box is for.
  explicit FileSink(const std::string& path);
  ~FileSink();
  FileSink(const FileSink&) = delete;
  FileSink& operator=(const FileSink&) = delete;

  // A pose_wall_runtime_sink; user: the FileSink.
  static std::int32_t write(void* user, std::uint64_t offset, const void* bytes, std::uint64_t count);

 private:
  int file_ = -1;
};

}  // namespace pose_wall::tools
