// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "results/result_output.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <iostream>
#include <system_error>

#include "csv/csv_table.hpp"
#include "results/result_json.hpp"

namespace pose_wall::tools {

ResultOutput::ResultOutput(const std::string& path, const std::vector<std::filesystem::path>& inputs,
                           ResultFormat format, PartColumns parts)
    : name_(path.empty() ? "standard output" : path),
      format_(format),
      parts_(parts),
      stream_(path.empty() ? &std::cout : &file_) {
  if (!path.empty()) {
    for (const std::filesystem::path& input : inputs) {
      std::error_code ignored;
      if (std::filesystem::equivalent(path, input, ignored)) {
        throw OutputError(fmt::format("--output {}: this is an input; it would be overwritten", path));
      }
    }
    errno = 0;
    file_.open(path, std::ios::binary | std::ios::trunc);
    if (!file_) {
      throw OutputError(
          fmt::format("--output {}: cannot be written: {}", path, std::generic_category().message(errno)));
    }
  }
  if (format_ == ResultFormat::kCsv) *stream_ << csv_line(result_head(parts_));
  *stream_ << std::flush;
  if (!*stream_) throw OutputError(fmt::format("{}: cannot be written", name_));
}

bool ResultOutput::write(const FrameOutcome& outcome) {
  const bool is_json = format_ == ResultFormat::kJson;
  *stream_ << (is_json ? result_json_line(outcome) : csv_line(result_cells(outcome, parts_))) << std::flush;
  return static_cast<bool>(*stream_);
}

}  // namespace pose_wall::tools
