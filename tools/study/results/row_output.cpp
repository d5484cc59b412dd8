// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/results/row_output.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <iostream>
#include <system_error>

#include "io/language/language.hpp"
#include "io/language/system_errors.hpp"

namespace pose_wall::tools {

RowOutput::RowOutput(const std::string& path, const std::vector<std::filesystem::path>& inputs, std::string_view head,
                     const char* option)
    : name_(path.empty() ? tr("standard output") : path), stream_(path.empty() ? &std::cout : &file_) {
  if (!path.empty()) {
    for (const std::filesystem::path& input : inputs) {
      std::error_code ignored;
      if (std::filesystem::equivalent(path, input, ignored)) {
        throw OutputError(say("{} {}: this is an input; it would be overwritten", option, path));
      }
    }
    errno = 0;
    file_.open(path, std::ios::binary | std::ios::trunc);
    if (!file_) {
      throw OutputError(say("{} {}: cannot be written: {}", option, path, system_error_text(errno)));
    }
  }
  *stream_ << head << std::flush;
  if (!*stream_) throw OutputError(say("{}: cannot be written", name_));
}

bool RowOutput::write(std::string_view row) {
  *stream_ << row << std::flush;
  return static_cast<bool>(*stream_);
}

}  // namespace pose_wall::tools
