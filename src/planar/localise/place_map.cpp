// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/localise/place_map.hpp"

#include <algorithm>
#include <cmath>

namespace pose_wall::planar {
namespace {

constexpr std::int32_t kReachCells = 5;  // kReach_m

double middle_of(std::int32_t cell) {
  return (cell - PlaceMap::kAcross * PlaceMap::kTileCells / 2 + 0.5) * PlaceMap::kCell_m;
}

}  // namespace

void PlaceMap::lay_out(Arena& arena, std::uint32_t tiles_most) {
  tiles_most_ = tiles_most;
  directory_ = arena.take<std::uint16_t>(static_cast<std::uint32_t>(kAcross * kAcross));
  nearest_ = arena.take<std::uint32_t>(tiles_most * kTileSize);
  seen_ = arena.take<std::uint8_t>(tiles_most * kTileCoarseSize);
  field_ = arena.take<std::uint8_t>(tiles_most * kTileCoarseSize);
  cells_ = arena.take<Cell>(tiles_most * kCellsPerTile);
  surfaces_ = arena.take<Surface>(tiles_most * kCellsPerTile);
}

void PlaceMap::open() {
  directory_.fill(static_cast<std::uint16_t>(kNone));
  tile_count_ = used_ = 0;
  has_middle_ = is_finished_ = false;
  middle_m_.setZero();
}

std::uint32_t PlaceMap::make(std::int32_t tile_x, std::int32_t tile_y) {
  const std::uint32_t known = find(tile_x, tile_y);
  if (known != kNone || tile_count_ == tiles_most_) return known;
  const std::uint32_t tile = tile_count_++;
  directory_[static_cast<std::uint32_t>(tile_y * kAcross + tile_x)] = static_cast<std::uint16_t>(tile);
  Span<std::uint32_t>(nearest_.data() + tile * kTileSize, kTileSize).fill(kNoSurface);
  Span<std::uint8_t>(seen_.data() + tile * kTileCoarseSize, kTileCoarseSize).fill(0);
  Span<std::uint8_t>(field_.data() + tile * kTileCoarseSize, kTileCoarseSize).fill(0);
  return tile;
}

// `column` and `row` count coarse cells.
std::uint8_t* PlaceMap::coarse_at(const Span<std::uint8_t>& of, std::int32_t column, std::int32_t row) const {
  const std::uint32_t tile = find(column / kTileCoarse, row / kTileCoarse);
  if (tile == kNone) return nullptr;
  const std::int32_t inside = row % kTileCoarse * kTileCoarse + column % kTileCoarse;
  return &of[tile * kTileCoarseSize + static_cast<std::uint32_t>(inside)];
}

void PlaceMap::take_middle(const Eigen::Vector2d& place_m) {
  if (has_middle_) return;
  constexpr double kTile_m = kCell_m * kTileCells;
  middle_m_ = {kTile_m * std::floor(place_m.x() / kTile_m), kTile_m * std::floor(place_m.y() / kTile_m)};
  has_middle_ = true;
}

bool PlaceMap::put(const Eigen::Vector2d& p) {
  const std::int32_t column = cell_of(p.x()), row = cell_of(p.y());
  if (make(column / kTileCells, row / kTileCells) == kNone) return false;
  std::uint32_t& index = *nearest_at(column, row);
  if (index == kNoSurface) {
    if (used_ == cells_.size()) return false;
    cells_[used_] = {0.0F, 0.0F, 0.0F, 0.0F, 0.0F, 0, column, row};
    index = used_++;
  }
  Cell& cell = cells_[index];
  const auto x = static_cast<float>(p.x() - middle_of(column)), y = static_cast<float>(p.y() - middle_of(row));
  cell.x_m += x;
  cell.y_m += y;
  cell.xx_m2 += x * x;
  cell.xy_m2 += x * y;
  cell.yy_m2 += y * y;
  ++cell.count;
  return true;
}

bool PlaceMap::see_at(const Eigen::Vector2d& p) {
  const std::int32_t column = cell_of(p.x()), row = cell_of(p.y());
  if (make(column / kTileCells, row / kTileCells) == kNone) return false;
  *coarse_at(seen_, column / kShrink, row / kShrink) = 1;
  return true;
}

bool PlaceMap::see(const Eigen::Vector2d& from_m, const Eigen::Vector2d& to_m) {
  const Eigen::Vector2d way = to_m - from_m;
  const double longest_m = std::max(std::abs(way.x()), std::abs(way.y()));
  const auto steps = static_cast<std::int32_t>(longest_m / kCoarse_m) + 1;
  bool fits = true;
  for (std::int32_t k = 0; k <= steps; ++k) {
    fits = see_at(from_m + way * (static_cast<double>(k) / steps)) && fits;
  }
  return fits;
}

bool PlaceMap::add(Span<const ScanPoint> points, const Pose2& pose) {
  take_middle(pose.place());
  const Turn2 turn(pose.yaw_rad);
  const Eigen::Vector2d place = pose.place() - middle_m_;
  if (!is_inside(place.x(), place.y())) return false;
  bool fits = true;
  for (const ScanPoint& point : points) {
    const Eigen::Vector2d p = turn * as_double(point) + place;
    const bool is_held = is_inside(p.x(), p.y()) && put(p) && see(place, p);
    fits = fits && is_held;
  }
  return fits;
}

bool PlaceMap::add_free(const Eigen::Vector2d& place_m) {
  take_middle(place_m);
  const Eigen::Vector2d p = place_m - middle_m_;
  return is_inside(p.x(), p.y()) && see_at(p);
}

bool PlaceMap::add_surface(const Eigen::Vector2d& place_m) {
  take_middle(place_m);
  const Eigen::Vector2d p = place_m - middle_m_;
  return is_inside(p.x(), p.y()) && put(p) && see_at(p);
}

// Mean and spread of the points of a cell and of the eight around it.
void PlaceMap::make_surface(std::uint32_t index) {
  const Cell& own = cells_[index];
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::int32_t row = own.row - 1; row <= own.row + 1; ++row) {
    for (std::int32_t column = own.column - 1; column <= own.column + 1; ++column) {
      const std::uint32_t* const at = nearest_at(column, row);
      if (at == nullptr || *at == kNoSurface) continue;
      const Cell& cell = cells_[*at];
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
  const double along_rad = root > 0.0 ? 0.5 * arc_tangent2(vxy, half) : 0.0;  // of a round cluster any
  Surface& surface = surfaces_[index];
  surface.x_m = static_cast<float>(middle_of(own.column) + mx);
  surface.y_m = static_cast<float>(middle_of(own.row) + my);
  surface.normal_x = static_cast<float>(-sine(along_rad));
  surface.normal_y = static_cast<float>(cosine(along_rad));
  surface.across_m2 = static_cast<float>(middle - root > 0.0 ? middle - root : 0.0);
  surface.along_m2 = static_cast<float>(middle + root);
}

// Cells without a surface find the nearest one. Cells that hold points keep their own.
void PlaceMap::spread(std::uint32_t index) {
  const Cell& own = cells_[index];
  for (std::int32_t row = own.row - kReachCells; row <= own.row + kReachCells; ++row) {
    for (std::int32_t column = own.column - kReachCells; column <= own.column + kReachCells; ++column) {
      make(column / kTileCells, row / kTileCells);
      std::uint32_t* const nearest = nearest_at(column, row);
      if (nearest == nullptr) continue;
      if (*nearest != kNoSurface && cells_[*nearest].column == column && cells_[*nearest].row == row) continue;
      const auto distance_of = [&](const Surface& surface) {
        const double dx = middle_of(column) - static_cast<double>(surface.x_m);
        const double dy = middle_of(row) - static_cast<double>(surface.y_m);
        return dx * dx + dy * dy;
      };
      const double distance_m2 = distance_of(surfaces_[index]);
      if (distance_m2 > kReach_m * kReach_m) continue;
      if (*nearest == kNoSurface || distance_m2 < distance_of(surfaces_[*nearest])) *nearest = index;
    }
  }
}

// By the distance from the middle of a coarse cell to the cell of a surface.
void PlaceMap::spread_likelihood(const Cell& cell) {
  constexpr double kNear2_m2 = 0.35 * 0.35, kClose2_m2 = 0.65 * 0.65, kAbout2_m2 = 0.95 * 0.95;
  const std::int32_t u = cell.column / kShrink, v = cell.row / kShrink;
  for (std::int32_t row = v - 2; row <= v + 2; ++row) {
    for (std::int32_t column = u - 2; column <= u + 2; ++column) {
      const double dx = (kShrink * column + 0.5 * kShrink - cell.column - 0.5) * kCell_m;
      const double dy = (kShrink * row + 0.5 * kShrink - cell.row - 0.5) * kCell_m;
      const double distance_m2 = dx * dx + dy * dy;
      if (distance_m2 > kAbout2_m2) continue;
      make(column / kTileCoarse, row / kTileCoarse);
      std::uint8_t* const value = coarse_at(field_, column, row);
      const std::uint8_t own = distance_m2 < kNear2_m2 ? kLikely : distance_m2 < kClose2_m2 ? 2 : 1;
      if (value != nullptr && own > *value) *value = own;
    }
  }
}

void PlaceMap::finish() {
  for (std::uint32_t k = 0; k < used_; ++k) make_surface(k);
  for (std::uint32_t k = 0; k < used_; ++k) {
    spread(k);
    spread_likelihood(cells_[k]);
  }
  is_finished_ = true;
}

bool PlaceMap::is_seen(double x_m, double y_m) const {
  if (!is_inside(x_m, y_m)) return false;
  const std::uint8_t* const seen = coarse_at(seen_, cell_of(x_m) / kShrink, cell_of(y_m) / kShrink);
  return seen != nullptr && *seen != 0;
}

bool PlaceMap::is_surface(double x_m, double y_m) const {
  if (!is_inside(x_m, y_m)) return false;
  const std::int32_t column = cell_of(x_m), row = cell_of(y_m);
  const std::uint32_t* const index = nearest_at(column, row);
  return index != nullptr && *index != kNoSurface && cells_[*index].column == column && cells_[*index].row == row;
}

const std::uint8_t* PlaceMap::likelihood_row(std::int32_t tile_x, std::int32_t tile_y, std::int32_t row) const {
  const std::uint32_t tile = find(tile_x, tile_y);
  if (tile == kNone) return nullptr;
  return &field_[tile * kTileCoarseSize + static_cast<std::uint32_t>(row * kTileCoarse)];
}

std::uint32_t PlaceMap::standable_row(std::int32_t tile_x, std::int32_t tile_y, std::int32_t row) const {
  const std::uint32_t tile = find(tile_x, tile_y);
  if (tile == kNone) return 0;
  const std::uint32_t first = tile * kTileCoarseSize + static_cast<std::uint32_t>(row * kTileCoarse);
  std::uint32_t bits = 0;
  for (std::uint32_t x = 0; x < static_cast<std::uint32_t>(kTileCoarse); ++x) {
    if (seen_[first + x] != 0 && field_[first + x] < kLikely) bits |= 1U << x;
  }
  return bits;
}

}  // namespace pose_wall::planar
