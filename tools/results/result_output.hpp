// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Where the results go, row by row: a file or standard output, as CSV or as lines of JSON.

#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "results/result_csv.hpp"

namespace pose_wall::tools {

class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class ResultFormat { kCsv, kJson };

class ResultOutput {
 public:
  // Opens the file (standard output for an empty path) and writes the head of a CSV. Throws OutputError when it cannot
  // be written or is one of the inputs.
  ResultOutput(const std::string& path, const std::vector<std::filesystem::path>& inputs,
               ResultFormat format = ResultFormat::kCsv, PartColumns parts = PartColumns::kNone);

  // False when the row did not reach its place (disk full, pipe closed). Rows are flushed one by one, so that a
  // reader behind a pipe sees each frame as it is done.
  bool write(const FrameOutcome& outcome);

  bool is_stdout() const { return stream_ != &file_; }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  ResultFormat format_;
  PartColumns parts_;  // of a CSV; JSON has them always
  std::ofstream file_;
  std::ostream* stream_;
};

}  // namespace pose_wall::tools
