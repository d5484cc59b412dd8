// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/map/distance_field.hpp"

#include <algorithm>
#include <cstring>

#include "base/math/bits.hpp"

namespace pose_wall::planar {
namespace {

// Offsets of the table: a thing and a cell lie a tile and a cap apart at most.
constexpr std::int32_t kOffsetMost = DistanceField::kCapMost + kTileSide;

// Of a word that is not zero.
std::int32_t lowest_bit(std::uint64_t word) {
  return static_cast<std::int32_t>(highest_bit(word & (~word + 1)));
}

// All tiles that a box touches, by rows, then columns.
template <typename Use>
void each_tile(const TileTable& tiles, const CellBox& box, const Use& use) {
  for (std::int32_t row = tile_of(box.y0); row <= tile_of(box.y1); ++row) {
    for (std::int32_t column = tile_of(box.x0); column <= tile_of(box.x1); ++column) {
      const std::uint32_t tile = tiles.find(column, row);
      if (tile != kNoTile) use(tile);
    }
  }
}

}  // namespace

void DistanceField::lay_out(Arena& arena, bool with_distances) {
  const std::uint32_t one = with_distances ? 1 : 0;
  by_offset_ = arena.take<std::int16_t>(one * (2 * static_cast<std::uint32_t>(kOffsetMost) + 1));
  since_ = arena.take<std::uint8_t>(one * kWide);
  in_column_ = arena.take<std::uint8_t>(one * kWide * static_cast<std::uint32_t>(kTileSide));
  row_squares_ = arena.take<std::int16_t>(one * kWide);
}

void DistanceField::open(TileTable* tiles, std::int32_t cap) {
  tiles_ = tiles;
  cap_ = cap;
  if (!kept()) return;
  for (std::int32_t k = -kOffsetMost; k <= kOffsetMost; ++k) {
    const std::int32_t square = std::min<std::int32_t>(k * k, kFarSquare);
    by_offset_[static_cast<std::uint32_t>(k + kOffsetMost)] = static_cast<std::int16_t>(square);
  }
}

// The part of a box that lies in a tile, in squares of distance from a thing.
void DistanceField::lower_in_tile(std::uint32_t tile, const CellBox& box, std::int32_t x, std::int32_t y) const {
  const CellBox whole = tiles_->head(tile).box(), part = box.cut_to(whole);
  const std::int16_t* const across = by_offset_.data() + kOffsetMost + (part.x0 - x);
  const std::int32_t cells = part.x1 - part.x0 + 1;
  for (std::int32_t row = part.y0; row <= part.y1; ++row) {
    const auto up = static_cast<std::int16_t>((row - y) * (row - y));
    std::int16_t* const at = tiles_->squares(tile) + (row - whole.y0) * kTileSide + (part.x0 - whole.x0);
    for (std::int32_t k = 0; k < cells; ++k) {
      const auto square = static_cast<std::int16_t>(across[k] + up);
      at[k] = square < at[k] ? square : at[k];
    }
  }
}

void DistanceField::thing_came(std::int32_t x, std::int32_t y) {
  if (!kept()) return;
  const CellBox box = CellBox{x, y, x, y}.widened(cap_);
  each_tile(*tiles_, box, [&](std::uint32_t tile) { lower_in_tile(tile, box, x, y); });
}

// The box about those cells that have this thing as their nearest, or one as near.
CellBox DistanceField::nearest_to(std::uint32_t tile, const CellBox& box, std::int32_t x, std::int32_t y) const {
  const CellBox whole = tiles_->head(tile).box(), part = box.cut_to(whole);
  const std::int16_t* const across = by_offset_.data() + kOffsetMost + (part.x0 - x);
  const std::int32_t cells = part.x1 - part.x0 + 1;
  CellBox found;
  for (std::int32_t row = part.y0; row <= part.y1; ++row) {
    const auto up = static_cast<std::int16_t>((row - y) * (row - y));
    const std::int16_t* const at = tiles_->squares(tile) + (row - whole.y0) * kTileSide + (part.x0 - whole.x0);
    std::uint16_t any = 0;
    for (std::int32_t k = 0; k < cells; ++k) {
      any = static_cast<std::uint16_t>(any | (at[k] == static_cast<std::int16_t>(across[k] + up) ? 1U : 0U));
    }
    if (any == 0) continue;
    for (std::int32_t k = 0; k < cells; ++k) {
      if (at[k] == across[k] + up) found.take_in({part.x0 + k, row, part.x0 + k, row});
    }
  }
  return found;
}

void DistanceField::thing_went(std::int32_t x, std::int32_t y) {
  if (!kept()) return;
  const CellBox box = CellBox{x, y, x, y}.widened(cap_);
  each_tile(*tiles_, box, [&](std::uint32_t tile) {
    const CellBox nearest = nearest_to(tile, box, x, y);
    tiles_->head(tile).stale.take_in(nearest);
  });
}

void DistanceField::mark(const CellBox& box) {
  each_tile(*tiles_, box, [&](std::uint32_t tile) {
    TileHead& head = tiles_->head(tile);
    head.stale.take_in(box.cut_to(head.box()));
  });
}

void DistanceField::things_changed(const CellBox& box) {
  if (kept()) mark(box.widened(cap_));
}

bool DistanceField::has_things(const CellBox& box) const {
  std::uint64_t things = 0;
  each_tile(*tiles_, box, [&](std::uint32_t tile) { things += tiles_->head(tile).things; });
  return things != 0;
}

void DistanceField::tile_came(std::uint32_t tile) {
  if (!kept()) return;
  std::int16_t* const squares = tiles_->squares(tile);
  std::fill(squares, squares + kTileCells, static_cast<std::int16_t>(cap_ * cap_));
  TileHead& head = tiles_->head(tile);
  head.stale = has_things(head.box().widened(cap_)) ? head.box() : CellBox();
}

void DistanceField::tile_goes(std::uint32_t tile) {
  if (kept() && tiles_->head(tile).things != 0) mark(tiles_->head(tile).box().widened(cap_));
}

std::uint32_t DistanceField::stale_tiles() const {
  std::uint32_t stale = 0;
  for (std::uint32_t tile = 0; tile < tiles_->count(); ++tile) stale += tiles_->head(tile).stale.empty() ? 0U : 1U;
  return stale;
}

std::uint32_t DistanceField::renew(std::uint32_t most, std::uint64_t call) {
  std::uint32_t waiting = stale_tiles();
  for (const bool of_this_call : {true, false}) {
    for (std::uint32_t tile = 0; tile < tiles_->count() && waiting != 0 && most != 0; ++tile) {
      const TileHead& head = tiles_->head(tile);
      if (head.stale.empty() || (head.last_call == call) != of_this_call) continue;
      renew_tile(tile);
      --waiting;
      --most;
    }
  }
  return waiting;
}

// A thing further off than the cap does not count, so only tiles within it are read. First the distance within each
// column, down and up; then the least of column squares and squares across (Meijster, Roerdink, Hesselink 2000).
void DistanceField::renew_tile(std::uint32_t tile) {
  TileHead& head = tiles_->head(tile);
  const CellBox box = head.stale, reach = box.widened(cap_);
  head.stale = CellBox();
  if (!has_things(reach)) {
    for (std::int32_t y = box.y0; y <= box.y1; ++y) {
      std::int16_t* const row = tiles_->squares(tile) + inside_tile(y) * kTileSide;
      std::fill(row + inside_tile(box.x0), row + inside_tile(box.x1) + 1, static_cast<std::int16_t>(cap_ * cap_));
    }
    return;
  }
  const std::int32_t column_first = tile_of(reach.x0);
  const auto words = static_cast<std::uint32_t>(tile_of(reach.x1) - column_first + 1);
  columns_below(box, column_first, words);
  columns_above(box, column_first, words);
  rows_of(tile, box, column_first, words);
}

// Moves `since_` on to row y.
void DistanceField::next_row(std::int32_t column_first, std::uint32_t words, std::int32_t y) {
  const auto most = static_cast<std::uint8_t>(cap_ + 1);
  std::uint8_t* const since = since_.data();
  for (std::uint32_t k = 0; k < words * static_cast<std::uint32_t>(kTileSide); ++k) {
    since[k] = since[k] < most ? static_cast<std::uint8_t>(since[k] + 1) : most;
  }
  for (std::uint32_t w = 0; w < words; ++w) {
    const std::uint32_t tile = tiles_->find(column_first + static_cast<std::int32_t>(w), tile_of(y));
    if (tile == kNoTile) continue;
    std::uint64_t bits = tiles_->things(tile)[inside_tile(y)];
    for (; bits != 0; bits &= bits - 1)
      since[w * static_cast<std::uint32_t>(kTileSide) + static_cast<std::uint32_t>(lowest_bit(bits))] = 0;
  }
}

void DistanceField::columns_below(const CellBox& box, std::int32_t column_first, std::uint32_t words) {
  since_.fill(static_cast<std::uint8_t>(cap_ + 1));
  for (std::int32_t y = box.y0 - cap_; y <= box.y1; ++y) {
    next_row(column_first, words, y);
    if (y < box.y0) continue;
    std::memcpy(in_column_.data() + static_cast<std::uint32_t>(inside_tile(y)) * kWide, since_.data(), kWide);
  }
}

void DistanceField::columns_above(const CellBox& box, std::int32_t column_first, std::uint32_t words) {
  since_.fill(static_cast<std::uint8_t>(cap_ + 1));
  for (std::int32_t y = box.y1 + cap_; y >= box.y0; --y) {
    next_row(column_first, words, y);
    if (y > box.y1) continue;
    std::uint8_t* const in_column = in_column_.data() + static_cast<std::uint32_t>(inside_tile(y)) * kWide;
    for (std::uint32_t k = 0; k < kWide; ++k) in_column[k] = std::min(in_column[k], since_[k]);
  }
}

void DistanceField::rows_of(std::uint32_t tile, const CellBox& box, std::int32_t column_first, std::uint32_t words) {
  const std::int32_t x_first = column_first * kTileSide, cells = box.x1 - box.x0 + 1;
  const auto cap_square = static_cast<std::int16_t>(cap_ * cap_);
  const std::int16_t* const by_offset = by_offset_.data() + kOffsetMost;
  for (std::int32_t y = box.y0; y <= box.y1; ++y) {
    const std::uint8_t* const in_column = in_column_.data() + static_cast<std::uint32_t>(inside_tile(y)) * kWide;
    for (std::uint32_t k = 0; k < words * static_cast<std::uint32_t>(kTileSide); ++k) {
      const auto square = static_cast<std::int16_t>(in_column[k] * in_column[k]);
      row_squares_[k] = in_column[k] <= cap_ ? square : kFarSquare;
    }
    std::int16_t* const out = tiles_->squares(tile) + inside_tile(y) * kTileSide + inside_tile(box.x0);
    std::fill(out, out + cells, cap_square);
    for (std::int32_t offset = -cap_; offset <= cap_; ++offset) {
      const std::int16_t* const from = row_squares_.data() + (box.x0 + offset - x_first);
      const std::int16_t across = by_offset[offset];
      for (std::int32_t k = 0; k < cells; ++k) {
        const auto square = static_cast<std::int16_t>(from[k] + across);
        out[k] = square < out[k] ? square : out[k];
      }
    }
  }
}

// The nearest thing of a row, in cells across; more than `within` where there is none.
std::int32_t DistanceField::search_row(std::int32_t x, std::int32_t y, std::int32_t within) const {
  std::int32_t nearest = within + 1;
  for (std::int32_t column = tile_of(x - within); column <= tile_of(x + within); ++column) {
    const std::uint32_t tile = tiles_->find(column, tile_of(y));
    if (tile == kNoTile) continue;
    const std::uint64_t bits = tiles_->things(tile)[inside_tile(y)];
    const std::int32_t at = x - column * kTileSide;  // of the cell, in this word
    const std::uint64_t right = at <= 0 ? bits : at >= kTileSide ? 0 : bits & (~std::uint64_t{0} << at);
    const std::uint64_t left = bits & ~right;
    if (right != 0) nearest = std::min(nearest, lowest_bit(right) - at);
    if (left != 0) nearest = std::min(nearest, at - static_cast<std::int32_t>(highest_bit(left)));
  }
  return nearest;
}

std::int32_t DistanceField::search(std::int32_t x, std::int32_t y) const {
  std::int32_t best = cap_ * cap_, within = cap_;
  for (std::int32_t up = 0; up <= cap_ && up * up < best; ++up) {
    for (const std::int32_t row : {y + up, y - up}) {
      const std::int32_t across = search_row(x, row, within);
      if (across > within) continue;
      best = std::min(best, across * across + up * up);
    }
    while (within > 0 && (within - 1) * (within - 1) >= best) --within;
  }
  return best;
}

std::int32_t DistanceField::square_at(std::int32_t x, std::int32_t y) const {
  const std::uint32_t tile = tiles_->find(tile_of(x), tile_of(y));
  if (tile == kNoTile || tiles_->head(tile).stale.holds(x, y)) return search(x, y);
  return tiles_->squares(tile)[inside_tile(y) * kTileSide + inside_tile(x)];
}

}  // namespace pose_wall::planar
