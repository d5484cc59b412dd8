// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "containers/arena.hpp"
#include "containers/span.hpp"

namespace pose_wall {

// How many returns came from each direction: columns around the z axis, rows by the sine of the elevation. In the
// lidar frame, where a spinning sensor sees a row alike at every azimuth.
class DirectionGrid {
 public:
  static constexpr std::uint32_t kColumns = 128;
  static constexpr std::uint32_t kRows = 64;

  void lay_out(Arena& arena) { counts_ = arena.take<std::uint16_t>(kColumns * kRows); }
  void clear() { counts_.fill(0); }
  void copy(const DirectionGrid& other) {
    for (std::uint32_t cell = 0; cell < kColumns * kRows; ++cell) counts_[cell] = other.counts_[cell];
  }

  // ray: finite and not zero.
  void add(const Eigen::Vector3d& ray, std::uint32_t returns);

  std::uint32_t count(std::uint32_t row, std::uint32_t column) const { return counts_[row * kColumns + column]; }

  // Sine of the elevation in the middle of a row.
  static double up(std::uint32_t row) { return (row + 0.5) * (2.0 / kRows) - 1.0; }

  // The middle of a column: a horizontal unit vector. Columns divide the square |x| + |y| = 1, which needs no
  // trigonometry, but at its corners they are narrower than between them: width is 1..2.
  struct Column {
    double x, y, width;
  };
  static Column column(std::uint32_t column);

 private:
  Span<std::uint16_t> counts_;
};

// What a cloud's points say by their direction alone, whatever became of them later.
struct ReturnsByDirection {
  DirectionGrid all;      // nearer than range_min and in the body boxes too
  DirectionGrid too_far;  // of these, beyond range_max: behind any wall, or a driver's mark for no return

  void lay_out(Arena& arena) {
    all.lay_out(arena);
    too_far.lay_out(arena);
  }
  void clear() {
    all.clear();
    too_far.clear();
  }
};

}  // namespace pose_wall
