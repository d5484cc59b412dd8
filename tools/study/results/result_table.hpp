// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Reads the table that `pose_wall run` wrote: what became of each frame, as far as the table tells it.

#pragma once

#include <string>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "study/results/result_csv.hpp"

namespace pose_wall::tools {

// Of the columns that tables of every version have, those that this one lacks.
std::vector<std::string> missing_result_columns(const CsvTable& table);

// A row each. What has no column stays NaN or 0, and planes have no direction: the table has none. Throws CsvError,
// which names line and column, for a cell that is no such number, state or reason, and for a table that lacks columns.
std::vector<FrameOutcome> read_result_table(const CsvTable& table);

}  // namespace pose_wall::tools
