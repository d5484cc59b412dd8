// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The whole saved map for localisation: surfaces in cells of a decimetre, which places were seen, and a coarse field of
// likelihood for the search. Tiles hold what there is, so a road costs by its length and not by the square around it.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "place/beams.hpp"
#include "place/pose2.hpp"
#include "place/surface.hpp"

namespace pose_wall::planar {

class PlaceMap {
 public:
  static constexpr std::int32_t kTileCells = 64;                         // to a side: 6.4 m, the width of a road
  static constexpr std::int32_t kTileCoarse = kTileCells / kSightCells;  // coarse cells to a side, kSight_m each
  static constexpr std::int32_t kAcross = 640;  // tiles of the square that a map may lie in: 4 km
  static constexpr std::int32_t kReach = 5;     // cells: from 0.5 m a seed of the search, up to 0.28 m off, finds walls
  static constexpr std::uint8_t kLikely = 3;    // the most of the coarse field

  void lay_out(Arena& arena, std::uint32_t tiles_most);
  // An empty map, also in memory that may hold anything.
  void open();
  // False where tiles or cells ran out, or a point lies outside the square: the map then lacks it.
  bool add(Span<const ScanPoint> points, const Pose2& pose);
  // A place that was seen to be free, and one where a surface is; for maps of cells. The first place sets the middle.
  bool add_free(const Eigen::Vector2d& place_m);
  bool add_surface(const Eigen::Vector2d& place_m);
  // After the last of them.
  void finish();

  bool is_empty() const { return cells_.used() == 0; }
  bool is_finished() const { return is_finished_; }
  std::uint32_t tiles() const { return tile_count_; }
  std::uint32_t surfaces() const { return cells_.used(); }
  const Eigen::Vector2d& middle_m() const { return middle_m_; }

  // Places below are given from the middle. A surface within kReach cells, or nullptr.
  const Surface* near(double x_m, double y_m) const {
    if (!Cells::holds(x_m, y_m)) return nullptr;
    const std::uint32_t* const slot = nearest_at(Cells::cell_of(x_m), Cells::cell_of(y_m));
    return slot != nullptr ? cells_.surface(*slot) : nullptr;
  }
  // Whether lines of sight went through the 40 cm about a place.
  bool is_seen(double x_m, double y_m) const;
  // A surface lies in this cell.
  bool is_surface(double x_m, double y_m) const;

  // Rows of kTileCoarse coarse cells of a tile. No such tile: nullptr.
  const std::uint8_t* likelihood_row(std::int32_t tile_x, std::int32_t tile_y, std::int32_t row) const;
  // Bit x: the coarse cell is open and was seen, so a machine may stand there.
  std::uint32_t standable_row(std::int32_t tile_x, std::int32_t tile_y, std::int32_t row) const;
  bool has_tile(std::int32_t tile_x, std::int32_t tile_y) const { return find(tile_x, tile_y) != kNone; }

 private:
  // What spreads from a cell stays inside the square, also the coarse field's 1.2 m.
  using Cells = SurfaceCells<kAcross * kTileCells, 20, std::uint32_t>;

  static constexpr std::uint32_t kNone = 0xFFFF;  // no tile: more than a localisation may have
  static constexpr auto kTileSize = static_cast<std::uint32_t>(kTileCells * kTileCells);  // cells of a tile
  static constexpr auto kTileCoarseSize =
      static_cast<std::uint32_t>(kTileCoarse * kTileCoarse);  // coarse cells of a tile
  static constexpr std::uint32_t kCellsPerTile = 256;         // in the mean. Rough roads need 132.

  std::uint32_t find(std::int32_t tile_x, std::int32_t tile_y) const {
    if (tile_x < 0 || tile_x >= kAcross || tile_y < 0 || tile_y >= kAcross) return kNone;
    return directory_[static_cast<std::uint32_t>(tile_y * kAcross + tile_x)];
  }
  std::uint32_t make(std::int32_t tile_x, std::int32_t tile_y);
  std::uint32_t* nearest_at(std::int32_t column, std::int32_t row) const {
    const std::uint32_t tile = find(column / kTileCells, row / kTileCells);
    if (tile == kNone) return nullptr;
    const std::int32_t inside = row % kTileCells * kTileCells + column % kTileCells;
    return &nearest_[tile * kTileSize + static_cast<std::uint32_t>(inside)];
  }
  std::uint8_t* coarse_at(const Span<std::uint8_t>& of, std::int32_t column, std::int32_t row) const;
  void take_middle(const Eigen::Vector2d& place_m);
  bool put(const Eigen::Vector2d& p);
  bool see_at(const Eigen::Vector2d& p);
  void spread_likelihood(const SurfaceCell& cell);

  Eigen::Vector2d middle_m_ = Eigen::Vector2d::Zero();
  Span<std::uint16_t> directory_;
  Span<std::uint32_t> nearest_;  // of each cell of each tile: a surface
  Span<std::uint8_t> seen_, field_;
  Cells cells_;
  std::uint32_t tile_count_ = 0, tiles_most_ = 0;
  bool has_middle_ = false, is_finished_ = false;
};

}  // namespace pose_wall::planar
