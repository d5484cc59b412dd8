// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The file of a finished run: a table whose first line bears the fingerprint of its campaign.

#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "io/frames/text_cursor.hpp"
#include "lab/campaign/plan.hpp"

namespace pose_wall::tools::campaign {

// The file appears whole or not at all. Throws std::runtime_error that names it.
void write_record_file(const std::filesystem::path& file, const std::string& table, const std::string& campaign);

// Hands the table to `take`. Throws std::runtime_error that names the file: for a record of another campaign, and for
// the CsvError that `take` throws.
void read_record_file(const std::filesystem::path& file, const std::string& campaign,
                      const std::function<void(const CsvTable&)>& take);

// The columns in front, which say whose run it is.
std::vector<std::string> run_head();
std::vector<std::string> run_cells(const Run& run);
// By the first row; without its frames. Throws CsvError, for a table without rows, too.
Run run_of(const CsvTable& table);

// Stamps and seeds need all their digits: not by way of a double. Throws CsvError.
template <typename Integer>
Integer whole_number(const std::string& cell) {
  const std::optional<Integer> value = parse_number<Integer>(cell);
  if (!value) throw CsvError(fmt::format("'{}' is no whole number", cell));
  return *value;
}

}  // namespace pose_wall::tools::campaign
