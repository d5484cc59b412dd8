// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/truth/row_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

using Rows = std::map<std::string, std::size_t>;

// Of no truth.
std::string yielded_key(std::size_t row) {
  return fmt::format("unreadable {}", row);
}

// Nothing where a row has no key, or two have the same.
std::optional<Rows> told_apart(const RowKeys::Column& column) {
  if (!column) return std::nullopt;
  Rows rows;
  for (std::size_t row = 0; row < column->size(); ++row) {
    const std::string& key = (*column)[row];
    if (key.empty() || !rows.emplace(key, row).second) return std::nullopt;
  }
  return rows;
}

Rows rows_by(const RowKeys::Column& column, const char* which, const std::string& key) {
  Rows rows;
  for (std::size_t row = 0; row < column->size(); ++row) {
    if (!rows.emplace((*column)[row], row).second) {
      throw CsvError(say("the {} have {} {} twice", tr(which), key, (*column)[row]));
    }
  }
  return rows;
}

RowPairs pairs_of(const char* by, const Rows& results, const Rows& truth) {
  RowPairs pairs;
  pairs.by = by;
  for (const auto& [key, row] : results) {
    const auto same = truth.find(key);
    if (same != truth.end()) pairs.rows.emplace_back(row, same->second);
  }
  std::sort(pairs.rows.begin(), pairs.rows.end());
  return pairs;
}

RowKeys::Column cells_of(const CsvTable& table, const char* name) {
  const std::optional<std::size_t> column = table.find_column(name);
  if (!column) return std::nullopt;
  std::vector<std::string> cells;
  for (std::size_t row = 0; row < table.rows(); ++row) cells.push_back(table.cell(row, *column));
  return cells;
}

RowPairs pairs_by(const char* by, const RowKeys::Column& results, const RowKeys::Column& truth) {
  return pairs_of(by, rows_by(results, translatable("results"), by), rows_by(truth, translatable("truth rows"), by));
}

}  // namespace

void yield_stamps(const std::vector<bool>& is_unreadable, RowKeys* keys) {
  std::vector<std::string>& stamps = *keys->stamp_ns;
  std::set<std::string> taken;
  for (std::size_t row = 0; row < stamps.size(); ++row) {
    if (!is_unreadable[row]) taken.insert(stamps[row]);
  }
  for (std::size_t row = 0; row < stamps.size(); ++row) {
    if (is_unreadable[row] && !taken.insert(stamps[row]).second) stamps[row] = yielded_key(row);
  }
}

RowKeys row_keys(const CsvTable& table) {
  RowKeys keys{cells_of(table, "frame"), cells_of(table, "stamp_ns")};
  const RowKeys::Column status = cells_of(table, table.find_column("status") ? "status" : "along_state");
  if (!keys.stamp_ns || !status) return keys;
  std::vector<bool> is_unreadable;
  for (const std::string& one : *status) is_unreadable.push_back(one == "unreadable");
  yield_stamps(is_unreadable, &keys);
  return keys;
}

RowPairs pair_rows(const RowKeys& results, const RowKeys& truth) {
  const bool have_frames = results.frame && truth.frame;
  const bool have_stamps = results.stamp_ns && truth.stamp_ns;
  if (!have_frames && !have_stamps) {
    throw CsvError(tr("rows cannot be matched: results and truth need a column 'frame' or 'stamp_ns' in common"));
  }
  if (!have_frames) return pairs_by("stamp_ns", results.stamp_ns, truth.stamp_ns);
  const std::optional<Rows> result_stamps = told_apart(results.stamp_ns), truth_stamps = told_apart(truth.stamp_ns);
  if (result_stamps && truth_stamps) {
    RowPairs pairs = pairs_of("stamp_ns", *result_stamps, *truth_stamps);
    if (!pairs.rows.empty()) return pairs;
  }
  RowPairs pairs = pairs_by("frame", results.frame, truth.frame);
  if (!have_stamps) return pairs;
  for (const auto& [result_row, truth_row] : pairs.rows) {
    const std::string& stamp = (*results.stamp_ns)[result_row];
    if (stamp != yielded_key(result_row) && stamp != (*truth.stamp_ns)[truth_row]) ++pairs.other_stamps;
  }
  return pairs;
}

}  // namespace pose_wall::tools
