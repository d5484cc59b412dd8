// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The cell of a voxel as one number.
//
// From the highest bit on: the place of an upright column of 4 x 4 cells along x and y, z, and x and y within the
// column. In the order of these numbers neighbours in space are neighbours in the list, as a rule, and what lies within
// a distance of a cell lies in a few runs of it: one for each column around.

#pragma once

#include <cstdint>

namespace pose_wall {

struct VoxelKey {
  // Cells are counted from the far corner: below 2^21 along each axis.
  static constexpr std::uint32_t kInColumnBits = 2;
  static constexpr std::uint32_t kColumnCells = 1U << kInColumnBits;
  static constexpr std::uint32_t kColumnBits = 19;
  static constexpr std::uint32_t kZBits = kColumnBits + kInColumnBits;
  static constexpr std::uint32_t kZShift = 2 * kInColumnBits;
  static constexpr std::uint32_t kYShift = kZShift + kZBits;
  static constexpr std::uint32_t kXShift = kYShift + kColumnBits;

  struct Cell {
    std::uint32_t x, y, z;
  };

  static std::uint64_t of(std::int32_t x, std::int32_t y, std::int32_t z) {
    constexpr std::int32_t kInColumn = static_cast<std::int32_t>(kColumnCells) - 1;
    const auto field = [](std::int32_t value, std::uint32_t shift) {
      return static_cast<std::uint64_t>(value) << shift;
    };
    return field(x >> kInColumnBits, kXShift) | field(y >> kInColumnBits, kYShift) | field(z, kZShift) |
           field(x & kInColumn, kInColumnBits) | field(y & kInColumn, 0);
  }

  static Cell cell_of(std::uint64_t key) {
    return {part(key, kXShift, kColumnBits) << kInColumnBits | part(key, kInColumnBits, kInColumnBits),
            part(key, kYShift, kColumnBits) << kInColumnBits | part(key, 0, kInColumnBits), z_of(key)};
  }

  static std::uint32_t z_of(std::uint64_t key) { return part(key, kZShift, kZBits); }

  // A column as one number, by its places: in the same order.
  static std::uint64_t column_at(std::uint32_t x, std::uint32_t y) {
    return static_cast<std::uint64_t>(x) << kColumnBits | y;
  }
  static std::uint64_t column_of(std::uint64_t key) { return key >> kYShift; }
  static std::uint32_t x_of_column(std::uint64_t column) { return part(column, kColumnBits, kColumnBits); }
  static std::uint32_t y_of_column(std::uint64_t column) { return part(column, 0, kColumnBits); }
  // The least key of a column's cells from z on.
  static std::uint64_t least_of(std::uint64_t column, std::uint32_t z) {
    return column << kYShift | static_cast<std::uint64_t>(z) << kZShift;
  }

 private:
  static std::uint32_t part(std::uint64_t number, std::uint32_t shift, std::uint32_t bits) {
    return static_cast<std::uint32_t>(number >> shift) & ((1U << bits) - 1);
  }
};

}  // namespace pose_wall
