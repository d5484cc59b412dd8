// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/results/result_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <limits>

#include "io/csv/csv_table.hpp"
#include "io/numbers/quantities.hpp"

namespace pose_wall::tools {
namespace {

using Cell = std::function<std::string(const pose_wall_result&)>;

// A column that has no value when the frame could not be read.
struct Column {
  std::string name;
  Cell cell;
};

std::string millis(std::int64_t ns) {
  return csv_number(static_cast<double>(ns) * 1e-6);
}

// The columns of the contract: what a controller and an evaluation need.
void add_quantity(std::vector<Column>& columns, std::uint32_t q) {
  const std::string name = pose_wall_quantity_name(q);
  columns.push_back({name, [q](const pose_wall_result& r) { return csv_number(written_value(r.quantity[q]).value); }});
  columns.push_back({name + "_raw", [q](const pose_wall_result& r) { return csv_number(r.quantity[q].raw); }});
  columns.push_back(
      {name + "_sigma", [q](const pose_wall_result& r) { return csv_number(written_value(r.quantity[q]).sigma); }});
  columns.push_back({name + "_pl", [q](const pose_wall_result& r) {
                       return csv_number(written_value(r.quantity[q]).protection_level);
                     }});
  columns.push_back({name + "_state", [q](const pose_wall_result& r) {
                       return std::string(pose_wall_state_name(r.quantity[q].state));
                     }});
}

void add_quantity_details(std::vector<Column>& columns, std::uint32_t q) {
  const std::string name = pose_wall_quantity_name(q);
  columns.push_back(
      {name + "_confidence", [q](const pose_wall_result& r) { return csv_number(r.quantity[q].confidence); }});
  columns.push_back({name + "_age_s", [q](const pose_wall_result& r) { return csv_number(r.quantity[q].age_s); }});
  columns.push_back({name + "_reason", [q](const pose_wall_result& r) { return reason_names(r.quantity[q].reasons); }});
}

void add_plane(std::vector<Column>& columns, const std::string& name, pose_wall_plane pose_wall_result::*plane) {
  const auto add = [&](const char* what, auto get) {
    columns.push_back({name + "_" + what, [plane, get](const pose_wall_result& r) {
                         return (r.*plane).found != 0 ? get(r.*plane) : std::string{};
                       }});
  };
  add("distance_m", [](const pose_wall_plane& p) { return csv_number(p.d_m); });
  add("rms_m", [](const pose_wall_plane& p) { return csv_number(p.rms_m); });
  add("inliers", [](const pose_wall_plane& p) { return std::to_string(p.inliers); });
  add("iterations", [](const pose_wall_plane& p) { return std::to_string(p.iterations); });
  add("extent_min_m", [](const pose_wall_plane& p) { return csv_number(p.extent_min_m); });
  add("extent_max_m", [](const pose_wall_plane& p) { return csv_number(p.extent_max_m); });
  add("lean_rad", [](const pose_wall_plane& p) { return csv_number(p.lean_rad); });
  columns.push_back(
      {name + "_reason", [plane](const pose_wall_result& r) { return reason_names((r.*plane).reasons); }});
}

void add_counts(std::vector<Column>& columns) {
  const auto add = [&](const char* name, std::uint32_t pose_wall_result::*count) {
    columns.push_back({name, [count](const pose_wall_result& r) { return std::to_string(r.*count); }});
  };
  add("points_in", &pose_wall_result::points_in);
  add("dropped_not_finite", &pose_wall_result::dropped_not_finite);
  add("dropped_zero", &pose_wall_result::dropped_zero);
  add("dropped_near", &pose_wall_result::dropped_near);
  add("dropped_far", &pose_wall_result::dropped_far);
  add("dropped_body", &pose_wall_result::dropped_body);
  add("voxels", &pose_wall_result::voxels);
  add("outliers", &pose_wall_result::outliers);
  add("open_points", &pose_wall_result::open_points);
  add("wall_points", &pose_wall_result::wall_points);
}

std::vector<Column> make_columns() {
  std::vector<Column> columns;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) add_quantity(columns, q);
  columns.push_back({"frame_reason", [](const pose_wall_result& r) { return reason_names(r.frame_reasons); }});
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) add_quantity_details(columns, q);
  columns.push_back({"left_right_yaw_difference",
                     [](const pose_wall_result& r) { return csv_number(r.left_right_yaw_difference_rad); }});
  columns.push_back({"voxel_leaf_m", [](const pose_wall_result& r) { return csv_number(r.voxel_leaf_m); }});
  add_plane(columns, "floor", &pose_wall_result::floor);
  add_plane(columns, "left_wall", &pose_wall_result::left);
  add_plane(columns, "right_wall", &pose_wall_result::right);
  add_counts(columns);
  for (std::uint32_t stage = 0; stage < POSE_WALL_STAGES; ++stage) {
    columns.push_back({fmt::format("{}_ms", pose_wall_stage_name(stage)),
                       [stage](const pose_wall_result& r) { return millis(r.stage_ns[stage]); }});
  }
  return columns;
}

