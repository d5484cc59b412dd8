// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/sim/network_segments.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::tools::sim {
namespace {

constexpr double kCell_m = 0.5;
constexpr double kMargin_m = 1.0;
// A ray through the common end of two walls must meet one of them.
constexpr double kEndSlack = 1e-9;
// More steps than any ray within a network needs; a ray that leaves the grid ends before.
constexpr int kStepsMax = 1 << 20;

double cross(const Place& a, const Place& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

SegmentGrid::SegmentGrid(std::vector<WallSegment> segments) : segments_(std::move(segments)) {
  Place high = Place::Zero();
  if (!segments_.empty()) low_ = high = segments_.front().a;
  for (const WallSegment& s : segments_) {
    low_ = low_.cwiseMin(s.a).cwiseMin(s.b);
    high = high.cwiseMax(s.a).cwiseMax(s.b);
  }
  low_ -= Place::Constant(kMargin_m);
  high += Place::Constant(kMargin_m);
  columns_ = static_cast<std::int64_t>(std::ceil((high.x() - low_.x()) / kCell_m)) + 1;
  rows_ = static_cast<std::int64_t>(std::ceil((high.y() - low_.y()) / kCell_m)) + 1;
  sort_into_cells();
  measure_empty_cells();
}

SegmentGrid::Cell SegmentGrid::cell_of(const Place& p) const {
  return {static_cast<std::int64_t>(std::floor((p.x() - low_.x()) / kCell_m)),
          static_cast<std::int64_t>(std::floor((p.y() - low_.y()) / kCell_m))};
}

bool SegmentGrid::is_inside(const Cell& cell) const {
  return cell.column >= 0 && cell.row >= 0 && cell.column < columns_ && cell.row < rows_;
}

std::size_t SegmentGrid::index_of(const Cell& cell) const {
  return static_cast<std::size_t>(cell.row * columns_ + cell.column);
}

void SegmentGrid::sort_into_cells() {
  begin_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  const auto each = [this](auto visit) {
    for (std::size_t i = 0; i < segments_.size(); ++i) {
      const Cell from = cell_of(segments_[i].a.cwiseMin(segments_[i].b) - Place::Constant(kEndSlack));
      const Cell to = cell_of(segments_[i].a.cwiseMax(segments_[i].b) + Place::Constant(kEndSlack));
      for (std::int64_t row = from.row; row <= to.row; ++row) {
        for (std::int64_t column = from.column; column <= to.column; ++column) {
          visit(static_cast<std::uint32_t>(i), index_of({column, row}));
        }
      }
    }
  };
  each([this](std::uint32_t, std::size_t cell) { ++begin_[cell + 1]; });
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  in_cells_.resize(begin_.back());
  std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
  each([this, &next](std::uint32_t segment, std::size_t cell) { in_cells_[next[cell]++] = segment; });
}

// Two passes over the cells give the distance in king's moves.
void SegmentGrid::measure_empty_cells() {
  constexpr std::uint8_t kMost = 255;
  empty_.assign(static_cast<std::size_t>(columns_ * rows_), kMost);
  const auto relax = [this](const Cell& cell, const Cell& neighbour) {
    if (!is_inside(neighbour)) return;
    const int through = std::min<int>(kMost, empty_[index_of(neighbour)] + 1);
    empty_[index_of(cell)] = static_cast<std::uint8_t>(std::min<int>(empty_[index_of(cell)], through));
  };
  for (std::size_t i = 0; i < empty_.size(); ++i) empty_[i] = begin_[i + 1] > begin_[i] ? 0 : kMost;
  for (std::int64_t row = 0; row < rows_; ++row) {
    for (std::int64_t column = 0; column < columns_; ++column) {
      for (std::int64_t side = -1; side <= 1; ++side) relax({column, row}, {column + side, row - 1});
      relax({column, row}, {column - 1, row});
    }
  }
  for (std::int64_t row = rows_ - 1; row >= 0; --row) {
    for (std::int64_t column = columns_ - 1; column >= 0; --column) {
      for (std::int64_t side = -1; side <= 1; ++side) relax({column, row}, {column + side, row + 1});
      relax({column, row}, {column + 1, row});
    }
  }
}

void SegmentGrid::meet(std::uint32_t segment, const Place& origin, const Place& direction, unsigned kinds,
                       PlaneHit* best) const {
  const WallSegment& wall = segments_[segment];
  if ((kinds >> static_cast<unsigned>(wall.kind) & 1U) == 0) return;
  const Place along = wall.b - wall.a;
  const double turn = cross(direction, along);
  if (turn == 0.0) return;
  const Place to = wall.a - origin;
  const double share = cross(to, direction) / turn;
  if (!(share >= -kEndSlack && share <= 1.0 + kEndSlack)) return;
  const double range_m = cross(to, along) / turn;
  if (!(range_m >= 0.0 && range_m < best->range_m)) return;
  // The free side is to the left: a ray that comes from there crosses to the right.
  *best = {range_m, segment, turn / along.norm()};
}

// Leaves the cell over the side that the ray reaches first, which is at the result.
double SegmentGrid::step(const Place& origin, const Place& direction, Cell* cell) const {
  const auto to_side = [](double from, double way, double low, std::int64_t place) {
    if (way == 0.0) return std::numeric_limits<double>::infinity();
    return (low + kCell_m * static_cast<double>(place + (way > 0.0 ? 1 : 0)) - from) / way;
  };
  const double x_m = to_side(origin.x(), direction.x(), low_.x(), cell->column);
  const double y_m = to_side(origin.y(), direction.y(), low_.y(), cell->row);
  if (x_m < y_m) {
    cell->column += direction.x() > 0.0 ? 1 : -1;
  } else {
    cell->row += direction.y() > 0.0 ? 1 : -1;
  }
  return std::min(x_m, y_m);
}

PlaneHit SegmentGrid::cast(const Place& origin, const Place& direction, double range_max_m, unsigned kinds) const {
  PlaneHit best;
  double t_m = 0.0;
  Cell cell = cell_of(origin);
  for (int i = 0; i < kStepsMax && is_inside(cell); ++i) {
    const std::size_t index = index_of(cell);
    if (empty_[index] > 1) {
      t_m += static_cast<double>(empty_[index] - 1) * kCell_m;
      cell = cell_of(origin + t_m * direction);
    } else {
      for (std::uint32_t k = begin_[index]; k < begin_[index + 1]; ++k) {
        meet(in_cells_[k], origin, direction, kinds, &best);
      }
      t_m = step(origin, direction, &cell);
    }
    if (best.range_m <= t_m || t_m > range_max_m) break;
  }
  if (!(best.range_m <= range_max_m)) return {};
  return best;
}

PlaneHit SegmentGrid::cast_slowly(const Place& origin, const Place& direction, double range_max_m) const {
  PlaneHit best;
  for (std::size_t i = 0; i < segments_.size(); ++i)
    meet(static_cast<std::uint32_t>(i), origin, direction, kAllWalls, &best);
  if (!(best.range_m <= range_max_m)) return {};
  return best;
}

double SegmentGrid::distance_m(const Place& p, double reach_m) const {
  double best_m = std::numeric_limits<double>::infinity();
  const Cell from = cell_of(p - Place::Constant(reach_m)), to = cell_of(p + Place::Constant(reach_m));
  for (std::int64_t row = std::max<std::int64_t>(0, from.row); row <= std::min(rows_ - 1, to.row); ++row) {
    for (std::int64_t column = std::max<std::int64_t>(0, from.column); column <= std::min(columns_ - 1, to.column);
         ++column) {
      const std::size_t index = index_of({column, row});
      for (std::uint32_t i = begin_[index]; i < begin_[index + 1]; ++i) {
        const WallSegment& wall = segments_[in_cells_[i]];
        const Place along = wall.b - wall.a;
        const double share = std::clamp((p - wall.a).dot(along) / std::max(along.squaredNorm(), 1e-18), 0.0, 1.0);
        best_m = std::min(best_m, (wall.a + share * along - p).norm());
      }
    }
  }
  return best_m <= reach_m ? best_m : std::numeric_limits<double>::infinity();
}

}  // namespace pose_wall::tools::sim
