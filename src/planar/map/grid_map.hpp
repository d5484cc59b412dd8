// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A map of tiles: how it takes in a scan, makes room, and keeps bits of things and their distances in step with cells.

#pragma once

#include <cstdint>

#include "place/beams.hpp"
#include "place/pose2.hpp"
#include "planar/map/beam_walk.hpp"
#include "planar/map/distance_field.hpp"
#include "planar/map/tile_table.hpp"

namespace pose_wall::planar {

// Of what a call that writes did and could not do.
struct MapWork {
  std::uint32_t tiles_new = 0, tiles_saved = 0;
  bool refused = false;
  std::uint32_t beams_not_stored = 0;
  std::uint32_t things_new = 0, things_gone = 0;
};

// Checked, in cells. A tile's worth and a cap beyond the reach still fit 32 bits.
struct MapPlace {
  double x = 0.0, y = 0.0;

  std::int32_t cell_x() const { return static_cast<std::int32_t>(std::floor(x)); }
  std::int32_t cell_y() const { return static_cast<std::int32_t>(std::floor(y)); }
};

class GridMap {
 public:
  void lay_out(Arena& arena, const pose_wall_planar_map_settings& settings);
  void open(const pose_wall_planar_map_settings& settings);
  void clear();

  // Checked arguments.
  MapWork insert(const pose_wall_planar_scan& scan, const Pose2& base);
  // Adds the evidence of a checked record. False, and nothing changed, where no tile could be had.
  bool put(const pose_wall_planar_tile& tile);
  // The same without making room, and without renewing bits and distances: finish_loading() follows the last.
  void load(const pose_wall_planar_tile& tile);
  void finish_loading();

  void copy_out(std::uint32_t tile, pose_wall_planar_tile* record) const;

  const pose_wall_planar_map_settings& settings() const { return settings_; }
  const TileTable& tiles() const { return tiles_; }
  const CellModel& model() const { return model_; }
  const DistanceField& distances() const { return distances_; }
  std::uint32_t renew(std::uint32_t most) { return distances_.renew(most, call_); }

  MapPlace place_of(double x_m, double y_m) const { return {x_m / settings_.cell_m, y_m / settings_.cell_m}; }
  // kNeverSeen also where no tile is.
  std::uint8_t value_at(std::int32_t x, std::int32_t y) const;

  // Tile indices by row, then column. In the scratch of this map.
  Span<const std::uint32_t> in_order();

  pose_wall_planar_save save = nullptr;
  void* save_context = nullptr;

 private:
  // Where the last cell lay: most beams stay in a tile for many cells.
  struct Cursor {
    std::int32_t x = 0, y = 0;  // a corner of the tile
    std::uint8_t* cells = nullptr;
    bool stored = false;

    bool holds(std::int32_t cell_x, std::int32_t cell_y) const {
      return cells != nullptr && (((cell_x ^ x) | (cell_y ^ y)) & ~(kTileSide - 1)) == 0;
    }
    std::uint8_t& at(std::int32_t cell_x, std::int32_t cell_y) const {
      return cells[inside_tile(cell_y) * kTileSide + inside_tile(cell_x)];
    }
  };

  void read_scan(const pose_wall_planar_scan& scan, const Pose2& base);
  double free_cells(std::uint32_t beam) const;
  double sine_of_incidence(std::uint32_t beam, std::int64_t lag) const;
  double first_cell(std::uint32_t beam) const;
  double grazing_margin(std::uint32_t beam) const;
  void mark_things(MapWork* work);
  void free_ways(MapWork* work);
  bool free_way(const BeamWalk& walk, MapWork* work);
  void move_to(std::int32_t x, std::int32_t y, MapWork* work);
  std::uint32_t tile_for_writing(std::int32_t column, std::int32_t row, MapWork* work);
  std::uint32_t tile_to_give() const;
  bool give(std::uint32_t tile);
  void settle(MapWork* work);
  void settle_tile(std::uint32_t tile, MapWork* work);
  void read_things(std::uint32_t tile);
  void tell_changes(std::uint32_t tile, const std::uint64_t* before, MapWork* work);
  void add_cells(std::uint32_t tile, const pose_wall_planar_tile& record);

  pose_wall_planar_map_settings settings_{};
  CellModel model_;
  TileTable tiles_;
  DistanceField distances_;
  std::uint64_t call_ = 0;
  MapPlace sensor_;
  Cursor cursor_;
  // Of the scan at hand:
  BeamScan scan_;
  double step_rad_ = 0.0;
  Span<Beam> beams_;             // directions turned into map
  Span<float> free_;             // cells that each beam frees
  Span<std::uint8_t> unstored_;  // beams some of whose cells had no tile
  Span<std::uint32_t> touched_;  // tiles; as many as touched_count_
  std::uint32_t touched_count_ = 0;
  Span<std::uint8_t> nowhere_;  // a tile's cells for those that have none
  Span<std::uint32_t> order_;
  pose_wall_planar_tile *record_ = nullptr, *arriving_ = nullptr;
};

}  // namespace pose_wall::planar
