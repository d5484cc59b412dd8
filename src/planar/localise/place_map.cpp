// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/localise/place_map.hpp"

#include <cmath>

namespace pose_wall::planar {

void PlaceMap::lay_out(Arena& arena, std::uint32_t tiles_most) {
  tiles_most_ = tiles_most;
  directory_ = arena.take<std::uint16_t>(static_cast<std::uint32_t>(kAcross * kAcross));
  nearest_ = arena.take<std::uint32_t>(tiles_most * kTileSize);
  seen_ = arena.take<std::uint8_t>(tiles_most * kTileCoarseSize);
  field_ = arena.take<std::uint8_t>(tiles_most * kTileCoarseSize);
  cells_.lay_out(arena, tiles_most * kCellsPerTile);
}

void PlaceMap::open() {
  directory_.fill(static_cast<std::uint16_t>(kNone));
  tile_count_ = 0;
  cells_.clear();
  has_middle_ = is_finished_ = false;
  middle_m_.setZero();
}

std::uint32_t PlaceMap::make(std::int32_t tile_x, std::int32_t tile_y) {
  const std::uint32_t known = find(tile_x, tile_y);
  if (known != kNone || tile_count_ == tiles_most_) return known;
  const std::uint32_t tile = tile_count_++;
  directory_[static_cast<std::uint32_t>(tile_y * kAcross + tile_x)] = static_cast<std::uint16_t>(tile);
  Span<std::uint32_t>(nearest_.data() + tile * kTileSize, kTileSize).fill(Cells::kNone);
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
  constexpr double kTile_m = kSurfaceCell_m * kTileCells;  // the middle is a corner of tiles
  middle_m_ = {kTile_m * std::floor(place_m.x() / kTile_m), kTile_m * std::floor(place_m.y() / kTile_m)};
  has_middle_ = true;
}

bool PlaceMap::put(const Eigen::Vector2d& p) {
  const std::int32_t column = Cells::cell_of(p.x()), row = Cells::cell_of(p.y());
  return make(column / kTileCells, row / kTileCells) != kNone && cells_.put(p, column, row, nearest_at(column, row));
}

bool PlaceMap::see_at(const Eigen::Vector2d& p) {
  const std::int32_t column = Cells::cell_of(p.x()), row = Cells::cell_of(p.y());
  if (make(column / kTileCells, row / kTileCells) == kNone) return false;
  *coarse_at(seen_, column / kSightCells, row / kSightCells) = 1;
  return true;
}

bool PlaceMap::add(Span<const ScanPoint> points, const Pose2& pose) {
  take_middle(pose.place());
  const Turn2 turn(pose.yaw_rad);
  const Eigen::Vector2d place = pose.place() - middle_m_;
  if (!Cells::holds(place.x(), place.y())) return false;
  bool fits = true;
  for (const ScanPoint& point : points) {
    const Eigen::Vector2d p = turn * as_double(point) + place;
    const bool is_held = Cells::holds(p.x(), p.y()) && put(p);
    fits = fits && is_held;
    if (is_held) walk_sight(place, p, [&](const Eigen::Vector2d& q) { fits = see_at(q) && fits; });
  }
  return fits;
}

bool PlaceMap::add_free(const Eigen::Vector2d& place_m) {
  take_middle(place_m);
  const Eigen::Vector2d p = place_m - middle_m_;
  return Cells::holds(p.x(), p.y()) && see_at(p);
}

bool PlaceMap::add_surface(const Eigen::Vector2d& place_m) {
  take_middle(place_m);
  const Eigen::Vector2d p = place_m - middle_m_;
  return Cells::holds(p.x(), p.y()) && put(p) && see_at(p);
}

// By the distance from the middle of a coarse cell to the cell of a surface.
void PlaceMap::spread_likelihood(const SurfaceCell& cell) {
  // 3, 2 or 1. Within the first a point may lie whose place is off by half a coarse cell and half a step of yaw; the
  // others are a coarse cell's 0.3 m of slope further, for steps that are off both ways.
  constexpr double kNear_m = 0.35, kClose_m = 0.65, kAbout_m = 0.95;
  const std::int32_t u = cell.column / kSightCells, v = cell.row / kSightCells;
  for (std::int32_t row = v - 2; row <= v + 2; ++row) {
    for (std::int32_t column = u - 2; column <= u + 2; ++column) {
      const double dx = (kSightCells * column + 0.5 * kSightCells - cell.column - 0.5) * kSurfaceCell_m;
      const double dy = (kSightCells * row + 0.5 * kSightCells - cell.row - 0.5) * kSurfaceCell_m;
      const double distance_m2 = dx * dx + dy * dy;
      if (distance_m2 > kAbout_m * kAbout_m) continue;
      make(column / kTileCoarse, row / kTileCoarse);
      std::uint8_t* const value = coarse_at(field_, column, row);
      const std::uint8_t own = distance_m2 < kNear_m * kNear_m ? kLikely : distance_m2 < kClose_m * kClose_m ? 2 : 1;
      if (value != nullptr && own > *value) *value = own;
    }
  }
}

void PlaceMap::finish() {
  cells_.make_surfaces([this](std::int32_t column, std::int32_t row) { return nearest_at(column, row); });
  for (std::uint32_t k = 0; k < cells_.used(); ++k) {
    cells_.spread(k, kReach, [this](std::int32_t column, std::int32_t row) {
      make(column / kTileCells, row / kTileCells);
      return nearest_at(column, row);
    });
    spread_likelihood(cells_.cell(k));
  }
  is_finished_ = true;
}

bool PlaceMap::is_seen(double x_m, double y_m) const {
  if (!Cells::holds(x_m, y_m)) return false;
  const std::uint8_t* const seen =
      coarse_at(seen_, Cells::cell_of(x_m) / kSightCells, Cells::cell_of(y_m) / kSightCells);
  return seen != nullptr && *seen != 0;
}

bool PlaceMap::is_surface(double x_m, double y_m) const {
  if (!Cells::holds(x_m, y_m)) return false;
  const std::int32_t column = Cells::cell_of(x_m), row = Cells::cell_of(y_m);
  const std::uint32_t* const slot = nearest_at(column, row);
  return slot != nullptr && cells_.is_of(*slot, column, row);
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
