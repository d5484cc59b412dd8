// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Squared distances, in cells, from each cell to the nearest thing, exact, up to a cap. Kept up as things come and go:
// a new thing lowers its square of cells at once; one that vanished marks the cells that it was nearest to, which
// renew() computes anew. Outside the marked boxes (TileHead::stale) every stored square is exact.

#pragma once

#include <cstdint>

#include "planar/map/tile_table.hpp"

namespace pose_wall::planar {

class DistanceField {
 public:
  // cap: in cells, 1 to kCapMost; 0: no distances, and no call does anything.
  void lay_out(Arena& arena, bool with_distances);
  void open(TileTable* tiles, std::int32_t cap);

  static constexpr std::int32_t kCapMost = 120;  // two sums of squares fit 16 bits: 120^2 + kFarSquare < 2^15

  bool kept() const { return cap_ > 0; }
  std::int32_t cap() const { return cap_; }

  // The bits of the table change first, then these are called.
  void thing_came(std::int32_t x, std::int32_t y);
  void thing_went(std::int32_t x, std::int32_t y);
  // Many did, all in this box.
  void things_changed(const CellBox& box);
  // A tile without things was added to the table.
  void tile_came(std::uint32_t tile);
  // The things of a tile vanish with it, which is still in the table.
  void tile_goes(std::uint32_t tile);

  // Up to so many tiles, those that this call wrote to first. Returns how many then wait.
  std::uint32_t renew(std::uint32_t most, std::uint64_t call);
  std::uint32_t stale_tiles() const;

  // Squared, at most cap^2. For any cell, also where no tile is, and where squares wait to be renewed.
  std::int32_t square_at(std::int32_t x, std::int32_t y) const;

 private:
  static constexpr std::int16_t kFarSquare = 16000;  // more than the cap's square
  static constexpr std::uint32_t kWords = 5;         // a row of a tile and the widest cap to both sides
  static constexpr std::uint32_t kWide = kWords * POSE_WALL_PLANAR_TILE_SIDE;  // cells of that row

  void mark(const CellBox& box);
  void lower_in_tile(std::uint32_t tile, const CellBox& box, std::int32_t x, std::int32_t y) const;
  CellBox nearest_to(std::uint32_t tile, const CellBox& box, std::int32_t x, std::int32_t y) const;
  void renew_tile(std::uint32_t tile);
  bool has_things(const CellBox& box) const;
  void columns_below(const CellBox& box, std::int32_t column_first, std::uint32_t words);
  void columns_above(const CellBox& box, std::int32_t column_first, std::uint32_t words);
  void rows_of(std::uint32_t tile, const CellBox& box, std::int32_t column_first, std::uint32_t words);
  void next_row(std::int32_t column_first, std::uint32_t words, std::int32_t y);
  std::int32_t search(std::int32_t x, std::int32_t y) const;
  std::int32_t search_row(std::int32_t x, std::int32_t y, std::int32_t within) const;

  TileTable* tiles_ = nullptr;
  std::int32_t cap_ = 0;
  Span<std::int16_t> by_offset_;  // squares of -kCapMost to kCapMost + a tile
  Span<std::uint8_t> since_;      // of each column: rows since the last thing, at most cap + 1
  Span<std::uint8_t> in_column_;  // rows of a tile: the distance within the column
  Span<std::int16_t> row_squares_;
};

}  // namespace pose_wall::planar
