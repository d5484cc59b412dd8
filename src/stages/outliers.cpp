// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/outliers.hpp"

#include "math/four_floats.hpp"

namespace pose_wall {
namespace {

// The cells around one, the nearest first.
struct Offset {
  std::int32_t x, y, z;
};
struct Offsets {
  static constexpr std::uint32_t kCells = 26;
  Offset item[kCells] = {};

  constexpr Offsets() {
    std::uint32_t count = 0;
    for (int steps = 1; steps <= 3; ++steps) {
      for (std::int32_t x = -1; x <= 1; ++x) {
        for (std::int32_t y = -1; y <= 1; ++y) {
          for (std::int32_t z = -1; z <= 1; ++z) {
            if (x * x + y * y + z * z == steps) item[count++] = {x, y, z};
          }
        }
      }
    }
  }
};

class NeighbourCounter {
 public:
  NeighbourCounter(const PointSet& points, const CellIndex& cells, double radius_m, std::uint32_t needed)
      : points_(points), cells_(cells), radius2_(static_cast<float>(radius_m * radius_m)), needed_(needed) {}

  // Voxels come in the order of their cells, and on a surface those next to each other in the list are next to each
  // other: most points are done with that. What this does not find, has_enough() may. Of the four points from i on;
  // near either end of the list nothing is found.
  FourTruths have_enough_in_list(std::uint32_t i) const {
    if (i < kLook || i + kFour + kLook > points_.count) return FourTruths{};
    const FourFloats x = load_four(&points_.x[i]), y = load_four(&points_.y[i]), z = load_four(&points_.z[i]);
    FourInts found{};  // true is -1
    const auto look = [&](std::uint32_t j) {
      const FourFloats dx = load_four(&points_.x[j]) - x, dy = load_four(&points_.y[j]) - y;
      const FourFloats dz = load_four(&points_.z[j]) - z;
      found -= dx * dx + dy * dy + dz * dz <= radius2_;
    };
    for (std::uint32_t away = 1; away <= kLook; ++away) {
      look(i - away);
      look(i + away);
    }
    return found >= static_cast<std::int32_t>(needed_);
  }

  // The point's own cell goes first, then those that share a face with it; counting stops at the needed number.
  bool has_enough(std::uint32_t i) const {
    static constexpr Offsets kOffsets;
    std::uint32_t found = 0;
    if (count_in(cells_.points_beside(i), i, &found)) return true;
    const std::int32_t cx = cells_.cell(points_.x[i]), cy = cells_.cell(points_.y[i]), cz = cells_.cell(points_.z[i]);
    for (const Offset& o : kOffsets.item) {
      if (count_in(cells_.points_in(cx + o.x, cy + o.y, cz + o.z), i, &found)) return true;
    }
    return false;
  }

 private:
  static constexpr std::uint32_t kLook = 3;

  bool is_near(std::uint32_t i, std::uint32_t j) const {
    const float dx = points_.x[j] - points_.x[i], dy = points_.y[j] - points_.y[i], dz = points_.z[j] - points_.z[i];
    return dx * dx + dy * dy + dz * dz <= radius2_;
  }

  bool count_in(Span<const std::uint32_t> members, std::uint32_t i, std::uint32_t* found) const {
    for (const std::uint32_t j : members) {
      if (j != i && is_near(i, j) && ++*found >= needed_) return true;
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
  for (std::uint32_t i = 0; i < points->count; i += kFour) {
    const FourTruths enough = counter.have_enough_in_list(i);
    const std::uint32_t end = i + kFour < points->count ? i + kFour : points->count;
    for (std::uint32_t k = i; k < end; ++k) keep[k] = enough[k - i] != 0 || counter.has_enough(k) ? 1 : 0;
  }
  std::uint32_t kept = 0;
  while (kept < points->count && keep[kept] != 0) ++kept;
  for (std::uint32_t i = kept; i < points->count; ++i) {
    if (keep[i] != 0) points->copy(kept++, i);
  }
  const std::uint32_t removed = points->count - kept;
  points->count = kept;
  return removed;
}

}  // namespace pose_wall
