// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/results/result_output.hpp"

#include "io/csv/csv_table.hpp"
#include "study/results/result_json.hpp"

namespace pose_wall::tools {

ResultOutput::ResultOutput(const std::string& path, const std::vector<std::filesystem::path>& inputs,
                           ResultFormat format, PartColumns parts)
    : format_(format),
      parts_(parts),
      rows_(path, inputs, format == ResultFormat::kCsv ? csv_line(result_head(parts)) : "") {}

bool ResultOutput::write(const FrameOutcome& outcome) {
  const bool is_json = format_ == ResultFormat::kJson;
  return rows_.write(is_json ? result_json_line(outcome) : csv_line(result_cells(outcome, parts_)));
}

}  // namespace pose_wall::tools
