// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "cloud/direction_grid.hpp"

namespace pose_wall {
namespace {

// On the square |x| + |y| = 1.
struct Corner {
  double x, y;
  double length2() const { return x * x + y * y; }
};

Corner middle_of(std::uint32_t column) {
  const double way = (column + 0.5) * (4.0 / DirectionGrid::kColumns);
  const double x = way < 2.0 ? 1.0 - way : way - 3.0;
  const double y = way < 1.0 ? way : (way < 3.0 ? 2.0 - way : way - 4.0);
  return {x, y};
}

}  // namespace

DirectionGrid::Column DirectionGrid::column(std::uint32_t column) {
  const Corner middle = middle_of(column);
  const double length2 = middle.length2(), scale = 1.0 / std::sqrt(length2);
  return {middle.x * scale, middle.y * scale, 1.0 / length2};
}

double DirectionGrid::width(std::uint32_t column) {
  return 1.0 / middle_of(column).length2();
}

}  // namespace pose_wall
