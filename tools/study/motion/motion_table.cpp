// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/motion/motion_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/frames/text_cursor.hpp"
#include "study/motion/motion_rows.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
constexpr const char* kTable = "motion table";

class MotionTableReader {
 public:
  explicit MotionTableReader(const CsvTable& table) : table_(table) {
    // The contract: tables of every version have these.
    for (const char* name : {"frame",
                             "source",
                             "stamp_ns",
                             "x",
                             "y",
                             "z",
                             "qx",
                             "qy",
                             "qz",
                             "qw",
                             "along_state",
                             "along_m",
                             "along_sigma",
                             "along_pl",
                             "across_pl",
                             "up_pl",
                             "roll_pl",
                             "pitch_pl",
                             "yaw_pl",
                             "reason",
                             "total_ms",
                             "step_x",
                             "step_y",
                             "step_z",
                             "step_rx",
                             "step_ry",
                             "step_rz",
                             "step_along_pl",
                             "step_across_pl",
                             "step_up_pl",
                             "step_yaw_pl"}) {
      demanded_column(table_, kTable, name);
    }
  }

  MotionRow row(std::size_t i) const {
    MotionRow row;
    row.frame = whole<std::uint64_t>(i, "frame");
    row.source = cell(i, "source");
    row.stamp_ns = whole<std::int64_t>(i, "stamp_ns");
    row.along_state = state(i);
    row.reason = cell(i, "reason");
    row.T_start_base = pose(i);
    row.along_m = number(i, "along_m");
    row.sigma = directions(i, "", "_sigma");
    row.level = directions(i, "", "_pl");
    row.T_last_base = step(i);
    row.step_sigma = directions(i, "step_", "_sigma");
    row.step_level = directions(i, "step_", "_pl");
    row.total_ms = number(i, "total_ms");
    check_lost(i, row);
    return row;
  }

 private:
  const std::string& cell(std::size_t i, const std::string& name) const {
    return table_.cell(i, *table_.find_column(name));
  }

  // NaN for an empty cell, and for a column that only later versions have.
  double number(std::size_t i, const std::string& name) const {
    const std::optional<std::size_t> column = table_.find_column(name);
    return column ? table_.number(i, *column) : kNoNumber;
  }

  template <typename Integer>
  Integer whole(std::size_t i, const char* name) const {
    const std::string& text = cell(i, name);
    const std::optional<Integer> value = parse_number<Integer>(text);
    if (!value) {
      throw CsvError(fmt::format("line {}, column {}: '{}' is no whole number", table_.line(i), name, text));
    }
    return *value;
  }

  std::optional<std::uint32_t> state(std::size_t i) const {
    const std::string& name = cell(i, "along_state");
    if (name == kUnreadableFrame) return std::nullopt;
    for (std::uint32_t state = POSE_WALL_ALONG_LOST; state <= POSE_WALL_ALONG_MEASURED; ++state) {
      if (name == pose_wall_motion_along_state_name(state)) return state;
    }
    throw CsvError(fmt::format(
        "line {}, column along_state: '{}' is no state; measured, ambiguous, unobservable, lost and unreadable are",
        table_.line(i), name));
  }

  // All of the numbers, or nothing where all are empty.
  template <std::size_t kSize>
  std::optional<std::array<double, kSize>> together(std::size_t i, const std::array<const char*, kSize>& names) const {
    std::array<double, kSize> numbers{};
    std::size_t finite = 0;
    for (std::size_t k = 0; k < kSize; ++k) {
      numbers[k] = number(i, names[k]);
      finite += std::isfinite(numbers[k]) ? 1U : 0U;
    }
    if (finite == kSize) return numbers;
    const bool all_empty =
        std::all_of(names.begin(), names.end(), [&](const char* name) { return cell(i, name).empty(); });
    if (all_empty) return std::nullopt;
    throw CsvError(
        fmt::format("line {}: of {} all are numbers or all are empty", table_.line(i), fmt::join(names, ", ")));
  }

  std::optional<Eigen::Isometry3d> pose(std::size_t i) const {
    const auto n = together<7>(i, {"x", "y", "z", "qx", "qy", "qz", "qw"});
    if (!n) return std::nullopt;
    const auto [x, y, z, qx, qy, qz, qw] = *n;
    const std::optional<Eigen::Quaterniond> R = unit_quaternion(qx, qy, qz, qw);
    if (!R) throw CsvError(fmt::format("line {}: qx, qy, qz, qw have not the length 1", table_.line(i)));
    return Eigen::Translation3d(x, y, z) * *R;
  }

  std::optional<Eigen::Isometry3d> step(std::size_t i) const {
    const auto n = together<6>(i, {"step_x", "step_y", "step_z", "step_rx", "step_ry", "step_rz"});
    if (!n) return std::nullopt;
    const auto [x, y, z, rx, ry, rz] = *n;
    const Eigen::Vector3d turn(rx, ry, rz);
    const double angle_rad = turn.norm();
    const Eigen::Vector3d axis = angle_rad > 0.0 ? Eigen::Vector3d(turn / angle_rad) : Eigen::Vector3d::UnitX();
    return Eigen::Translation3d(x, y, z) * Eigen::AngleAxisd(angle_rad, axis);
  }

  Directions directions(std::size_t i, const char* prefix, const char* ending) const {
    Directions numbers{};
    for (std::uint32_t d = 0; d < numbers.size(); ++d) {
      numbers[d] = number(i, prefix + std::string(pose_wall_motion_direction_name(d)) + ending);
    }
    return numbers;
  }

  void check_lost(std::size_t i, const MotionRow& row) const {
    const bool may_have_pose = row.along_state && *row.along_state != POSE_WALL_ALONG_LOST;
    if (may_have_pose == row.T_start_base.has_value()) return;
    throw CsvError(fmt::format("line {}: the state is {}, but there is {} pose", table_.line(i), cell(i, "along_state"),
                               may_have_pose ? "no" : "a"));
  }

  const CsvTable& table_;
};

}  // namespace

std::size_t demanded_column(const CsvTable& table, const char* which, const std::string& name) {
  const std::optional<std::size_t> column = table.find_column(name);
  if (!column) {
    throw CsvError(fmt::format("the {} has no column '{}'; columns: {}", which, name, table.head_text()));
  }
  return *column;
}

std::optional<Eigen::Quaterniond> unit_quaternion(double x, double y, double z, double w) {
  constexpr double kRounding = 1e-3;
  const Eigen::Quaterniond q(w, x, y, z);
  if (!(std::abs(q.norm() - 1.0) <= kRounding)) return std::nullopt;
  return q.normalized();
}

bool is_motion_table(const CsvTable& table) {
  return table.find_column("along_state") || table.find_column("along_m") || table.find_column("along_pl");
}

MotionTable read_motion_table(const CsvTable& table) {
  const MotionTableReader reader(table);
  MotionTable motion{{}, row_keys(table)};
  for (std::size_t i = 0; i < table.rows(); ++i) motion.rows.push_back(reader.row(i));
  return motion;
}

}  // namespace pose_wall::tools
