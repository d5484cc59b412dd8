// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Where rows of text go, one by one: a file or standard output.

#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pose_wall::tools {

class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class RowOutput {
 public:
  // Opens the file (standard output for an empty path) and writes the head. Throws OutputError when it cannot be
  // written or is one of the inputs. option: what the path was given by.
  RowOutput(const std::string& path, const std::vector<std::filesystem::path>& inputs, std::string_view head,
            const char* option = "--output");

  // False when the row did not reach its place (disk full, pipe closed). Rows are flushed one by one, so that a
  // reader behind a pipe sees each frame as it is done.
  bool write(std::string_view row);

  bool is_stdout() const { return stream_ != &file_; }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  std::ofstream file_;
  std::ostream* stream_;
};

}  // namespace pose_wall::tools
