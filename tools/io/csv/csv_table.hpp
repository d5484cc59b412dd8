// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Comma-separated tables (RFC 4180: a cell with a comma, quote or line break stands in quotes).

#pragma once

#include <cstddef>
#include <istream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace pose_wall::tools {

// The cell as it stands in a file.
std::string csv_cell(std::string_view text);

std::string csv_line(const std::vector<std::string>& cells);

// Nine significant digits; empty for NaN and infinities.
std::string csv_number(double value);

// The message names line and column, not the file.
class CsvError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A table with a head. Lines that start with '#' before the head are comments; empty lines do not count.
class CsvTable {
 public:
  // Throws CsvError when there is no head, a name appears twice in it, a row has another number of cells, or it
  // is JSON.
  static CsvTable parse(std::istream& stream);

  std::size_t rows() const { return cells_.size(); }
  const std::vector<std::string>& head() const { return head_; }

  std::optional<std::size_t> find_column(std::string_view name) const;

  const std::string& cell(std::size_t row, std::size_t column) const { return cells_[row][column]; }

  // Of the file, from 1: where the row begins.
  std::size_t line(std::size_t row) const { return lines_[row]; }

  // NaN for an empty cell. Throws CsvError for a cell that is no number.
  double number(std::size_t row, std::size_t column) const;
  // The names of its columns for a message: of many, the first ones and how many there are.
  std::string head_text() const;

 private:
  std::vector<std::string> head_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<std::size_t> lines_;
};

}  // namespace pose_wall::tools
