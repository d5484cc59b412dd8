// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/motion/motion_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

#include "io/csv/csv_table.hpp"
#include "io/frames/frame.hpp"

namespace pose_wall::tools {
namespace {

using MotionResult = pose_wall_motion_result;

// A column that has no value where the frame could not be read.
struct MotionColumn {
  std::string name;
  std::function<std::string(const MotionResult&)> cell;
};
using MotionColumns = std::vector<MotionColumn>;

bool has_motion_pose(const MotionResult& result) {
  return result.along_state != POSE_WALL_ALONG_LOST;
}

void add_number(MotionColumns* columns, const std::string& name, double MotionResult::*number) {
  columns->push_back({name, [number](const MotionResult& r) { return csv_number(r.*number); }});
}

void add_count(MotionColumns* columns, const std::string& name, std::uint32_t MotionResult::*count) {
  columns->push_back({name, [count](const MotionResult& r) { return std::to_string(r.*count); }});
}

template <std::size_t kSize>
void add_item(MotionColumns* columns, const std::string& name, double (MotionResult::*numbers)[kSize], std::size_t i) {
  columns->push_back({name, [numbers, i](const MotionResult& r) { return csv_number((r.*numbers)[i]); }});
}

template <std::size_t kSize>
void add_items(MotionColumns* columns, const std::vector<std::string>& names, double (MotionResult::*numbers)[kSize]) {
  for (std::size_t i = 0; i < names.size(); ++i) add_item(columns, names[i], numbers, i);
}

// Of the pose, which a lost frame has not.
template <std::size_t kSize>
void add_of_pose(MotionColumns* columns, const std::vector<std::string>& names,
                 double (MotionResult::*numbers)[kSize]) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    columns->push_back({names[i], [numbers, i](const MotionResult& r) {
                          return has_motion_pose(r) ? csv_number((r.*numbers)[i]) : std::string{};
                        }});
  }
}

std::string direction_column(std::uint32_t direction, const char* prefix, const char* ending) {
  return prefix + std::string(pose_wall_motion_direction_name(direction)) + ending;
}

// A level without bound is said to be so: a missing one would be no promise at all.
void add_directions(MotionColumns* columns, const char* prefix, const char* ending,
                    double (MotionResult::*numbers)[POSE_WALL_MOTION_DIRECTIONS],
                    const std::vector<std::uint32_t>& which) {
  for (const std::uint32_t d : which) {
    columns->push_back({direction_column(d, prefix, ending), [numbers, d](const MotionResult& r) {
                          return std::isinf((r.*numbers)[d]) ? "inf" : csv_number((r.*numbers)[d]);
                        }});
  }
}

// In front of `reason`.
MotionColumns make_pose_columns() {
  MotionColumns columns;
  add_of_pose(&columns, {"x", "y", "z"}, &MotionResult::position_m);
  add_of_pose(&columns, {"qx", "qy", "qz", "qw"}, &MotionResult::quaternion);
  columns.push_back({"along_state", [](const MotionResult& r) {
                       return std::string(pose_wall_motion_along_state_name(r.along_state));
                     }});
  columns.push_back(
      {"along_m", [](const MotionResult& r) { return has_motion_pose(r) ? csv_number(r.along_m) : std::string{}; }});
  add_directions(&columns, "", "_sigma", &MotionResult::sigma, {POSE_WALL_MOTION_ALONG});
  add_directions(&columns, "", "_pl", &MotionResult::protection_level,
                 {POSE_WALL_MOTION_ALONG, POSE_WALL_MOTION_ACROSS, POSE_WALL_MOTION_UP, POSE_WALL_MOTION_ROLL,
                  POSE_WALL_MOTION_PITCH, POSE_WALL_MOTION_YAW});
  return columns;
}

