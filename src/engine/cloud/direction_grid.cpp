// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/cloud/direction_grid.hpp"

namespace pose_wall {
namespace {

// On the square |x| + |y| = 1.
struct Corner {
  double x, y;
  double length2() const { return x * x + y * y; }
};

Corner middle_of(std::uint32_t column) {
  const double way = (column + 0.5) * (4.0 / Directions::kColumns);
  const double x = way < 2.0 ? 1.0 - way : way - 3.0;
  const double y = way < 1.0 ? way : (way < 3.0 ? 2.0 - way : way - 4.0);
  return {x, y};
}

// A border moves for a gap of a quarter of what lies beside it now: rings or none, and not the scatter of a sensor
// whose returns come from everywhere.
constexpr std::uint32_t kGapFactor = 4;

// Returns beside a border of two slices that would part them from their own ring: a ring ends where one side is empty.
std::uint32_t parted_at(const std::uint32_t (&returns)[Directions::kSlices], std::uint32_t border) {
  const std::uint32_t below = returns[border - 1], above = returns[border];
  return below < above ? below : above;
}

}  // namespace

Directions::Column Directions::column(std::uint32_t column) {
  const Corner middle = middle_of(column);
  const double length2 = middle.length2(), scale = 1.0 / std::sqrt(length2);
  return {middle.x * scale, middle.y * scale, 1.0 / length2};
}

double Directions::width(std::uint32_t column) {
  return 1.0 / middle_of(column).length2();
}

DirectionRows::DirectionRows() {
  for (std::uint32_t row = 0; row <= DirectionGrid::kRows; ++row) first_slice_[row] = row * kSlicesPerRow;
  const std::uint32_t none[Directions::kSlices] = {};
  set_rows(none);
}

void DirectionRows::learn(const DirectionSlices& returns_lidar) {
  std::uint32_t returns[Directions::kSlices];
  for (std::uint32_t slice = 0; slice < Directions::kSlices; ++slice) {
    const std::uint16_t* const of_slice = returns_lidar.row(slice);
    returns[slice] = 0;
    for (std::uint32_t column = 0; column < Directions::kColumns; ++column) returns[slice] += of_slice[column];
  }
  first_slice_[0] = 0;
  first_slice_[DirectionGrid::kRows] = Directions::kSlices;
  for (std::uint32_t row = 1; row < DirectionGrid::kRows; ++row) {
    const std::uint32_t even = row * kSlicesPerRow;
    std::uint32_t best = even;
    // Half a row down, and nearly half a row up: there the next row's borders begin.
    for (std::uint32_t border = even - kSlicesPerRow / 2; border < even + kSlicesPerRow / 2; ++border) {
      const std::uint32_t parted = parted_at(returns, border), least = parted_at(returns, best);
      const std::uint32_t away = border < even ? even - border : border - even;
      const std::uint32_t best_away = best < even ? even - best : best - even;
      if (parted < least || (parted == least && away < best_away)) best = border;
    }
    const bool is_gap = kGapFactor * parted_at(returns, best) < parted_at(returns, even);
    first_slice_[row] = is_gap ? best : even;
  }
  set_rows(returns);
}

void DirectionRows::set_rows(const std::uint32_t (&returns)[Directions::kSlices]) {
  for (std::uint32_t row = 0; row < DirectionGrid::kRows; ++row) {
    std::uint64_t all = 0, weighted = 0;
    for (std::uint32_t slice = first_slice_[row]; slice < first_slice_[row + 1]; ++slice) {
      row_of_[slice] = static_cast<std::uint8_t>(row);
      all += returns[slice];
      weighted += std::uint64_t{returns[slice]} * slice;
    }
    const double middle = 0.5 * (first_slice_[row] + (first_slice_[row + 1] - 1));
    up_[row] = Directions::up(all > 0 ? static_cast<double>(weighted) / static_cast<double>(all) : middle);
  }
}

void DirectionRows::sum_up(const DirectionSlices& slices, DirectionGrid* rows) const {
  rows->clear();
  for (std::uint32_t row = 0; row < DirectionGrid::kRows; ++row) {
    std::uint32_t sums[Directions::kColumns] = {};
    for (std::uint32_t slice = first_slice_[row]; slice < first_slice_[row + 1]; ++slice) {
      const std::uint16_t* const of_slice = slices.row(slice);
      for (std::uint32_t column = 0; column < Directions::kColumns; ++column) sums[column] += of_slice[column];
    }
    for (std::uint32_t column = 0; column < Directions::kColumns; ++column) {
      rows->add(row * Directions::kColumns + column, sums[column]);
    }
  }
}

}  // namespace pose_wall
