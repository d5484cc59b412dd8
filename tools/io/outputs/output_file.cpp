// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/outputs/output_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"
#include "io/language/system_errors.hpp"

namespace pose_wall::tools {

OutputFile::OutputFile(const std::string& path, const std::vector<std::filesystem::path>& inputs, const char* option)
    : path_(path) {
  if (path == "-") {
    throw std::invalid_argument(fmt::format("{} -: this is not written to standard output; a file is allowed", option));
  }
  std::error_code ignored;
  // Taking the place of a link would leave what it points to as it was; taking that of a device would end the device.
  if (std::filesystem::is_symlink(path_, ignored) && std::filesystem::exists(path_, ignored)) {
    path_ = std::filesystem::canonical(path_, ignored);
  }
  for (const std::filesystem::path& input : inputs) {
    if (std::filesystem::equivalent(path_, input, ignored)) {
      throw std::invalid_argument(fmt::format("{} {}: this is an input; it would be overwritten", option, path));
    }
  }
  if (std::filesystem::is_directory(path_, ignored)) {
    throw std::invalid_argument(fmt::format("{} {}: this is a folder; a file is allowed", option, path));
  }
  if (std::filesystem::exists(path_, ignored) && !std::filesystem::is_regular_file(path_, ignored)) {
    throw std::invalid_argument(fmt::format("{} {}: this is a device; a file is allowed", option, path));
  }
  errno = 0;
  stream_.open(part_of(path_), std::ios::binary | std::ios::trunc);
  if (!stream_) {
    throw std::invalid_argument(say("{} {}: cannot be written: {}", option, path, system_error_text(errno)));
  }
}

OutputFile::~OutputFile() {
  if (!stream_.is_open()) return;
  stream_.close();
  std::error_code ignored;
  std::filesystem::remove(part_of(path_), ignored);
}

std::filesystem::path OutputFile::part() const {
  return part_of(path_);
}

void OutputFile::take_part() {
  std::error_code error;
  std::filesystem::rename(part(), path_, error);
  if (error) {
    throw std::runtime_error(say("{}: cannot be written{}", path_.string(), ": " + system_error_text(error.value())));
  }
  stream_.close();
}

void OutputFile::write(std::string_view text) {
  stream_.close();
  write_whole_file(path_, text);
}

}  // namespace pose_wall::tools
