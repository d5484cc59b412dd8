// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/csv/truth_csv.hpp"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <set>
#include <stdexcept>
#include <string>

#include "io/csv/csv_table.hpp"
#include "io/frames/whole_file.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

constexpr std::array<const char*, kTruthQuantities> kNames = {"roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"};

constexpr std::array<const char*, kPoseNumbers> kPoseNames = {"x", "y", "z", "qx", "qy", "qz", "qw"};

std::size_t column_of(const CsvTable& table, const char* name) {
  const auto column = table.find_column(name);
  if (!column) throw CsvError(say("no column '{}'", name));
  return *column;
}

// Stamps need all their digits: not by way of a double.
template <typename Integer>
Integer integer_of(const std::string& cell, const char* name) {
  Integer value{};
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc{} || end != cell.data() + cell.size()) {
    throw CsvError(say("column '{}': '{}' is no whole number", name, cell));
  }
  return value;
}

std::vector<TruthRow> rows_of(const CsvTable& table) {
  const std::size_t frame = column_of(table, "frame");
  const std::size_t stamp = column_of(table, "stamp_ns");
  std::vector<TruthRow> rows(table.rows());
  const bool has_pose = table.find_column(kPoseNames.front()).has_value();
  std::set<std::uint64_t> seen;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].frame = integer_of<std::uint64_t>(table.cell(i, frame), "frame");
    if (!seen.insert(rows[i].frame).second) throw CsvError(say("frame {} appears twice", rows[i].frame));
    rows[i].stamp_ns = integer_of<std::int64_t>(table.cell(i, stamp), "stamp_ns");
    for (std::size_t q = 0; q < kTruthQuantities; ++q) rows[i].value[q] = table.number(i, column_of(table, kNames[q]));
    if (!has_pose) continue;
    BasePose& pose = rows[i].pose.emplace();
    for (std::size_t k = 0; k < kPoseNumbers; ++k) pose[k] = table.number(i, column_of(table, kPoseNames[k]));
  }
  return rows;
}

}  // namespace

void write_truth_csv(const std::filesystem::path& file, const std::vector<TruthRow>& rows) {
  std::vector<std::string> cells = {"frame", "stamp_ns"};
  cells.insert(cells.end(), kNames.begin(), kNames.end());
  const bool has_pose = !rows.empty() && rows.front().pose.has_value();
  if (has_pose) cells.insert(cells.end(), kPoseNames.begin(), kPoseNames.end());
  std::string text = csv_line(cells);
  for (const TruthRow& row : rows) {
    cells = {std::to_string(row.frame), std::to_string(row.stamp_ns)};
    for (const double value : row.value) cells.push_back(csv_number(value));
    if (has_pose) {
      for (const double number : row.pose.value()) cells.push_back(csv_number(number));
    }
    text += csv_line(cells);
  }
  write_whole_file(file, text);
}

std::vector<TruthRow> read_truth_csv(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(say("{}: cannot open", file.string()));
  try {
    return rows_of(CsvTable::parse(in));
  } catch (const CsvError& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace pose_wall::tools
