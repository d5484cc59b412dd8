// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/truth/comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <optional>

#include "io/language/language.hpp"
#include "io/numbers/quantities.hpp"
#include "study/truth/row_pairs.hpp"

namespace pose_wall::tools {
namespace {

struct ResultColumns {
  std::size_t value, raw, sigma, protection_level, state;
};

std::size_t required_column(const CsvTable& table, const char* which, const std::string& name) {
  const std::optional<std::size_t> column = table.find_column(name);
  if (!column) {
    throw CsvError(say("the {} have no column '{}'; columns: {}", tr(which), name, table.head_text()));
  }
  return *column;
}

ResultColumns result_columns(const CsvTable& results, const std::string& name) {
  const auto column = [&](const char* ending) {
    return required_column(results, translatable("results"), name + ending);
  };
  return {column(""), column("_raw"), column("_sigma"), column("_pl"), column("_state")};
}

// A row of a frame that could not be read has no state; it counts as not measured.
std::uint32_t state_number(const std::string& name) {
  for (std::uint32_t state = POSE_WALL_INVALID; state <= POSE_WALL_VALID; ++state) {
    if (name == pose_wall_state_name(state)) return state;
  }
  if (name.empty()) return POSE_WALL_INVALID;
  throw CsvError(say("'{}' is no state; valid, degraded, held and invalid are", name));
}

Measured measured_at(const CsvTable& results, std::size_t row, const ResultColumns& columns) {
  return {results.number(row, columns.value), results.number(row, columns.raw), results.number(row, columns.sigma),
          results.number(row, columns.protection_level), state_number(results.cell(row, columns.state))};
}

void match_rows(const CsvTable& results, const CsvTable& truth, Comparison& comparison) {
  RowPairs pairs = pair_rows(row_keys(results), row_keys(truth));
  if (pairs.rows.empty()) {
    throw CsvError(
        say("no row in common: {} result rows and {} truth rows share no {}", results.rows(), truth.rows(), pairs.by));
  }
  comparison.matched_by = pairs.by;
  comparison.matched = pairs.rows.size();
  comparison.other_stamps = pairs.other_stamps;
  comparison.result_rows_alone = results.rows() - pairs.rows.size();
  comparison.truth_rows_alone = truth.rows() - pairs.rows.size();
  comparison.rows = std::move(pairs.rows);
}

}  // namespace

Comparison compare_with_truth(const CsvTable& results, const CsvTable& truth, const AlertLimits& limits) {
  Comparison comparison;
  match_rows(results, truth, comparison);
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const std::string name = pose_wall_quantity_name(q);
    const std::optional<std::size_t> truth_column = truth.find_column(name);
    if (!truth_column) continue;
    const ResultColumns columns = result_columns(results, name);
    ErrorStatistics statistics(is_angle(q), limit_of(q, limits));
    for (const auto& [result_row, truth_row] : comparison.rows) {
      statistics.add(measured_at(results, result_row, columns), truth.number(truth_row, *truth_column));
    }
    comparison.quantities.push_back({q, name, is_angle(q), statistics});
  }
  if (comparison.quantities.empty()) {
    throw CsvError(say("the truth has none of the columns roll, pitch, yaw, d_lf, d_lb, d_rf, d_rb; columns: {}",
                       truth.head_text()));
  }
  return comparison;
}

}  // namespace pose_wall::tools
