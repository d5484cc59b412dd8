// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/route/bit_grid.hpp"

#include <cmath>
#include <cstring>

#include "base/math/finite.hpp"
#include "part/status.hpp"
#include "part/struct_sizes.hpp"
#include "place/pose2.hpp"

namespace pose_wall::planar::route {
namespace {

// Eight cells as eight bits, cell 0 lowest. As bytes unknown cells are 255, so one comparison sees to all.
std::uint64_t blocked_of_eight(const std::int8_t* cells, std::uint64_t lift) {
  std::uint64_t eight;
  std::memcpy(&eight, cells, sizeof(eight));
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  eight = __builtin_bswap64(eight);
#endif
  const std::uint64_t high = 0x8080808080808080ULL;
  const std::uint64_t blocked = ((((eight & ~high) + lift) | eight) & high) >> 7;
  return (blocked * 0x0102040810204080ULL) >> 56;
}

}  // namespace

std::int32_t check_grid(const pose_wall_planar_grid* grid) {
  if (grid == nullptr) return POSE_WALL_E_NULL;
  if (const std::int32_t size = pose_wall::check_struct(*grid); size != POSE_WALL_OK) return size;
  if (grid->cells == nullptr) return POSE_WALL_E_NULL;
  const bool fits = grid->width >= 1 && grid->width <= POSE_WALL_PLANAR_GRID_SIDE_MAX && grid->height >= 1 &&
                    grid->height <= POSE_WALL_PLANAR_GRID_SIDE_MAX && grid->resolution_m >= 0.01 &&
                    grid->resolution_m <= 1.0 && is_place(grid->origin_x_m, grid->origin_y_m) && grid->reserved == 0;
  return ok_if(fits, POSE_WALL_PLANAR_E_GRID);
}

void BitGrid::lay_out(Arena& arena, std::uint32_t width_max, std::uint32_t height_max) {
  words_ = arena.take<std::uint64_t>((width_max + 63) / 64 * height_max);
}

bool BitGrid::read(const pose_wall_planar_grid& grid, std::uint32_t occupied_from) {
  const std::uint32_t stride = (grid.width + 63) / 64;
  if (static_cast<std::uint64_t>(stride) * grid.height > words_.size()) return false;
  stride_ = stride;
  width_ = static_cast<std::int32_t>(grid.width);
  height_ = static_cast<std::int32_t>(grid.height);
  resolution_m_ = grid.resolution_m;
  origin_m_ = {grid.origin_x_m, grid.origin_y_m};
  const std::uint64_t lift = (0x80 - occupied_from) * 0x0101010101010101ULL;
  for (std::uint32_t row = 0; row < grid.height; ++row) {
    const std::int8_t* const cells = grid.cells + static_cast<std::size_t>(row) * grid.width;
    for (std::uint32_t word = 0; word < stride; ++word) {
      std::uint64_t bits = 0;
      const std::uint32_t begin = word * 64, end = grid.width - begin < 64 ? grid.width : begin + 64;
      std::uint32_t column = begin;
      for (; column + 8 <= end; column += 8) bits |= blocked_of_eight(cells + column, lift) << (column - begin);
      for (; column < end; ++column) {
        const std::uint64_t is_blocked = static_cast<std::uint8_t>(cells[column]) >= occupied_from ? 1 : 0;
        bits |= is_blocked << (column - begin);
      }
      words_[row * stride + word] = bits;
    }
  }
  return true;
}

void BitGrid::read_coarse(const BitGrid& of, std::int32_t step) {
  width_ = (of.width_ + step - 1) / step;
  height_ = (of.height_ + step - 1) / step;
  stride_ = (static_cast<std::uint32_t>(width_) + 63) / 64;
  resolution_m_ = of.resolution_m_ * step;
  origin_m_ = of.origin_m_;
  words_.first(stride_ * static_cast<std::uint32_t>(height_)).fill(0);
  for (std::int32_t row = 0; row < of.height_; ++row) {
    const std::uint64_t* const words = &of.words_[static_cast<std::uint32_t>(row) * of.stride_];
    for (std::int32_t column = 0; column < width_; ++column) {
      const std::int32_t first = column * step, last = first + step - 1;
      if (last >= of.width_) {
        block(row / step, column);
        continue;
      }
      const std::int32_t bit = first & 63;
      std::uint64_t bits = words[first >> 6] >> bit;
      if (bit + step > 64) bits |= words[last >> 6] << (64 - bit);
      if ((bits & (~0ULL >> (64 - step))) != 0) block(row / step, column);
    }
  }
  for (std::int32_t column = 0; of.height_ % step != 0 && column < width_; ++column) block(height_ - 1, column);
}

// In cells along a row, from the corner's column to the nearest blocked cell; most if there is none nearer.
double BitGrid::in_row(std::int32_t column, std::int32_t row, std::int32_t most) const {
  const std::int32_t left = column - most > 0 ? column - most : 0;
  const std::int32_t right = column + most < width_ ? column + most : width_;
  if (column > left && !is_any_blocked(row, left, column - 1) && column < right &&
      !is_any_blocked(row, column, right - 1)) {
    return most;
  }
  for (std::int32_t k = 0; k < most; ++k) {
    const std::int32_t before = column - 1 - k, behind = column + k;
    if (before < 0 || behind >= width_ || is_blocked(row, before) || is_blocked(row, behind)) return k;
  }
  return most;
}

double BitGrid::clearance(std::int32_t column, std::int32_t row, std::int32_t most) const {
  double best_squared = static_cast<double>(most) * most;
  const std::int32_t edges[] = {column, row, width_ - column, height_ - row};
  for (const std::int32_t edge : edges) {
    if (edge <= 0) return 0.0;
    const double squared = static_cast<double>(edge) * edge;
    if (squared < best_squared) best_squared = squared;
  }
  for (std::int32_t k = 0; k < most && static_cast<double>(k) * k < best_squared; ++k) {
    const double up = static_cast<double>(k) * k;
    const auto reach = static_cast<std::int32_t>(std::sqrt(best_squared - up)) + 1;
    for (const std::int32_t at : {row + k, row - 1 - k}) {
      if (at < 0 || at >= height_) continue;
      const double across = in_row(column, at, reach);
      const double squared = across * across + up;
      if (across < reach && squared < best_squared) best_squared = squared;
    }
  }
  return std::sqrt(best_squared);
}

}  // namespace pose_wall::planar::route
