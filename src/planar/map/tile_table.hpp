// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The tiles of a map and where each lies: a table by the tiles' coordinates in the caller's block.

#pragma once

#include <cstdint>

#include "base/containers/arena.hpp"
#include "base/containers/span.hpp"
#include "planar/map/cell_model.hpp"

namespace pose_wall::planar {

constexpr std::int32_t kTileSide = POSE_WALL_PLANAR_TILE_SIDE;     // a row of cells is the bits of one word
constexpr std::int32_t kTileBits = 6;                              // the side's binary logarithm
constexpr std::uint32_t kTileCells = POSE_WALL_PLANAR_TILE_CELLS;  // as the header says
constexpr std::uint32_t kNoTile = 0xFFFFFFFFU;                     // no index: a table holds 65,536 at most

// Both round down, also below zero.
inline std::int32_t tile_of(std::int32_t cell) {
  return cell >> kTileBits;
}
inline std::int32_t inside_tile(std::int32_t cell) {
  return cell & (kTileSide - 1);
}

// A rectangle of cells, both ends within; empty where x0 > x1.
struct CellBox {
  std::int32_t x0 = 1, y0 = 1, x1 = 0, y1 = 0;

  bool empty() const { return x0 > x1 || y0 > y1; }
  bool holds(std::int32_t x, std::int32_t y) const { return x >= x0 && x <= x1 && y >= y0 && y <= y1; }
  void take_in(const CellBox& other);
  CellBox widened(std::int32_t by) const { return {x0 - by, y0 - by, x1 + by, y1 + by}; }
  CellBox cut_to(const CellBox& other) const;
};

struct TileHead {
  std::int32_t column = 0, row = 0;
  std::int64_t stamp_ns = 0;
  std::uint64_t scans = 0;
  std::uint64_t last_call = 0;  // that wrote to it
  std::uint32_t things = 0;     // cells that are one
  CellBox stale;                // in cells of map: distances to be renewed

  CellBox box() const {
    const std::int32_t x = column * kTileSide, y = row * kTileSide;
    return {x, y, x + kTileSide - 1, y + kTileSide - 1};
  }
};

class TileTable {
 public:
  void lay_out(Arena& arena, std::uint32_t tiles, bool with_distances);
  void clear();

  std::uint32_t count() const { return count_; }
  bool full() const { return count_ == heads_.size(); }
  std::uint32_t capacity() const { return heads_.size(); }

  // kNoTile where there is none.
  std::uint32_t find(std::int32_t column, std::int32_t row) const;
  // A tile of cells never seen, where there is none; the table is not full. Its distances hold garbage.
  std::uint32_t add(std::int32_t column, std::int32_t row);
  // The same in the place of a tile that is forgotten.
  void reuse(std::uint32_t tile, std::int32_t column, std::int32_t row);

  TileHead& head(std::uint32_t tile) const { return heads_[tile]; }
  std::uint8_t* cells(std::uint32_t tile) const { return cells_.data() + std::uint64_t{tile} * kTileCells; }
  // A word a row; bit x is cell x.
  std::uint64_t* things(std::uint32_t tile) const { return things_.data() + std::uint64_t{tile} * kTileSide; }
  // Squares of cells. NULL without distances.
  std::int16_t* squares(std::uint32_t tile) const {
    return squares_.size() != 0 ? squares_.data() + std::uint64_t{tile} * kTileCells : nullptr;
  }

 private:
  std::uint32_t slot_for(std::int32_t column, std::int32_t row) const;
  void take_out(std::uint32_t slot);
  void begin(std::uint32_t tile, std::int32_t column, std::int32_t row);

  Span<TileHead> heads_;
  Span<std::uint32_t> slots_;  // tile index and 1; 0: nothing. A power of two, twice the tiles or more
  Span<std::uint8_t> cells_;
  Span<std::uint64_t> things_;
  Span<std::int16_t> squares_;
  std::uint32_t count_ = 0;
};

}  // namespace pose_wall::planar
