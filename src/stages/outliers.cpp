// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/outliers.hpp"

namespace pose_wall {
namespace {

class NeighbourCounter {
 public:
  NeighbourCounter(const PointSet& points, const CellIndex& cells, double radius_m, std::uint32_t needed)
      : points_(points), cells_(cells), radius2_(static_cast<float>(radius_m * radius_m)), needed_(needed) {}

  // Most points have their neighbours in their own cell, so that one goes first; counting stops at the needed number.
  bool has_enough(std::uint32_t i) const {
    const std::int32_t cx = cells_.cell(points_.x[i]), cy = cells_.cell(points_.y[i]), cz = cells_.cell(points_.z[i]);
    std::uint32_t found = 0;
    if (count_in(cells_.points_in(cx, cy, cz), i, &found)) return true;
    for (std::int32_t dx = -1; dx <= 1; ++dx) {
      for (std::int32_t dy = -1; dy <= 1; ++dy) {
        for (std::int32_t dz = -1; dz <= 1; ++dz) {
          if (dx == 0 && dy == 0 && dz == 0) continue;
          if (count_in(cells_.points_in(cx + dx, cy + dy, cz + dz), i, &found)) return true;
        }
      }
    }
    return false;
  }

 private:
  bool count_in(Span<const std::uint32_t> members, std::uint32_t i, std::uint32_t* found) const {
    for (const std::uint32_t j : members) {
      const float dx = points_.x[j] - points_.x[i], dy = points_.y[j] - points_.y[i], dz = points_.z[j] - points_.z[i];
      if (j != i && dx * dx + dy * dy + dz * dz <= radius2_ && ++*found >= needed_) return true;
    }
    return false;
  }

  const PointSet& points_;
  const CellIndex& cells_;
  float radius2_;
  std::uint32_t needed_;
};

}  // namespace

std::uint32_t remove_outliers(const Settings& settings, double leaf_m, CellIndex* cells, Span<std::uint8_t> keep,
                              PointSet* points) {
  if (settings.outlier_min_neighbors == 0) return 0;
  const double radius_m = settings.outlier_radius > 2.0 * leaf_m ? settings.outlier_radius : 2.0 * leaf_m;
  cells->build(*points, radius_m);
  const NeighbourCounter counter(*points, *cells, radius_m, settings.outlier_min_neighbors);
  for (std::uint32_t i = 0; i < points->count; ++i) keep[i] = counter.has_enough(i) ? 1 : 0;
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < points->count; ++i) {
    if (keep[i] != 0) points->copy(kept++, i);
  }
  const std::uint32_t removed = points->count - kept;
  points->count = kept;
  return removed;
}

}  // namespace pose_wall
