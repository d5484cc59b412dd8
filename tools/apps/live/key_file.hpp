// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <fmt/format.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <string>

#include "io/language/system_errors.hpp"

namespace pose_wall::tools::live {

// A file that a key of the settings names. Throws std::runtime_error that names the key, the file and what is wrong.
inline std::ifstream open_key_file(const char* key, const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    throw std::runtime_error(fmt::format("{}: {}: cannot be read: {}", key, file, system_error_text(errno)));
  }
  return stream;
}

}  // namespace pose_wall::tools::live
