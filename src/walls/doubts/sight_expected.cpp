// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "walls/doubts/sight_expected.hpp"

#include <algorithm>

namespace pose_wall {
namespace {

constexpr std::uint32_t kRows = DirectionGrid::kRows;
constexpr std::uint32_t kColumns = DirectionGrid::kColumns;
// Half of the directions may be dark, or blocked, or hidden.
constexpr double kExpectedRank = 0.75;
constexpr std::uint32_t kSeenMin = kColumns / 8;
constexpr double kEmptyShare = 0.05;
constexpr std::uint32_t kBlockedColumns = 5;  // 14 degrees
constexpr int kSectorsForgiven = 2;

struct Sector {
  std::uint32_t from = 0, columns = 0;
};

// The widest run of empty columns, around the circle.
Sector widest_sector(const bool (&empty)[kColumns]) {
  Sector widest;
  for (std::uint32_t from = 0; from < kColumns; ++from) {
    if (!empty[from] || (empty[(from + kColumns - 1) % kColumns] && from > 0)) continue;
    Sector here{from, 0};
    while (here.columns < kColumns && empty[(from + here.columns) % kColumns]) ++here.columns;
    if (here.columns > widest.columns) widest = here;
  }
  return widest;
}

}  // namespace

void ExpectedReturns::look_at(const DirectionGrid& returns_lidar) {
  for (std::uint32_t column = 0; column < kColumns; ++column) width_[column] = DirectionGrid::width(column);
  for (std::uint32_t row = 0; row < kRows; ++row) {
    double counts[kColumns];
    std::uint32_t seen = 0;
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const std::uint32_t count = returns_lidar.count(row, column);
      if (count > 0) counts[seen++] = count / width_[column];
    }
    per_width_[row] = 0.0;
    if (seen < kSeenMin) continue;
    double* const rank = counts + static_cast<std::uint32_t>(kExpectedRank * seen);
    std::nth_element(counts, rank, counts + seen);
    per_width_[row] = *rank;
  }
}

void SeenColumns::look_at(const DirectionGrid& returns_lidar, const ExpectedReturns& expected) {
  bool empty[kColumns];
  for (std::uint32_t c = 0; c < kColumns; ++c) {
    double count = 0.0, all = 0.0;
    for (std::uint32_t row = 0; row < kRows; ++row) {
      count += returns_lidar.count(row, c);
      all += expected.at(row, c);
    }
    empty[c] = !(count > kEmptyShare * all);
  }
  for (bool& seen : is_seen) seen = true;
  for (int forgiven = 0; forgiven < kSectorsForgiven; ++forgiven) {
    const Sector sector = widest_sector(empty);
    for (std::uint32_t k = 0; k < sector.columns; ++k) {
      const std::uint32_t c = (sector.from + k) % kColumns;
      empty[c] = false;
      is_seen[c] = sector.columns < kBlockedColumns;
    }
  }
}

}  // namespace pose_wall
