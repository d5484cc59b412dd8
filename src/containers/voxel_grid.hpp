// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "containers/arena.hpp"
#include "containers/point_set.hpp"
#include "containers/radix_sort.hpp"
#include "containers/voxel_hash.hpp"

namespace pose_wall {

// Weights are whole sixteenths, so that sums do not depend on the order of points.
constexpr std::uint32_t kWeightOne = 16;

// Weighted centroids of the points in each cell of a grid. Coordinates are summed as whole steps of 2^-14 m within
// their cell: the centroids are the same bits whatever the order of the points, and exact to 0.03 mm.
class VoxelGrid {
 public:
  void lay_out(Arena& arena, std::uint32_t capacity);
  void reset() { hash_.reset(); }

  // Starts a new grid; leaf from 0.01 m to 100 m.
  void begin(double leaf_m);

  // False where the point needs a new cell and there is no room: the grid is then of no use. |x|, |y|, |z| < 500 m.
  bool add(double x_m, double y_m, double z_m, std::uint32_t weight_sixteenths);

  // Writes the centroids in the order of their cells (x, then y, then z). out must have room for count().
  void extract(PointSet* out);

  std::uint32_t count() const { return hash_.count(); }
  // Of all cells and their sums, after extract(): equal clouds give equal numbers, others different ones.
  std::uint64_t fingerprint() const { return fingerprint_; }

 private:
  struct Sums {
    std::uint64_t x, y, z;  // weighted steps within the cell
    std::uint64_t weight;
  };
  struct Cell {
    std::int32_t index;
    std::uint32_t offset_steps;
  };

  Cell cell_of(double coordinate_m) const;
  double centroid(std::uint64_t sum, std::uint64_t weight, std::int32_t cell) const;

  VoxelHash hash_;
  Span<Sums> sums_;
  Span<KeyedIndex> order_, spare_;
  Span<std::uint32_t> histogram_;
  std::int32_t leaf_steps_ = 1;
  double cells_per_step_ = 1.0;
  std::uint64_t fingerprint_ = 0;
};

}  // namespace pose_wall
