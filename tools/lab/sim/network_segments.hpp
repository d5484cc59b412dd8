// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Very many short walls in the plane, found by rays: a grid of cells with the walls in each, and for each cell how far
// around it is empty.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "lab/sim/network_noise.hpp"

namespace pose_wall::tools::sim {

// What a wall of the plane belongs to.
enum class WallKind : std::uint8_t { kRock, kSteel, kProp };
// Which of them a ray can meet: the bit of each kind.
inline constexpr unsigned kRockOnly = 1U;
inline constexpr unsigned kThingsOnly = 6U;
inline constexpr unsigned kAllWalls = 7U;

// From a to b, the free space to its left.
struct WallSegment {
  Place a, b;
  WallKind kind = WallKind::kRock;
};

struct PlaneHit {
  double range_m = std::numeric_limits<double>::infinity();
  std::uint32_t segment = 0;  // only with a finite range
  double cosine = 0.0;        // of the incidence: above 0 from the free side
};

class SegmentGrid {
 public:
  explicit SegmentGrid(std::vector<WallSegment> segments);

  // The first wall up to range_max_m; `direction` has the length 1.
  PlaneHit cast(const Place& origin, const Place& direction, double range_max_m, unsigned kinds = kAllWalls) const;
  // The same, by trying all of them.
  PlaneHit cast_slowly(const Place& origin, const Place& direction, double range_max_m) const;
  // To the nearest wall, infinity beyond reach_m.
  double distance_m(const Place& p, double reach_m) const;

  const std::vector<WallSegment>& segments() const { return segments_; }

 private:
  struct Cell {
    std::int64_t column, row;
  };
  Cell cell_of(const Place& p) const;
  bool is_inside(const Cell& cell) const;
  std::size_t index_of(const Cell& cell) const;
  double step(const Place& origin, const Place& direction, Cell* cell) const;
  void sort_into_cells();
  void measure_empty_cells();
  void meet(std::uint32_t segment, const Place& origin, const Place& direction, unsigned kinds, PlaneHit* best) const;

  std::vector<WallSegment> segments_;
  Place low_ = Place::Zero();
  std::int64_t columns_ = 1, rows_ = 1;
  std::vector<std::uint32_t> begin_;  // of each cell's part of in_cells_
  std::vector<std::uint32_t> in_cells_;
  std::vector<std::uint8_t> empty_;  // 0: has walls; n: no cell within n - 1 has
};

}  // namespace pose_wall::tools::sim
