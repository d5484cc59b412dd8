// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Tables in files: what is wrong with one is told with the file's name in front.

#pragma once

#include <fmt/format.h>

#include <string>

#include "io/csv/csv_table.hpp"

namespace pose_wall::tools {

// What the step returns; a CsvError of it gets the file's name.
template <typename Step>
auto in_csv_file(const std::string& file, Step step) {
  try {
    return step();
  } catch (const CsvError& error) {
    throw CsvError(fmt::format("{}: {}", file, error.what()));
  }
}

// Throws CsvError that names the file.
CsvTable read_csv_file(const std::string& file);

}  // namespace pose_wall::tools
