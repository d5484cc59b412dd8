// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "containers/cell_index.hpp"

namespace pose_wall {

void CellIndex::lay_out(Arena& arena, std::uint32_t capacity) {
  hash_.lay_out(arena, capacity);
  start_ = arena.take<std::uint32_t>(capacity + 1);
  cell_of_ = arena.take<std::uint32_t>(capacity);
  members_ = arena.take<std::uint32_t>(capacity);
}

void CellIndex::build(const PointSet& points, double edge_m) {
  cells_per_metre_ = static_cast<float>(1.0 / edge_m);
  hash_.clear();
  start_.fill(0);
  // Count, sum up, place: start_[c] holds the end of cell c while counting, its start after placing from the back.
  for (std::uint32_t i = 0; i < points.count; ++i) {
    cell_of_[i] = hash_.insert(cell_key(cell(points.x[i]), cell(points.y[i]), cell(points.z[i])));
    ++start_[cell_of_[i]];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t c = 0; c < hash_.count(); ++c) {
    sum += start_[c];
    start_[c] = sum;
  }
  start_[hash_.count()] = sum;
  for (std::uint32_t i = points.count; i-- > 0;) members_[--start_[cell_of_[i]]] = i;
}

Span<const std::uint32_t> CellIndex::points_in(std::int32_t x, std::int32_t y, std::int32_t z) const {
  const std::uint32_t c = hash_.find(cell_key(x, y, z));
  return c == VoxelHash::kFull ? Span<const std::uint32_t>() : members_of(c);
}

}  // namespace pose_wall
