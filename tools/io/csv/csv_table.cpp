// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/csv/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "io/frames/text_cursor.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// Splits one record; a quoted cell may hold line breaks, so that further lines are taken from the stream.
std::vector<std::string> split_record(std::string line, std::istream& stream, std::size_t& line_number) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  const std::size_t first_line = line_number;
  for (std::size_t i = 0;; ++i) {
    if (i == line.size()) {
      if (!quoted) return cells;
      if (!std::getline(stream, line)) throw CsvError(say("line {}: a quote is not closed", first_line));
      ++line_number;
      cells.back() += '\n';
      i = std::numeric_limits<std::size_t>::max();
    } else if (quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[i++];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += line[i];
    }
  }
}

void check_head(const std::vector<std::string>& head) {
  std::set<std::string> seen;
  for (const std::string& name : head) {
    if (!seen.insert(name).second) throw CsvError(say("column '{}' appears twice", name));
  }
}

}  // namespace

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? "," : "") + csv_cell(cells[i]);
  return line + '\n';
}

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string{};
}

CsvTable CsvTable::parse(std::istream& stream) {
  CsvTable table;
  std::size_t line_number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++line_number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || (table.head_.empty() && line.front() == '#')) continue;
    if (table.head_.empty() && line.front() == '{') {
      throw CsvError(
          say("line {}: this is JSON; a table of CSV is allowed, as run writes it without --format json", line_number));
    }
    const std::size_t first_line = line_number;
    std::vector<std::string> cells = split_record(line, stream, line_number);
    if (table.head_.empty()) {
      check_head(cells);
      table.head_ = std::move(cells);
      continue;
    }
    if (cells.size() != table.head_.size()) {
      throw CsvError(say("line {}: {} cells, the head has {} columns", first_line, cells.size(), table.head_.size()));
    }
    table.cells_.push_back(std::move(cells));
    table.lines_.push_back(first_line);
  }
  if (table.head_.empty()) throw CsvError(tr("no line with column names"));
  return table;
}

std::optional<std::size_t> CsvTable::find_column(std::string_view name) const {
  const auto column = std::find(head_.begin(), head_.end(), name);
  if (column == head_.end()) return std::nullopt;
  return static_cast<std::size_t>(column - head_.begin());
}

std::string CsvTable::head_text() const {
  constexpr std::size_t kShown = 12;  // a line of a terminal
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, head_.size()); ++i) text += (i == 0 ? "" : ", ") + head_[i];
  return head_.size() > kShown ? say("{} and {} more", text, head_.size() - kShown) : text;
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  const std::string& text = cells_[row][column];
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::optional<double> number = parse_number<double>(text);
  if (!number) throw CsvError(say("line {}, column {}: '{}' is not a number", lines_[row], head_[column], text));
  return *number;
}

}  // namespace pose_wall::tools
