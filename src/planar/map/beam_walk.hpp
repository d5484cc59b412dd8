// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The cells on a beam's way. Along its longer axis the beam crosses the middle of every cell once; the cell that it is
// in there is on its way. So corners that a beam cuts are not: by them, beams along a wall would wear it away.

#pragma once

#include <cmath>
#include <cstdint>

namespace pose_wall::planar {

struct BeamWalk {
  bool along_y = false;     // the longer axis
  std::int32_t at = 0;      // cell along it
  std::int32_t step = 1;    // to the next, 1 or -1
  std::int64_t across = 0;  // along the other axis, in 2^-32 of a cell
  std::int64_t slope = 0;   // per step
  std::int64_t cells = 0;   // that are left

  bool more() const { return cells > 0; }
  std::int32_t cell_across() const { return static_cast<std::int32_t>(across >> 32); }
  // 1 where the beam crosses the cell's outer quarters, 0 in the half between them.
  std::uint32_t beside_middle() const {
    constexpr std::uint32_t kQuarter = 0x40000000U;  // of the 2^32 of a cell
    return (static_cast<std::uint32_t>(across) - kQuarter) >> 31;
  }
  std::int32_t x() const { return along_y ? cell_across() : at; }
  std::int32_t y() const { return along_y ? at : cell_across(); }
};

// A straight line from a point in cells, in a unit direction.
struct BeamLine {
  double x, y, direction_x, direction_y;

  // The cells whose middles it crosses from `from` to `to`, both counted in cells along the line.
  BeamWalk walk(double from, double to) const {
    constexpr double kFractions = 4294967296.0;  // 2^32 in a cell: a step's error stays below 1e-5 over 10,000 cells
    BeamWalk walk;
    const double size_x = std::abs(direction_x), size_y = std::abs(direction_y);
    walk.along_y = size_y > size_x;
    const double main = walk.along_y ? y : x, main_direction = walk.along_y ? direction_y : direction_x;
    const double other = walk.along_y ? x : y, other_direction = walk.along_y ? direction_x : direction_y;
    const double size = walk.along_y ? size_y : size_x;
    const double first = std::floor(main), ahead = main_direction < 0.0 ? -1.0 : 1.0;
    const double to_middle = ahead * (first + 0.5 - main);  // along the axis, from the point to its own cell's middle
    const double skipped = std::ceil(from * size - to_middle), last = std::floor(to * size - to_middle);
    const double begin = skipped > 0.0 ? skipped : 0.0;
    if (!(last >= begin)) return walk;
    const double slope = other_direction / size;
    walk.step = main_direction < 0.0 ? -1 : 1;
    walk.at = static_cast<std::int32_t>(first + ahead * begin);
    walk.across = static_cast<std::int64_t>(std::floor((other + (to_middle + begin) * slope) * kFractions));
    walk.slope = static_cast<std::int64_t>(std::floor(slope * kFractions));
    walk.cells = static_cast<std::int64_t>(last - begin) + 1;
    return walk;
  }
};

}  // namespace pose_wall::planar
