// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Where the results go, row by row: a file or standard output, as CSV or as lines of JSON.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/results/result_csv.hpp"
#include "study/results/row_output.hpp"

namespace pose_wall::tools {

enum class ResultFormat { kCsv, kJson };

class ResultOutput {
 public:
  // As RowOutput; the head is that of a CSV.
  ResultOutput(const std::string& path, const std::vector<std::filesystem::path>& inputs,
               ResultFormat format = ResultFormat::kCsv, PartColumns parts = PartColumns::kNone);

  // As RowOutput.
  bool write(const FrameOutcome& outcome);

  bool is_stdout() const { return rows_.is_stdout(); }
  const std::string& name() const { return rows_.name(); }

 private:
  ResultFormat format_;
  PartColumns parts_;  // of a CSV; JSON has them always
  RowOutput rows_;
};

}  // namespace pose_wall::tools
