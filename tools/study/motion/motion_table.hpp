// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The table of `pose_wall motion`, read back.

#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "pose_wall_motion.h"
#include "study/truth/row_pairs.hpp"

namespace pose_wall::tools {

// By pose_wall_motion_direction, m or rad; NaN where the table has none.
using Directions = std::array<double, POSE_WALL_MOTION_DIRECTIONS>;

struct MotionRow {
  std::uint64_t frame = 0;
  std::string source;
  std::int64_t stamp_ns = 0;
  std::optional<std::uint32_t> along_state;  // none: the frame could not be read
  std::string reason;
  std::optional<Eigen::Isometry3d> T_start_base;
  double along_m = 0.0;
  Directions sigma{}, level{};
  std::optional<Eigen::Isometry3d> T_last_base;  // the step: base in base of the last frame
  Directions step_sigma{}, step_level{};
  double total_ms = 0.0;
};

struct MotionTable {
  std::vector<MotionRow> rows;
  RowKeys keys;
};

// Whether it is meant to be one, complete or not.
bool is_motion_table(const CsvTable& table);

// Throws CsvError that names line and column.
MotionTable read_motion_table(const CsvTable& table);

// The column's place. Throws CsvError that names it and those there are; which: "motion table".
std::size_t demanded_column(const CsvTable& table, const char* which, const std::string& name);

// The quaternion as a rotation; nothing unless it has length 1, up to what nine digits round.
std::optional<Eigen::Quaterniond> unit_quaternion(double x, double y, double z, double w);

}  // namespace pose_wall::tools
