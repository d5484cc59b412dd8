// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "containers/direction_grid.hpp"

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

FourInts DirectionGrid::cells_of(FourFloats x, FourFloats y, FourFloats z, FourFloats norm2) {
  constexpr float kColumnsPerWay = kColumns / 4.0F, kRowsPerSine = kRows / 2.0F;
  const FourFloats none{}, last_row = all_four(kRows - 1.0F), past_columns = all_four(static_cast<float>(kColumns));
  const FourFloats around = magnitude_of(x) + magnitude_of(y);
  const FourFloats share = around > none ? y / around : none;
  const FourFloats way = x < none ? 2.0F - share : (share >= none ? share : 4.0F + share);
  const FourFloats up = norm2 > none ? z / root_of(norm2) : none;
  const FourFloats row = (up + 1.0F) * kRowsPerSine, column = way * kColumnsPerWay;
  // Written so that what is not a number falls into some cell too.
  const FourFloats in_rows = row < last_row ? (row > none ? row : none) : last_row;
  const FourFloats in_columns = column < past_columns ? (column > none ? column : none) : none;
  return cut_off(in_rows) * static_cast<std::int32_t>(kColumns) + cut_off(in_columns);
}

DirectionGrid::Column DirectionGrid::column(std::uint32_t column) {
  const Corner middle = middle_of(column);
  const double length2 = middle.length2(), scale = 1.0 / std::sqrt(length2);
  return {middle.x * scale, middle.y * scale, 1.0 / length2};
}

double DirectionGrid::width(std::uint32_t column) {
  return 1.0 / middle_of(column).length2();
}

}  // namespace pose_wall
