// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/map/tile_table.hpp"

#include <algorithm>
#include <cstring>

#include "base/math/bits.hpp"
#include "base/math/golden_ratio.hpp"

namespace pose_wall::planar {
namespace {

// Twice the tiles at least, so that a search meets an empty slot soon.
std::uint32_t slots_for(std::uint32_t tiles) {
  return 4U << highest_bit(tiles);
}

std::uint32_t home_of(std::int32_t column, std::int32_t row, std::uint32_t slots) {
  const std::uint64_t key =
      (static_cast<std::uint64_t>(static_cast<std::uint32_t>(column)) << 32) | static_cast<std::uint32_t>(row);
  return static_cast<std::uint32_t>((key * kGoldenTurn64) >> 40) & (slots - 1);
}

}  // namespace

void CellBox::take_in(const CellBox& other) {
  if (other.empty()) return;
  if (empty()) {
    *this = other;
    return;
  }
  *this = {std::min(x0, other.x0), std::min(y0, other.y0), std::max(x1, other.x1), std::max(y1, other.y1)};
}

CellBox CellBox::cut_to(const CellBox& other) const {
  return {std::max(x0, other.x0), std::max(y0, other.y0), std::min(x1, other.x1), std::min(y1, other.y1)};
}

void TileTable::lay_out(Arena& arena, std::uint32_t tiles, bool with_distances) {
  heads_ = arena.take<TileHead>(tiles);
  slots_ = arena.take<std::uint32_t>(slots_for(tiles));
  cells_ = arena.take<std::uint8_t>(tiles * kTileCells);
  things_ = arena.take<std::uint64_t>(tiles * static_cast<std::uint32_t>(kTileSide));
  squares_ = arena.take<std::int16_t>(with_distances ? tiles * kTileCells : 0);
}

void TileTable::clear() {
  count_ = 0;
  slots_.fill(0);
}

std::uint32_t TileTable::slot_for(std::int32_t column, std::int32_t row) const {
  const std::uint32_t mask = slots_.size() - 1;
  std::uint32_t slot = home_of(column, row, slots_.size());
  for (std::uint32_t step = 0; step < slots_.size(); ++step, slot = (slot + 1) & mask) {
    const std::uint32_t entry = slots_[slot];
    if (entry == 0) break;
    const TileHead& head = heads_[entry - 1];
    if (head.column == column && head.row == row) break;
  }
  return slot;
}

std::uint32_t TileTable::find(std::int32_t column, std::int32_t row) const {
  const std::uint32_t entry = slots_[slot_for(column, row)];
  return entry != 0 ? entry - 1 : kNoTile;
}

void TileTable::begin(std::uint32_t tile, std::int32_t column, std::int32_t row) {
  heads_[tile] = TileHead();
  heads_[tile].column = column;
  heads_[tile].row = row;
  std::memset(cells(tile), kNeverSeen, kTileCells);
  std::memset(things(tile), 0, sizeof(std::uint64_t) * kTileSide);
  slots_[slot_for(column, row)] = tile + 1;
}

std::uint32_t TileTable::add(std::int32_t column, std::int32_t row) {
  begin(count_, column, row);
  return count_++;
}

// Entries behind it move up where their search would stop at the gap (Knuth 6.4, algorithm R).
void TileTable::take_out(std::uint32_t slot) {
  const std::uint32_t mask = slots_.size() - 1;
  std::uint32_t gap = slot;
  for (std::uint32_t step = 1; step < slots_.size(); ++step) {
    const std::uint32_t at = (slot + step) & mask;
    if (slots_[at] == 0) break;
    const TileHead& head = heads_[slots_[at] - 1];
    const std::uint32_t home = home_of(head.column, head.row, slots_.size());
    if (((at - home) & mask) < ((at - gap) & mask)) continue;
    slots_[gap] = slots_[at];
    gap = at;
  }
  slots_[gap] = 0;
}

void TileTable::reuse(std::uint32_t tile, std::int32_t column, std::int32_t row) {
  take_out(slot_for(heads_[tile].column, heads_[tile].row));
  begin(tile, column, row);
}

}  // namespace pose_wall::planar
