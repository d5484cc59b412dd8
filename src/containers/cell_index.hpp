// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "containers/arena.hpp"
#include "containers/point_set.hpp"
#include "containers/voxel_hash.hpp"

namespace pose_wall {

// Points sorted into cubic cells, for "who is near": the points within one cell edge of a point lie in its own and the
// 26 cells around.
class CellIndex {
 public:
  void lay_out(Arena& arena, std::uint32_t capacity);

  void build(const PointSet& points, double edge_m);

  // The cell that holds a coordinate.
  std::int32_t cell(float coordinate_m) const {
    const float place = coordinate_m * cells_per_metre_;
    const auto cut = static_cast<std::int32_t>(place);
    return place < static_cast<float>(cut) ? cut - 1 : cut;
  }
  // Of the points in the cell of one of them, itself among them.
  Span<const std::uint32_t> points_beside(std::uint32_t point) const { return members_of(cell_of_[point]); }
  // Indices of the points in a cell; empty where there are none.
  Span<const std::uint32_t> points_in(std::int32_t x, std::int32_t y, std::int32_t z) const;

 private:
  Span<const std::uint32_t> members_of(std::uint32_t cell) const {
    return Span<const std::uint32_t>(members_.data() + start_[cell], start_[cell + 1] - start_[cell]);
  }

  VoxelHash hash_;
  Span<std::uint32_t> start_;    // of each cell in members_, and the end of the last
  Span<std::uint32_t> cell_of_;  // per point
  Span<std::uint32_t> members_;
  float cells_per_metre_ = 1.0F;
};

}  // namespace pose_wall
