// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The cell of a normal-distributions transform (Biber and Strasser, IROS 2003): sums of its points, and the surface
// that they make with those of the cells around. Where cells are kept is the matter of the maps that hold them: a
// window, or tiles. They lend a slot to each cell, which holds the number of the surface nearest to it.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/math/principal_axes.hpp"

namespace pose_wall::planar {

constexpr double kSurfaceCell_m = 0.1;   // finer than relief of rock is long, coarser than a sensor's noise
constexpr std::int32_t kSightCells = 4;  // across what lines of sight mark: walking along them costs more than points
constexpr double kSight_m = kSurfaceCell_m * kSightCells;  // the same in metres

struct Surface {
  float x_m, y_m;             // mean, from the map's middle
  float normal_x, normal_y;   // unit: the direction of least spread
  float across_m2, along_m2;  // variances along the normal and along the surface
};

// Sums of the points of a cell about its middle.
struct SurfaceCell {
  float x_m, y_m, xx_m2, xy_m2, yy_m2;
  std::uint32_t count;
  std::int32_t column, row;

  void add(float x, float y) {
    x_m += x;
    y_m += y;
    xx_m2 += x * x;
    xy_m2 += x * y;
    yy_m2 += y * y;
    ++count;
  }
};

// Of the points of neighbouring cells, about the middle of one of them.
struct SurfaceSums {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;

  // A cell whose middle lies at (dx, dy).
  void add(const SurfaceCell& cell, double dx, double dy);
  // middle_x, middle_y: where the sums are about.
  Surface surface(double middle_x, double middle_y) const;
};

// Calls mark() along a line of sight, a step for each cell of kSight_m.
template <typename Mark>
void walk_sight(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m, Mark mark) {
  const Eigen::Vector2d way = to_m - from_m;
  const auto steps = static_cast<std::int32_t>(way.lpNorm<Eigen::Infinity>() / kSight_m) + 1;
  for (std::int32_t k = 0; k <= steps; ++k) mark(from_m + way * (static_cast<double>(k) / steps));
}

// The cells of a square of kSide cells a side, and their surfaces. Places are given from the square's middle. Within
// kMargin cells of its edge there are none, so that what spreads from a cell stays inside.
template <std::int32_t kSide, std::int32_t kMargin, typename Slot>
class SurfaceCells {
 public:
  // The slot of a cell without a surface near it. NOLINTNEXTLINE(bugprone-dynamic-static-initializers): constexpr
  static constexpr Slot kNone = static_cast<Slot>(-1);

  static bool holds(double x_m, double y_m) {
    constexpr double kMost_m = kSurfaceCell_m * (kSide / 2 - kMargin);  // by the definition of the margin
    return x_m > -kMost_m && x_m < kMost_m && y_m > -kMost_m && y_m < kMost_m;
  }
  // Of a place that the square holds, so that the sum is above 0 and the cast rounds down.
  static std::int32_t cell_of(double place_m) {
    return static_cast<std::int32_t>(place_m * (1.0 / kSurfaceCell_m) + kSide / 2);
  }
  static double middle_of(std::int32_t cell) { return (cell - kSide / 2 + 0.5) * kSurfaceCell_m; }

  void lay_out(Arena& arena, std::uint32_t most) {
    cells_ = arena.take<SurfaceCell>(most);
    surfaces_ = arena.take<Surface>(most);
  }
  void clear() { used_ = 0; }
  std::uint32_t used() const { return used_; }
  const SurfaceCell& cell(std::uint32_t k) const { return cells_[k]; }
  const Surface* surface(Slot k) const { return k != kNone ? &surfaces_[k] : nullptr; }
  bool is_of(Slot k, std::int32_t column, std::int32_t row) const {
    return k != kNone && cells_[k].column == column && cells_[k].row == row;
  }

  // A point at p, in the cell whose slot this is. False where cells ran out.
  bool put(const Eigen::Vector2d& p, std::int32_t column, std::int32_t row, Slot* slot) {
    if (*slot == kNone) {
      if (used_ == cells_.size()) return false;
      cells_[used_] = {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0, column, row};
      *slot = static_cast<Slot>(used_++);
    }
    cells_[*slot].add(static_cast<float>(p.x() - middle_of(column)), static_cast<float>(p.y() - middle_of(row)));
    return true;
  }

  // After the last point. slot_at(column, row) is the slot of a cell, or nullptr.
  template <typename SlotAt>
  void make_surfaces(SlotAt slot_at) {
    for (std::uint32_t k = 0; k < used_; ++k) {
      const SurfaceCell& own = cells_[k];
      SurfaceSums sums;
      for (std::int32_t row = own.row - 1; row <= own.row + 1; ++row) {
        for (std::int32_t column = own.column - 1; column <= own.column + 1; ++column) {
          const Slot* const slot = slot_at(column, row);
          if (slot == nullptr || *slot == kNone) continue;
          sums.add(cells_[*slot], (column - own.column) * kSurfaceCell_m, (row - own.row) * kSurfaceCell_m);
        }
      }
      surfaces_[k] = sums.surface(middle_of(own.column), middle_of(own.row));
    }
  }

  // Slots of cells that are nearer than `reach` cells to surface k find it, if none is nearer. Cells that hold points
  // keep their own.
  template <typename SlotAt>
  void spread(std::uint32_t k, std::int32_t reach, SlotAt slot_at) {
    const SurfaceCell own = cells_[k];
    for (std::int32_t row = own.row - reach; row <= own.row + reach; ++row) {
      for (std::int32_t column = own.column - reach; column <= own.column + reach; ++column) {
        Slot* const slot = slot_at(column, row);
        if (slot == nullptr || is_of(*slot, column, row)) continue;
        const double apart_m2 = apart2_m2(column, row, surfaces_[k]);
        if (apart_m2 > reach * reach * kSurfaceCell_m * kSurfaceCell_m) continue;
        if (*slot == kNone || apart_m2 < apart2_m2(column, row, surfaces_[*slot])) *slot = static_cast<Slot>(k);
      }
    }
  }

 private:
  static double apart2_m2(std::int32_t column, std::int32_t row, const Surface& surface) {
    const double dx = middle_of(column) - static_cast<double>(surface.x_m);
    const double dy = middle_of(row) - static_cast<double>(surface.y_m);
    return dx * dx + dy * dy;
  }

  Span<SurfaceCell> cells_;
  Span<Surface> surfaces_;
  std::uint32_t used_ = 0;
};

}  // namespace pose_wall::planar
