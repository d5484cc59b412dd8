// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The cell of a voxel as one number.
//
// From the highest bit on: the place of an upright column of 4 x 4 cells along x and y, z, and x and y within the
// column. In this order neighbours in space are usually neighbours in the list. The cells within a distance of one lie
// in a few runs of the list, one for each column around.

#pragma once

#include <cstdint>
#include <cstring>

#include "base/simd/four_floats.hpp"

namespace pose_wall {

struct VoxelKey {
  // Cells are counted from the far corner: below 2^21 along each axis. Columns of 4 x 4 cells left 6 % of the voxels
  // without neighbours next to them in the list, single cells 28 % (bench/README.md). From z up the parts of a key
  // follow each other, 63 bits in all:
  static constexpr std::uint32_t kInColumnBits = 2;
  static constexpr std::uint32_t kColumnCells = 1U << kInColumnBits;
  static constexpr std::uint32_t kColumnBits = 19;
  static constexpr std::uint32_t kZBits = kColumnBits + kInColumnBits;
  static constexpr std::uint32_t kZShift = 2 * kInColumnBits;
  static constexpr std::uint32_t kYShift = kZShift + kZBits;
  static constexpr std::uint32_t kXShift = kYShift + kColumnBits;

  // Of four cells at once, and back.
  struct FourCells {
    FourInts x, y, z;
  };
  static void of_four(const FourCells& cells, std::uint64_t* keys) {
    const auto x = reinterpret_cast<FourWords>(cells.x), y = reinterpret_cast<FourWords>(cells.y);
    const auto z = reinterpret_cast<FourWords>(cells.z);
    const FourWords x_column = x >> kInColumnBits, y_column = y >> kInColumnBits;
    const FourWords high = (x_column << (kXShift - kHalf)) | (y_column >> (kHalf - kYShift));
    const FourWords low = (y_column << kYShift) | (z << kZShift) | ((x & kInColumn) << kInColumnBits) | (y & kInColumn);
    const FourLongs whole = __builtin_convertvector(high, FourLongs) << kHalf | __builtin_convertvector(low, FourLongs);
    std::memcpy(keys, &whole, sizeof(whole));
  }
  static FourCells cells_of(const std::uint64_t* keys) {
    FourLongs whole;
    std::memcpy(&whole, keys, sizeof(whole));
    const FourWords high = __builtin_convertvector(whole >> kHalf, FourWords),
                    low = __builtin_convertvector(whole, FourWords);
    const FourWords x_column = high >> (kXShift - kHalf);
    const FourWords y_column = (high << (kHalf - kYShift) | low >> kYShift) & ((1U << kColumnBits) - 1);
    const FourWords x = x_column << kInColumnBits | ((low >> kInColumnBits) & kInColumn);
    const FourWords y = y_column << kInColumnBits | (low & kInColumn), z = low >> kZShift & ((1U << kZBits) - 1);
    return {reinterpret_cast<FourInts>(x), reinterpret_cast<FourInts>(y), reinterpret_cast<FourInts>(z)};
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
  static constexpr std::uint32_t kInColumn = kColumnCells - 1;  // masks a cell's place within its column
  static constexpr std::uint32_t kHalf = 32;                    // bits of a lane, half of a key
  static_assert(kXShift >= kHalf && kYShift < kHalf && kYShift + kColumnBits > kHalf, "y lies across the halves");
  using FourLongs = std::uint64_t __attribute__((vector_size(32)));

  static std::uint32_t part(std::uint64_t number, std::uint32_t shift, std::uint32_t bits) {
    return static_cast<std::uint32_t>(number >> shift) & ((1U << bits) - 1);
  }
};

}  // namespace pose_wall
