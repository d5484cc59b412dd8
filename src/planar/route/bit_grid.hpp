// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The caller's cells as one bit each: 1 where the machine may not be. A row of a shape then costs one to three words.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "pose_wall_planar_grid.h"

namespace pose_wall::planar::route {

// POSE_WALL_OK, POSE_WALL_E_NULL, POSE_WALL_E_STRUCT_SIZE or POSE_WALL_PLANAR_E_GRID.
std::int32_t check_grid(const pose_wall_planar_grid* grid);

class BitGrid {
 public:
  void lay_out(Arena& arena, std::uint32_t width_max, std::uint32_t height_max);

  // False for a grid that does not fit. Cells from occupied_from on, unknown ones and those of no meaning are blocked.
  bool read(const pose_wall_planar_grid& grid, std::uint32_t occupied_from);

  // Squares of `step` cells of another grid as one cell each, blocked if one of them is or lies outside.
  void read_coarse(const BitGrid& of, std::int32_t step);

  std::int32_t width() const { return width_; }
  std::int32_t height() const { return height_; }
  double resolution_m() const { return resolution_m_; }

  // A place of the map in cells from the corner of cell (0, 0), and back.
  Eigen::Vector2d in_cells(const Eigen::Vector2d& map_m) const { return (map_m - origin_m_) / resolution_m_; }
  Eigen::Vector2d in_map(double column, double row) const {
    return origin_m_ + resolution_m_ * Eigen::Vector2d(column, row);
  }

  // One of the cells first to last of a row is blocked. All are inside the grid, and first <= last.
  bool is_any_blocked(std::int32_t row, std::int32_t first, std::int32_t last) const {
    const std::uint64_t* const words = &words_[static_cast<std::uint32_t>(row) * stride_];
    const std::int32_t from = first >> 6, to = last >> 6;
    const std::uint64_t head = ~0ULL << (first & 63), tail = ~0ULL >> (63 - (last & 63));
    if (from == to) return (words[from] & head & tail) != 0;
    std::uint64_t any = (words[from] & head) | (words[to] & tail);
    for (std::int32_t k = from + 1; k < to; ++k) any |= words[k];
    return any != 0;
  }
  bool is_blocked(std::int32_t row, std::int32_t column) const { return is_any_blocked(row, column, column); }

  // Distance from a corner of cells to the nearest blocked cell or to the edge of the grid, at most `most`, in cells.
  double clearance(std::int32_t column, std::int32_t row, std::int32_t most) const;

 private:
  void block(std::int32_t row, std::int32_t column) {
    words_[static_cast<std::uint32_t>(row) * stride_ + (static_cast<std::uint32_t>(column) >> 6)] |= 1ULL
                                                                                                     << (column & 63);
  }
  double in_row(std::int32_t column, std::int32_t row, std::int32_t most) const;

  Span<std::uint64_t> words_;
  std::uint32_t stride_ = 0;
  std::int32_t width_ = 0, height_ = 0;
  double resolution_m_ = 1.0;
  Eigen::Vector2d origin_m_ = Eigen::Vector2d::Zero();
};

}  // namespace pose_wall::planar::route