const std::vector<Column>& result_columns() {
  static const std::vector<Column> columns = make_columns();
  return columns;
}

// What this frame's own measurement is worth by itself, and what its level is mostly made of.
void add_level(std::vector<Column>& columns, std::uint32_t q) {
  const std::string name = pose_wall_quantity_name(q);
  columns.push_back(
      {name + "_raw_pl", [q](const pose_wall_result& r) { return csv_number(r.quantity[q].raw_protection_level); }});
  columns.push_back({name + "_raw_state", [q](const pose_wall_result& r) {
                       return std::string(pose_wall_state_name(r.quantity[q].raw_state));
                     }});
  columns.push_back(
      {name + "_cause", [q](const pose_wall_result& r) { return cause_name(written_value(r.quantity[q])); }});
}

void add_parts(std::vector<Column>& columns, std::uint32_t q) {
  for (std::uint32_t part = 0; part < POSE_WALL_PARTS; ++part) {
    columns.push_back(
        {fmt::format("{}_pl_{}", pose_wall_quantity_name(q), pose_wall_part_name(part)),
         [q, part](const pose_wall_result& r) { return csv_number(written_value(r.quantity[q]).part[part]); }});
  }
}

// Those behind `error`, which once was the last.
std::vector<Column> make_level_columns() {
  std::vector<Column> columns;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) add_level(columns, q);
  columns.push_back({"work", [](const pose_wall_result& r) { return std::to_string(r.work); }});
  return columns;
}

std::vector<Column> make_part_columns() {
  std::vector<Column> columns;
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) add_parts(columns, q);
  return columns;
}

const std::vector<Column>& level_columns() {
  static const std::vector<Column> columns = make_level_columns();
  return columns;
}

const std::vector<Column>& part_columns(PartColumns parts) {
  static const std::vector<Column> none, all = make_part_columns();
  return parts == PartColumns::kAll ? all : none;
}

std::string limit_cell(const FrameOutcome& outcome, double limit) {
  return outcome.result && limit > 0.0 ? csv_number(limit) : "";
}

void add_cells(const FrameOutcome& outcome, const std::vector<Column>& columns, std::vector<std::string>* cells) {
  for (const Column& column : columns) cells->push_back(outcome.result ? column.cell(*outcome.result) : std::string{});
}

}  // namespace

pose_wall_value written_value(const pose_wall_value& value) {
  pose_wall_value written = value;
  if (value.state != POSE_WALL_INVALID) return written;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  written.value = written.sigma = written.protection_level = kNone;
  std::fill(std::begin(written.part), std::end(written.part), kNone);
  written.cause = POSE_WALL_PARTS;
  return written;
}

std::uint32_t worst_state(const pose_wall_result& result) {
  std::uint32_t worst = POSE_WALL_VALID;
  for (const pose_wall_value& value : result.quantity) worst = std::min(worst, value.state);
  return worst;
}

std::uint32_t all_reasons(const pose_wall_result& result) {
  std::uint32_t reasons = result.frame_reasons;
  for (const pose_wall_value& value : result.quantity) reasons |= value.reasons;
  return reasons;
}

std::string reason_names(std::uint32_t reasons) {
  std::string names;
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    if ((reasons >> bit & 1U) != 0) names += (names.empty() ? "" : "|") + std::string(pose_wall_reason_name(bit));
  }
  return names;
}

std::vector<std::string> result_head(PartColumns parts) {
  std::vector<std::string> head = {"frame", "source", "stamp_ns", "confidence", "status", "reason", "total_ms"};
  for (const Column& column : result_columns()) head.push_back(column.name);
  head.insert(head.end(), {"load_ms", "processor_ms", "error"});
  for (const Column& column : level_columns()) head.push_back(column.name);
  for (const Column& column : part_columns(parts)) head.push_back(column.name);
  head.insert(head.end(), {kLimitColumns[0], kLimitColumns[1]});
  return head;
}

std::vector<std::string> result_cells(const FrameOutcome& outcome, PartColumns parts) {
  std::vector<std::string> cells = {std::to_string(outcome.frame), outcome.source, std::to_string(outcome.stamp_ns)};
  if (outcome.result) {
    const pose_wall_result& result = *outcome.result;
    cells.insert(cells.end(), {csv_number(result.confidence), pose_wall_state_name(worst_state(result)),
                               reason_names(all_reasons(result)), csv_number(outcome.total_ms)});
  } else {
    cells.insert(cells.end(), {"", "unreadable", "unreadable", ""});
  }
  add_cells(outcome, result_columns(), &cells);
  cells.insert(cells.end(), {outcome.result ? csv_number(outcome.load_ms) : "",
                             outcome.result ? csv_number(outcome.processor_ms) : "", outcome.error});
  add_cells(outcome, level_columns(), &cells);
  add_cells(outcome, part_columns(parts), &cells);
  cells.push_back(limit_cell(outcome, outcome.limits.angle_rad));
  cells.push_back(limit_cell(outcome, outcome.limits.distance_m));
  return cells;
}

}  // namespace pose_wall::tools
