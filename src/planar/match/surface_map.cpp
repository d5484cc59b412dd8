// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/match/surface_map.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::planar {
namespace {

constexpr std::int32_t kReach = 2;  // cells about a surface that find it, and that are likely
constexpr std::uint32_t kCellCount = static_cast<std::uint32_t>(SurfaceMap::kSide * SurfaceMap::kSide);

std::uint32_t at(std::int32_t column, std::int32_t row) {
  return static_cast<std::uint32_t>(row * SurfaceMap::kSide + column);
}

bool is_inside(std::int32_t column, std::int32_t row) {
  return column >= 0 && column < SurfaceMap::kSide && row >= 0 && row < SurfaceMap::kSide;
}

constexpr std::int32_t kSeenSide = SurfaceMap::kSide / SurfaceMap::kShrink;
constexpr double kSeenCell_m = SurfaceMap::kCell_m * SurfaceMap::kShrink;

// The column or row of a place from the window's middle.
std::int32_t cell_of(double place_m) {
  return static_cast<std::int32_t>(std::floor(place_m / SurfaceMap::kCell_m)) + SurfaceMap::kSide / 2;
}

double middle_of(std::int32_t cell) {
  return (cell - SurfaceMap::kSide / 2 + 0.5) * SurfaceMap::kCell_m;
}

}  // namespace

void SurfaceMap::lay_out(Arena& arena) {
  index_ = arena.take<std::uint16_t>(kCellCount);
  nearest_ = arena.take<std::uint16_t>(kCellCount);
  std::uint32_t count = kCellCount;
  for (Span<std::uint8_t>& field : field_) {
    field = arena.take<std::uint8_t>(count);
    count /= static_cast<std::uint32_t>(kShrink * kShrink);
  }
  seen_ = arena.take<std::uint8_t>(static_cast<std::uint32_t>(kSeenSide * kSeenSide));
  cells_ = arena.take<Cell>(kCellsMost);
  surfaces_ = arena.take<Surface>(kCellsMost);
}

void SurfaceMap::open() {
  index_.fill(kNone);
  nearest_.fill(kNone);
  for (const Span<std::uint8_t>& field : field_) field.fill(0);
  seen_.fill(0);
  used_ = 0;
}

// Only what was written is cleared: a window is mostly empty.
void SurfaceMap::begin(const Eigen::Vector2d& middle_m) {
  for (std::uint32_t k = 0; k < used_; ++k) {
    const Cell& cell = cells_[k];
    index_[at(cell.column, cell.row)] = kNone;
    for (std::int32_t row = cell.row - kReach; row <= cell.row + kReach; ++row) {
      for (std::int32_t column = cell.column - kReach; column <= cell.column + kReach; ++column) {
        if (!is_inside(column, row)) continue;
        nearest_[at(column, row)] = kNone;
        field_[0][at(column, row)] = 0;
      }
    }
  }
  if (used_ > 0) {
    field_[1].fill(0);
    seen_.fill(0);
    field_[2].fill(0);
  }
  used_ = 0;
  middle_m_ = middle_m;
}

SurfaceMap::Cell* SurfaceMap::cell_at(std::int32_t column, std::int32_t row) {
  std::uint16_t& index = index_[at(column, row)];
  if (index != kNone) return &cells_[index];
  if (used_ == cells_.size()) return nullptr;
  index = static_cast<std::uint16_t>(used_);
  cells_[used_] = {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0, column, row};
  return &cells_[used_++];
}

