// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/planar/localised_rows.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string_view>

namespace pose_wall::tools {
namespace {

// Columns whose cell is a number, in the order of the file.
struct LocalisedNumber {
  const char* name;
  double& (*of)(LocalisedRow& row);
};
constexpr LocalisedNumber kLocalisedNumbers[] = {
    {"x_m", [](LocalisedRow& row) -> double& { return row.base.x_m; }},
    {"y_m", [](LocalisedRow& row) -> double& { return row.base.y_m; }},
    {"yaw_rad", [](LocalisedRow& row) -> double& { return row.base.yaw_rad; }},
    {"xx_m2", [](LocalisedRow& row) -> double& { return row.covariance[0]; }},
    {"xy_m2", [](LocalisedRow& row) -> double& { return row.covariance[1]; }},
    {"x_yaw_m_rad", [](LocalisedRow& row) -> double& { return row.covariance[2]; }},
    {"yy_m2", [](LocalisedRow& row) -> double& { return row.covariance[3]; }},
    {"y_yaw_m_rad", [](LocalisedRow& row) -> double& { return row.covariance[4]; }},
    {"yaw_yaw_rad2", [](LocalisedRow& row) -> double& { return row.covariance[5]; }},
    {"fits", [](LocalisedRow& row) -> double& { return row.fits; }},
    {"explained", [](LocalisedRow& row) -> double& { return row.explained; }},
    {"misfit_m", [](LocalisedRow& row) -> double& { return row.misfit_m; }},
    {"slide_m", [](LocalisedRow& row) -> double& { return row.slide_m; }},
    {"rival", [](LocalisedRow& row) -> double& { return row.rival; }},
    {"progress", [](LocalisedRow& row) -> double& { return row.progress; }},
    {"travel_m", [](LocalisedRow& row) -> double& { return row.travel_m; }},
    {"error_m", [](LocalisedRow& row) -> double& { return row.error_m; }},
    {"error_rad", [](LocalisedRow& row) -> double& { return row.error_rad; }},
};
struct LocalisedCount {
  const char* name;
  std::uint32_t LocalisedRow::*of;
};
constexpr LocalisedCount kLocalisedCounts[] = {
    {"candidates", &LocalisedRow::candidates}, {"searches", &LocalisedRow::searches}, {"lost", &LocalisedRow::lost}};

std::vector<std::string> localised_columns() {
  std::vector<std::string> names = {"scan", "time_s", "state", "reason", "restart"};
  for (const LocalisedCount& column : kLocalisedCounts) names.emplace_back(column.name);
  for (const LocalisedNumber& column : kLocalisedNumbers) names.emplace_back(column.name);
  return names;
}

class LocalisedColumns {
 public:
  explicit LocalisedColumns(const CsvTable& table) : table_(table) {}
  std::size_t need(const char* name) const {
    const std::optional<std::size_t> column = table_.find_column(name);
    if (!column) throw CsvError(fmt::format("no column {}", name));
    return *column;
  }
  const std::string& word(std::size_t row, const char* name) const { return table_.cell(row, need(name)); }
  double number(std::size_t row, const char* name) const { return table_.number(row, need(name)); }
  std::uint32_t count(std::size_t row, const char* name) const {
    const double value = number(row, name);
    if (!(value >= 0.0 && value <= 4e9)) refuse(row, name);
    return static_cast<std::uint32_t>(value);
  }
  // Number of the name among `most`.
  std::uint32_t named(std::size_t row, const char* name, const char* (*name_of)(std::uint32_t),
                      std::uint32_t most) const {
    for (std::uint32_t k = 0; k < most; ++k) {
      if (word(row, name) == name_of(k)) return k;
    }
    refuse(row, name);
  }

 private:
  [[noreturn]] void refuse(std::size_t row, const char* name) const {
    throw CsvError(fmt::format("line {}: {}: '{}'", table_.line(row), name, word(row, name)));
  }
  const CsvTable& table_;
};

}  // namespace

LocalisedRow row_of(const pose_wall_planar_localise_result& result) {
  const double* const c = result.covariance;
  LocalisedRow row;
  row.state = result.state;
  row.reason = result.reason;
  row.base = result.pose;
  row.covariance = {c[0], c[1], c[2], c[4], c[5], c[8]};
  row.fits = result.fits;
  row.explained = result.explained;
  row.misfit_m = result.misfit_m;
  row.slide_m = result.slide_m;
  row.rival = result.rival;
  row.progress = result.progress;
  row.candidates = result.candidates;
  row.searches = result.searches;
  row.lost = result.lost;
  return row;
}

std::string localised_csv(const std::vector<LocalisedRow>& rows) {
  std::string csv = csv_line(localised_columns());
  for (LocalisedRow row : rows) {
    std::vector<std::string> cells = {std::to_string(row.scan), row.time,
                                      pose_wall_planar_localise_state_name(row.state),
                                      pose_wall_planar_localise_reason_name(row.reason), row.is_restart ? "1" : "0"};
    for (const LocalisedCount& column : kLocalisedCounts) cells.push_back(std::to_string(row.*column.of));
    for (const LocalisedNumber& column : kLocalisedNumbers) cells.push_back(csv_number(column.of(row)));
    csv += csv_line(cells);
  }
  return csv;
}

bool is_localised_table(const CsvTable& table) {
  return table.find_column("state") && table.find_column("fits") && table.find_column("candidates");
}

std::vector<LocalisedRow> read_localised_rows(const CsvTable& table) {
  const LocalisedColumns columns(table);
  std::vector<LocalisedRow> rows(table.rows());
  for (std::size_t k = 0; k < rows.size(); ++k) {
    LocalisedRow& row = rows[k];
    row.scan = columns.count(k, "scan");
    row.time = columns.word(k, "time_s");
    row.state = columns.named(k, "state", pose_wall_planar_localise_state_name, kLocaliseStates);
    row.reason = columns.named(k, "reason", pose_wall_planar_localise_reason_name, POSE_WALL_PLANAR_LOCALISE_REASONS);
    row.is_restart = columns.count(k, "restart") == 1;
    for (const LocalisedCount& column : kLocalisedCounts) row.*column.of = columns.count(k, column.name);
    for (const LocalisedNumber& column : kLocalisedNumbers) column.of(row) = columns.number(k, column.name);
  }
  return rows;
}

std::string candidates_csv(const std::vector<CandidateRow>& rows) {
  std::string csv = csv_line({"scan", "candidate", "x_m", "y_m", "yaw_rad", "weight", "worse_by", "fits", "spread_m"});
  for (const CandidateRow& row : rows) {
    const pose_wall_planar_candidate& one = row.candidate;
    csv += csv_line({std::to_string(row.scan), std::to_string(row.number), csv_number(one.pose.x_m),
                     csv_number(one.pose.y_m), csv_number(one.pose.yaw_rad), csv_number(one.weight),
                     csv_number(one.worse_by), csv_number(one.fits), csv_number(one.spread_m)});
  }
  return csv;
}

}  // namespace pose_wall::tools
