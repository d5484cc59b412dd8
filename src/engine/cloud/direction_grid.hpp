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

// Directions in the lidar frame, where a spinning sensor sees a row alike at every azimuth: columns around the z axis,
// rows by the sine of the elevation.
class Directions {
 public:
  // 2.8 degrees wide; finer cells show smaller gaps, coarser ones expect more returns each. Powers of two, for the
  // masks below. Near the horizon a slice is 0.45 degrees high, a quarter of a row: rings of a sparse sensor lie four
  // slices apart, so a gap between two of them shows (DirectionRows).
  static constexpr std::uint32_t kColumns = 128;
  static constexpr std::uint32_t kSlices = 256;  // four to a row, and a power of two

  // A cell of a column and a slice. ray: finite and not zero.
  static std::uint32_t cell_of(const Eigen::Vector3d& ray);
  // Of four rays at once, finite ones; norm2: their squared lengths. Of rays shorter than 1e-19 it is some cell.
  // half_columns: which half of its column each is in, counted on.
  static FourInts cells_of(FourFloats x, FourFloats y, FourFloats z, FourFloats norm2, FourInts* half_columns);
  static FourInts cells_of(FourFloats x, FourFloats y, FourFloats z, FourFloats norm2) {
    FourInts half_columns;
    return cells_of(x, y, z, norm2, &half_columns);
  }
  // Sine of the elevation in the middle of a slice.
  static double up(double slice) { return (slice + 0.5) * (2.0 / kSlices) - 1.0; }

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
};

inline std::uint32_t Directions::cell_of(const Eigen::Vector3d& ray) {
  const double up = ray.z() / std::sqrt(ray.squaredNorm());
  const auto column = static_cast<std::uint32_t>(way_of(ray.x(), ray.y()) * (kColumns / 4.0));
  // Rounding may leave the sine of a tiny ray a little outside.
  const auto slice = static_cast<std::uint32_t>(up > -1.0 ? (up + 1.0) * (kSlices / 2.0) : 0.0);
  return (slice < kSlices ? slice : kSlices - 1) * kColumns + (column < kColumns ? column : 0);
}

inline FourInts Directions::cells_of(FourFloats x, FourFloats y, FourFloats z, FourFloats norm2,
                                     FourInts* half_columns) {
  // The way around the square is 4 long, sines reach from -1 to 1.
  constexpr float kHalvesPerWay = kColumns / 2.0F, kSlicesPerSine = kSlices / 2.0F;
  const FourFloats none{};
  const FourFloats around = magnitude_of(x) + magnitude_of(y);
  const FourFloats share = around > none ? y / around : none;
  const FourFloats way = x < none ? 2.0F - share : (share < none ? 4.0F + share : share);
  const FourFloats up = norm2 > none ? z / root_of(norm2) : none;
  // Rounding may reach the end of either: the last slice is the last, and after the last column comes the first. Of
  // squares that are hardly floats the sine is anything: it must still be one of the slices.
  constexpr auto kLast = static_cast<std::int32_t>(kSlices - 1);
  const FourInts slice = cut_off((up + 1.0F) * kSlicesPerSine), last = all_four_ints(kLast);
  *half_columns = cut_off(way * kHalvesPerWay) & static_cast<std::int32_t>(2 * kColumns - 1);
  return ((slice < last ? slice : last) & kLast) * static_cast<std::int32_t>(kColumns) + (*half_columns >> 1);
}

// Number of returns of each column, in so many rows.
template <std::uint32_t kRowsOf>
class DirectionCounts {
 public:
  static constexpr std::uint32_t kColumns = Directions::kColumns;  // all counts have the same
  enum : std::uint32_t { kRows = kRowsOf };

  void lay_out(Arena& arena) { counts_ = arena.take<std::uint16_t>(kColumns * kRows); }
  void clear() { counts_.fill(0); }
  void copy(const DirectionCounts& other) {
    for (std::uint32_t cell = 0; cell < kColumns * kRows; ++cell) counts_[cell] = other.counts_[cell];
  }
  void add(std::uint32_t cell, std::uint32_t returns) {
    constexpr std::uint32_t kCountMax = 0xFFFF;  // a counter of 16 bits stays full
    const std::uint32_t sum = counts_[cell] + returns;
    counts_[cell] = static_cast<std::uint16_t>(sum < kCountMax ? sum : kCountMax);
  }

  std::uint32_t count(std::uint32_t row, std::uint32_t column) const { return counts_[row * kColumns + column]; }
  // The columns of a row, side by side.
  const std::uint16_t* row(std::uint32_t row) const { return &counts_[row * kColumns]; }
  // True if any came from this cell or the three behind it in its row.
  bool any_in_four(std::uint32_t row, std::uint32_t column) const {
    std::uint64_t four;
    std::memcpy(&four, &counts_[row * kColumns + column], sizeof(four));
    return four != 0;
  }

 private:
  Span<std::uint16_t> counts_;
};

using DirectionSlices = DirectionCounts<Directions::kSlices>;  // as a cloud is read; 64 KiB
using DirectionGrid = DirectionCounts<64>;  // 1.8 degrees high near the horizon, as the walls are looked at; 16 KiB

// Rows made of slices. A sparse sensor has one ring or none in a row. Its origin is not quite that of its lasers, so
// the elevation of a ring depends on the range: a ring beside the border of two rows is in one of them near by and in
// the other far off, and each of them then looks silent. So borders lie between the rings of the frame.
class DirectionRows {
 public:
  DirectionRows();  // rows of equal height
  // Moves each border that a ring may cross to the nearest gap between rings, by half a row at most.
  void learn(const DirectionSlices& returns_lidar);
  // Sums up the slices of each row.
  void sum_up(const DirectionSlices& slices, DirectionGrid* rows) const;

  // The cell of a row from that of a slice.
  std::uint32_t cell_of(std::uint32_t of_slice) const {
    return row_of_[of_slice / Directions::kColumns] * Directions::kColumns + of_slice % Directions::kColumns;
  }
  // Sine of the elevation at which a row's returns come in the mean; without returns, in its middle.
  double up(std::uint32_t row) const { return up_[row]; }

 private:
  static constexpr std::uint32_t kSlicesPerRow = Directions::kSlices / DirectionGrid::kRows;  // four, of equal rows

  void set_rows(const std::uint32_t (&returns)[Directions::kSlices]);

  std::uint32_t first_slice_[DirectionGrid::kRows + 1];
  std::uint8_t row_of_[Directions::kSlices];
  double up_[DirectionGrid::kRows];
};

// Returns of a cloud by direction, whatever became of them later.
struct ReturnsByDirection {
  // As the cloud is read:
  DirectionSlices all_slices;      // including those nearer than range_min and in the body boxes
  DirectionSlices too_far_slices;  // those of them beyond range_max: behind any wall, or a driver's mark for no return
  // By settle():
  DirectionRows rows;
  DirectionGrid all, too_far;

  void lay_out(Arena& arena) {
    all_slices.lay_out(arena);
    too_far_slices.lay_out(arena);
    all.lay_out(arena);
    too_far.lay_out(arena);
  }
  void clear() {
    all_slices.clear();
    too_far_slices.clear();
  }
  // Learns the rows from all returns and sums them up.
  void settle() {
    rows.learn(all_slices);
    rows.sum_up(all_slices, &all);
    rows.sum_up(too_far_slices, &too_far);
  }
};

}  // namespace pose_wall