void SurfaceMap::add(Span<const ScanPoint> points, const Pose2& pose, bool with_sight) {
  const Turn2 turn(pose.yaw_rad);
  const Eigen::Vector2d place = pose.place() - middle_m_;
  for (const ScanPoint& point : points) {
    const Eigen::Vector2d p = turn * as_double(point) + place;
    constexpr double kHalf_m = kCell_m * (kSide / 2);
    if (!(p.x() > -kHalf_m && p.x() < kHalf_m && p.y() > -kHalf_m && p.y() < kHalf_m)) continue;
    const std::int32_t column = cell_of(p.x()), row = cell_of(p.y());
    if (!is_inside(column, row)) continue;
    if (with_sight) see(place, p);
    Cell* const cell = cell_at(column, row);
    if (cell == nullptr) continue;
    const auto x = static_cast<float>(p.x() - middle_of(column)), y = static_cast<float>(p.y() - middle_of(row));
    cell->x_m += x;
    cell->y_m += y;
    cell->xx_m2 += x * x;
    cell->xy_m2 += x * y;
    cell->yy_m2 += y * y;
    ++cell->count;
  }
}

// Marks the line of sight, up to a cell before its end.
void SurfaceMap::see(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  const Eigen::Vector2d way = to_m - from_m;
  const double longest_m = std::max(std::abs(way.x()), std::abs(way.y()));
  const auto steps = static_cast<std::int32_t>(longest_m / kSeenCell_m) + 1;
  for (std::int32_t k = 0; k <= steps; ++k) {
    const Eigen::Vector2d p = from_m + way * (static_cast<double>(k) / steps);
    const std::int32_t column = cell_of(p.x()), row = cell_of(p.y());
    if (!is_inside(column, row)) continue;
    seen_[static_cast<std::uint32_t>(row / kShrink * kSeenSide + column / kShrink)] = 1;
  }
}

bool SurfaceMap::is_seen(double x_m, double y_m) const {
  constexpr double kHalf_m = kCell_m * (kSide / 2);
  if (!(x_m > -kHalf_m && x_m < kHalf_m && y_m > -kHalf_m && y_m < kHalf_m)) return false;
  const std::int32_t column = cell_of(x_m), row = cell_of(y_m);
  if (!is_inside(column, row)) return false;
  return seen_[static_cast<std::uint32_t>(row / kShrink * kSeenSide + column / kShrink)] != 0;
}

// Mean and spread of the points of a cell and of the eight around it.
void SurfaceMap::make_surface(std::uint32_t index) {
  const Cell& own = cells_[index];
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::int32_t row = own.row - 1; row <= own.row + 1; ++row) {
    for (std::int32_t column = own.column - 1; column <= own.column + 1; ++column) {
      if (!is_inside(column, row) || index_[at(column, row)] == kNone) continue;
      const Cell& cell = cells_[index_[at(column, row)]];
      const double dx = (column - own.column) * kCell_m, dy = (row - own.row) * kCell_m;
      const double count = cell.count, sx = static_cast<double>(cell.x_m), sy = static_cast<double>(cell.y_m);
      n += count;
      x += sx + count * dx;
      y += sy + count * dy;
      xx += static_cast<double>(cell.xx_m2) + 2.0 * dx * sx + count * dx * dx;
      xy += static_cast<double>(cell.xy_m2) + dx * sy + dy * sx + count * dx * dy;
      yy += static_cast<double>(cell.yy_m2) + 2.0 * dy * sy + count * dy * dy;
    }
  }
  const double mx = x / n, my = y / n;
  const double vxx = xx / n - mx * mx, vxy = xy / n - mx * my, vyy = yy / n - my * my;
  const double half = 0.5 * (vxx - vyy), root = std::sqrt(half * half + vxy * vxy), middle = 0.5 * (vxx + vyy);
  // The eigenvector of the least spread, from the longer of its two forms; of a round cluster any.
  const Eigen::Vector2d first(-vxy, half + root), second(root - half, -vxy);
  const Eigen::Vector2d longer = first.squaredNorm() > second.squaredNorm() ? first : second;
  const double length = std::sqrt(longer.squaredNorm());
  Surface& surface = surfaces_[index];
  surface.x_m = static_cast<float>(middle_of(own.column) + mx);
  surface.y_m = static_cast<float>(middle_of(own.row) + my);
  surface.normal_x = static_cast<float>(length > 0.0 ? longer.x() / length : 0.0);
  surface.normal_y = static_cast<float>(length > 0.0 ? longer.y() / length : 1.0);
  surface.across_m2 = static_cast<float>(middle - root > 0.0 ? middle - root : 0.0);
  surface.along_m2 = static_cast<float>(middle + root);
}

