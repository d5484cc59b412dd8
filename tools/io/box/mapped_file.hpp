// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A file's bytes without a copy: black boxes may be larger than memory.

#pragma once

#include <cstdint>
#include <string>

namespace pose_wall::tools {

class MappedFile {
 public:
  // Throws std::runtime_error that names the file.
  explicit MappedFile(const std::string& path);
  ~MappedFile();
  MappedFile(const MappedFile&) = delete;
  MappedFile& operator=(const MappedFile&) = delete;

  const void* data() const { return data_; }
  std::uint64_t size() const { return size_; }

 private:
  void* data_ = nullptr;
  std::uint64_t size_ = 0;
};

}  // namespace pose_wall::tools
