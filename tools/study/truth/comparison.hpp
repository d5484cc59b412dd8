// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A table of results beside a table of truth, row by row.

#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "pose_wall.h"
#include "study/truth/alert_limits.hpp"
#include "study/truth/error_statistics.hpp"

namespace pose_wall::tools {

struct QuantityComparison {
  std::uint32_t index;  // pose_wall_quantity
  std::string name;
  bool is_angle;
  ErrorStatistics statistics;
};

struct Comparison {
  std::string matched_by;  // "stamp_ns" or "frame"
  std::size_t matched = 0;
  std::size_t other_stamps = 0;  // of those matched by frame: are they of the same frame at all?
  std::size_t result_rows_alone = 0;
  std::size_t truth_rows_alone = 0;
  std::vector<std::pair<std::size_t, std::size_t>> rows;  // of results and of truth that belong together
  std::vector<QuantityComparison> quantities;             // those that the truth has
};

// Rows belong together as pair_rows says. Throws CsvError for missing columns, a row number that appears twice, or
// tables that share no row.
Comparison compare_with_truth(const CsvTable& results, const CsvTable& truth, const AlertLimits& limits);

}  // namespace pose_wall::tools