// Empty cells around a surface find the nearest one.
void SurfaceMap::spread_surface(std::uint32_t index) {
  const Cell& own = cells_[index];
  for (std::int32_t row = own.row - kReach; row <= own.row + kReach; ++row) {
    for (std::int32_t column = own.column - kReach; column <= own.column + kReach; ++column) {
      if (!is_inside(column, row) || index_[at(column, row)] != kNone) continue;
      std::uint16_t& nearest = nearest_[at(column, row)];
      const auto distance_of = [&](const Surface& surface) {
        const double dx = middle_of(column) - static_cast<double>(surface.x_m);
        const double dy = middle_of(row) - static_cast<double>(surface.y_m);
        return dx * dx + dy * dy;
      };
      if (nearest == kNone || distance_of(surfaces_[index]) < distance_of(surfaces_[nearest])) {
        nearest = static_cast<std::uint16_t>(index);
      }
    }
  }
}

void SurfaceMap::spread_likelihood(const Cell& cell) {
  // exp(-d^2 / (2 s^2)) with s of a cell, by the distance between cells.
  static constexpr std::uint8_t kBell[kReach + 1][kReach + 1] = {{255, 155, 35}, {155, 94, 21}, {35, 21, 5}};
  for (std::int32_t dy = -kReach; dy <= kReach; ++dy) {
    for (std::int32_t dx = -kReach; dx <= kReach; ++dx) {
      const std::int32_t column = cell.column + dx, row = cell.row + dy;
      if (!is_inside(column, row)) continue;
      const std::uint8_t bell = kBell[dy < 0 ? -dy : dy][dx < 0 ? -dx : dx];
      std::uint8_t& value = field_[0][at(column, row)];
      if (bell <= value) continue;
      value = bell;
      raise(1, column / kShrink, row / kShrink, bell);
    }
  }
}

// A value goes to the block that holds it, and to the blocks to the left and below, whose neighbour that is.
void SurfaceMap::raise(std::uint32_t level, std::int32_t x, std::int32_t y, std::uint8_t value) {
  const std::int32_t side = kSide >> (2U * level);
  for (std::int32_t v = y > 0 ? y - 1 : 0; v <= y; ++v) {
    for (std::int32_t u = x > 0 ? x - 1 : 0; u <= x; ++u) {
      std::uint8_t& most = field_[level][static_cast<std::uint32_t>(v * side + u)];
      if (value <= most) continue;
      most = value;
      if (level + 1 < kLevels) raise(level + 1, u / kShrink, v / kShrink, value);
    }
  }
}

void SurfaceMap::finish() {
  for (std::uint32_t k = 0; k < used_; ++k) {
    make_surface(k);
    nearest_[at(cells_[k].column, cells_[k].row)] = static_cast<std::uint16_t>(k);
    spread_likelihood(cells_[k]);
  }
  for (std::uint32_t k = 0; k < used_; ++k) spread_surface(k);
}

const Surface* SurfaceMap::near(double x_m, double y_m) const {
  constexpr double kHalf_m = kCell_m * (kSide / 2);
  if (!(x_m > -kHalf_m && x_m < kHalf_m && y_m > -kHalf_m && y_m < kHalf_m)) return nullptr;
  const std::int32_t column = cell_of(x_m), row = cell_of(y_m);
  if (!is_inside(column, row)) return nullptr;
  const std::uint16_t index = nearest_[at(column, row)];
  return index != kNone ? &surfaces_[index] : nullptr;
}

std::uint32_t SurfaceMap::likelihood(std::uint32_t level, std::int32_t cell_x, std::int32_t cell_y) const {
  const std::int32_t side = kSide >> (2U * level);
  if (cell_x < 0 || cell_x >= side || cell_y < 0 || cell_y >= side) return 0;
  return field_[level][static_cast<std::uint32_t>(cell_y * side + cell_x)];
}

}  // namespace pose_wall::planar