// Behind `total_ms`.
MotionColumns make_step_columns() {
  MotionColumns columns;
  add_items(&columns, {"step_x", "step_y", "step_z"}, &MotionResult::step_m);
  add_items(&columns, {"step_rx", "step_ry", "step_rz"}, &MotionResult::step_rad);
  add_directions(&columns, "step_", "_pl", &MotionResult::step_protection_level,
                 {POSE_WALL_MOTION_ALONG, POSE_WALL_MOTION_ACROSS, POSE_WALL_MOTION_UP, POSE_WALL_MOTION_YAW});
  add_number(&columns, "contrast", &MotionResult::contrast);
  add_number(&columns, "patches", &MotionResult::patches);
  add_number(&columns, "halves_m", &MotionResult::halves_m);
  add_number(&columns, "second_m", &MotionResult::second_m);
  add_number(&columns, "second_gain", &MotionResult::second_gain);
  add_count(&columns, "points", &MotionResult::points_used);
  add_count(&columns, "ground", &MotionResult::ground_points);
  add_count(&columns, "clusters", &MotionResult::clusters);
  add_count(&columns, "edges", &MotionResult::edge_points);
  add_count(&columns, "planes", &MotionResult::plane_points);
  add_count(&columns, "matched", &MotionResult::matched);
  add_count(&columns, "tiles", &MotionResult::tiles);
  add_number(&columns, "step_s", &MotionResult::step_s);
  add_directions(&columns, "", "_sigma", &MotionResult::sigma,
                 {POSE_WALL_MOTION_ACROSS, POSE_WALL_MOTION_UP, POSE_WALL_MOTION_ROLL, POSE_WALL_MOTION_PITCH,
                  POSE_WALL_MOTION_YAW});
  add_directions(&columns, "step_", "_sigma", &MotionResult::step_sigma,
                 {POSE_WALL_MOTION_ALONG, POSE_WALL_MOTION_ACROSS, POSE_WALL_MOTION_UP, POSE_WALL_MOTION_ROLL,
                  POSE_WALL_MOTION_PITCH, POSE_WALL_MOTION_YAW});
  add_directions(&columns, "step_", "_pl", &MotionResult::step_protection_level,
                 {POSE_WALL_MOTION_ROLL, POSE_WALL_MOTION_PITCH});
  add_items(&columns, {"road_x", "road_y", "road_z"}, &MotionResult::road_axis);
  add_count(&columns, "points_in", &MotionResult::points_in);
  add_count(&columns, "keyframes", &MotionResult::keyframes);
  add_count(&columns, "wide_start", &MotionResult::wide_start);
  return columns;
}

const MotionColumns& pose_columns() {
  static const MotionColumns columns = make_pose_columns();
  return columns;
}

const MotionColumns& step_columns() {
  static const MotionColumns columns = make_step_columns();
  return columns;
}

void add_motion_cells(const MotionOutcome& outcome, const MotionColumns& columns, std::vector<std::string>* cells) {
  for (const MotionColumn& column : columns) {
    if (outcome.result) {
      cells->push_back(column.cell(*outcome.result));
    } else {
      cells->emplace_back(column.name == "along_state" ? kUnreadableFrame : "");
    }
  }
}

// All digits of the stamp, which a double has not.
std::string seconds_text(std::int64_t stamp_ns) {
  constexpr std::uint64_t kNsPerS = 1'000'000'000;
  const auto whole = static_cast<std::uint64_t>(stamp_ns);
  const std::uint64_t magnitude_ns = stamp_ns < 0 ? 0 - whole : whole;
  return fmt::format("{}{}.{:09}", stamp_ns < 0 ? "-" : "", magnitude_ns / kNsPerS, magnitude_ns % kNsPerS);
}

}  // namespace

std::string motion_reason_names(std::uint32_t reasons) {
  std::string names;
  for (std::uint32_t bit = 0; bit < POSE_WALL_MOTION_REASON_COUNT; ++bit) {
    if ((reasons >> bit & 1U) != 0)
      names += (names.empty() ? "" : "|") + std::string(pose_wall_motion_reason_name(bit));
  }
  return names;
}

std::vector<std::string> motion_head() {
  std::vector<std::string> head = {"frame", "source", "stamp_ns"};
  for (const MotionColumn& column : pose_columns()) head.push_back(column.name);
  head.insert(head.end(), {"reason", "total_ms"});
  for (const MotionColumn& column : step_columns()) head.push_back(column.name);
  head.emplace_back("error");
  return head;
}

std::vector<std::string> motion_cells(const MotionOutcome& outcome) {
  std::vector<std::string> cells = {std::to_string(outcome.frame), outcome.source, std::to_string(outcome.stamp_ns)};
  add_motion_cells(outcome, pose_columns(), &cells);
  cells.push_back(outcome.result ? motion_reason_names(outcome.result->reasons) : kUnreadableFrame);
  cells.push_back(outcome.result ? csv_number(outcome.total_ms) : "");
  add_motion_cells(outcome, step_columns(), &cells);
  cells.push_back(outcome.error);
  return cells;
}

std::string tum_row(const MotionOutcome& outcome) {
  if (!outcome.result || !has_motion_pose(*outcome.result)) return "";
  std::string row = seconds_text(outcome.stamp_ns);
  for (const double number : outcome.result->position_m) row += fmt::format(" {:.9g}", number);
  for (const double number : outcome.result->quaternion) row += fmt::format(" {:.9g}", number);
  return row + '\n';
}

std::string map_as_ply(const std::vector<float>& xyz_m) {
  std::string file = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment map of pose_wall motion, m, in base of the first frame\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
      xyz_m.size() / 3);
  for (const float number : xyz_m) {
    char bytes[sizeof number];
    std::memcpy(bytes, &number, sizeof number);
    if (host_is_big_endian()) std::reverse(std::begin(bytes), std::end(bytes));
    file.append(bytes, sizeof number);
  }
  return file;
}

}  // namespace pose_wall::tools
