// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Where base truly was at each frame: a truth.csv of the simulator, or a reference of others with a pose a row.

#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "study/truth/row_pairs.hpp"

namespace pose_wall::tools {

struct PoseTruth {
  std::vector<std::optional<Eigen::Isometry3d>> T_world_base;  // none: this row has no pose
  bool world_is_road = false;                                  // the simulator's: X is the road's axis, Z is up
  std::vector<Eigen::Vector3d> along_world;  // the road's direction at each row, where it is known; else empty
  RowKeys keys;
};

// Poses as x, y, z, qx, qy, qz, qw, or as r00 ... r22 (by rows), tx, ty, tz. Throws CsvError that names line and
// column.
PoseTruth read_pose_truth(const CsvTable& table);

}  // namespace pose_wall::tools
