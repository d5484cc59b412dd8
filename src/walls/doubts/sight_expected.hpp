// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What is to be expected from the directions of a frame, whatever plane is looked at.

#pragma once

#include "cloud/direction_grid.hpp"

namespace pose_wall {

// How many returns a cell of directions has where nothing is dark. A sensor looks the same way all around, so each row
// is compared with itself.
class ExpectedReturns {
 public:
  void look_at(const DirectionGrid& returns_lidar);
  double at(std::uint32_t row, std::uint32_t column) const { return per_width_[row] * width_[column]; }

 private:
  double per_width_[DirectionGrid::kRows];
  double width_[DirectionGrid::kColumns];
};

// Columns that the sensor looks at. The two widest sectors from which nothing comes at any elevation are out of sight:
// blocked, or beyond its field of view. More of them are gaps of a row of things with nothing behind it.
struct SeenColumns {
  void look_at(const DirectionGrid& returns_lidar, const ExpectedReturns& expected);
  bool is_seen[DirectionGrid::kColumns];
};

}  // namespace pose_wall
