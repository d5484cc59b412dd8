// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {

// Number of returns from each direction: columns around the z axis, rows by the sine of the elevation. In the lidar
// frame, where a spinning sensor sees a row alike at every azimuth.
class DirectionGrid {
 public:
  // 2.8 degrees wide and, near the horizon, 1.8 high. Judgement, 2026-11-21: finer cells show smaller gaps, coarser
  // ones expect more returns each. A grid takes 16 KiB. Powers of two, for the masks below:
  static constexpr std::uint32_t kColumns = 128;
  static constexpr std::uint32_t kRows = 64;

  void lay_out(Arena& arena) { counts_ = arena.take<std::uint16_t>(kColumns * kRows); }
  void clear() { counts_.fill(0); }
  void copy(const DirectionGrid& other) {
    for (std::uint32_t cell = 0; cell < kColumns * kRows; ++cell) counts_[cell] = other.counts_[cell];
  }

  // ray: finite and not zero.
  static std::uint32_t cell_of(const Eigen::Vector3d& ray);
  // Of four rays at once, finite ones; norm2: their squared lengths. Of rays shorter than 1e-19 it is some cell.
  static FourInts cells_of(FourFloats x, FourFloats y, FourFloats z, FourFloats norm2);
  void add(std::uint32_t cell, std::uint32_t returns) {
    constexpr std::uint32_t kCountMax = 0xFFFF;  // a counter of 16 bits stays full
    const std::uint32_t sum = counts_[cell] + returns;
    counts_[cell] = static_cast<std::uint16_t>(sum < kCountMax ? sum : kCountMax);
  }
  void add(const Eigen::Vector3d& ray, std::uint32_t returns) { add(cell_of(ray), returns); }

  std::uint32_t count(std::uint32_t row, std::uint32_t column) const { return counts_[row * kColumns + column]; }
  // True if any came from this cell or the three behind it in its row.
  bool any_in_four(std::uint32_t row, std::uint32_t column) const {
    std::uint64_t four;
    std::memcpy(&four, &counts_[row * kColumns + column], sizeof(four));
    return four != 0;
  }

  // Sine of the elevation in the middle of a row.
  static double up(std::uint32_t row) { return (row + 0.5) * (2.0 / kRows) - 1.0; }

  // The middle of a column: a horizontal unit vector. Columns divide the square |x| + |y| = 1, which needs no
  // trigonometry, but at its corners they are narrower than between them: width is 1..2.
  struct Column {
    double x, y, width;
  };
  static Column column(std::uint32_t column);
  static double width(std::uint32_t column);

 private:
  // Way around the square |x| + |y| = 1 from +X over +Y, 0..4.
  static double way_of(double x, double y) {
    const double around = std::fabs(x) + std::fabs(y);
    if (!(around > 0.0)) return 0.0;
    const double share = y / around;
    if (x < 0.0) return 2.0 - share;
    return share >= 0.0 ? share : 4.0 + share;
  }

  Span<std::uint16_t> counts_;
};

inline std::uint32_t DirectionGrid::cell_of(const Eigen::Vector3d& ray) {
  const double up = ray.z() / std::sqrt(ray.squaredNorm());
  const auto column = static_cast<std::uint32_t>(way_of(ray.x(), ray.y()) * (kColumns / 4.0));
  // Rounding may leave the sine of a tiny ray a little outside.
  const auto row = static_cast<std::uint32_t>(up > -1.0 ? (up + 1.0) * (kRows / 2.0) : 0.0);
  return (row < kRows ? row : kRows - 1) * kColumns + (column < kColumns ? column : 0);
}

inline FourInts DirectionGrid::cells_of(FourFloats x, FourFloats y, FourFloats z, FourFloats norm2) {
  // The way around the square is 4 long, sines reach from -1 to 1.
  constexpr float kColumnsPerWay = kColumns / 4.0F, kRowsPerSine = kRows / 2.0F;
  const FourFloats none{};
  const FourFloats around = magnitude_of(x) + magnitude_of(y);
  const FourFloats share = around > none ? y / around : none;
  const FourFloats way = x < none ? 2.0F - share : (share < none ? 4.0F + share : share);
  const FourFloats up = norm2 > none ? z / root_of(norm2) : none;
  // Rounding may reach the end of either: the last row is the last, and after the last column comes the first. Of
  // squares that are hardly floats the sine is anything: it must still be one of the rows.
  constexpr auto kLastRow = static_cast<std::int32_t>(kRows - 1);
  const FourInts row = cut_off((up + 1.0F) * kRowsPerSine), last_row = all_four_ints(kLastRow);
  const FourInts column = cut_off(way * kColumnsPerWay) & static_cast<std::int32_t>(kColumns - 1);
  return ((row < last_row ? row : last_row) & kLastRow) * static_cast<std::int32_t>(kColumns) + column;
}

// Returns of a cloud by direction, whatever became of them later.
struct ReturnsByDirection {
  DirectionGrid all;      // including those nearer than range_min and in the body boxes
  DirectionGrid too_far;  // those of them beyond range_max: behind any wall, or a driver's mark for no return

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
