// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as a table of `pose_wall eval`, and as a truth.csv.

#include <sstream>
#include <stdexcept>
#include <string>

#include "fuzz/files/memory_file.hpp"
#include "fuzz/fuzz_target.hpp"
#include "io/csv/csv_table.hpp"
#include "io/csv/truth_csv.hpp"

namespace {

using pose_wall::test::require;

void read_table(const std::uint8_t* data, std::size_t size) {
  std::istringstream stream(std::string(reinterpret_cast<const char*>(data), size));
  const auto table = pose_wall::tools::CsvTable::parse(stream);
  for (std::size_t column = 0; column < table.head().size(); ++column) {
    require(table.find_column(table.head()[column]) == column, "a column is found by its name");
    for (std::size_t row = 0; row < table.rows(); ++row) {
      try {
        table.number(row, column);
      } catch (const pose_wall::tools::CsvError&) {
        require(!table.cell(row, column).empty(), "an empty cell is no fault");
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    read_table(data, size);
  } catch (const pose_wall::tools::CsvError& error) {
    require(error.what()[0] != '\0', "a refusal has a reason");
  }
  const pose_wall::test::MemoryFile file(data, size);
  try {
    pose_wall::tools::read_truth_csv(file.path());
  } catch (const std::runtime_error& error) {
    require(error.what()[0] != '\0', "a refusal has a reason");
  }
  return 0;
}
