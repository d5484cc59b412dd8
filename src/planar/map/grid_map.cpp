// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Tiles, room for them, and what follows when their cells have changed. map_insert.cpp has the beams.

#include "planar/map/grid_map.hpp"

#include <algorithm>
#include <cstring>

#include "base/containers/heap_sort.hpp"
#include "base/math/bits.hpp"
#include "planar/map/tile_record.hpp"

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "cells are read eight at a time, the first as the lowest byte"
#endif

namespace pose_wall::planar {
namespace {

constexpr std::uint64_t kEachByte = 0x0101010101010101ULL;  // one in each of eight cells
// From here on a tile's distances are renewed once, which costs as much as to follow so many things one by one.
constexpr std::uint32_t kManyChanges = 64;

// The top bits of eight bytes as eight bits, the first byte's lowest.
std::uint64_t top_bits(std::uint64_t bytes) {
  constexpr std::uint64_t kGather = 0x0102040810204080ULL;  // moves bit 8 k of the sum to bit 56 + k
  return (((bytes >> 7) & kEachByte) * kGather) >> 56;
}

// Takes the marks of the present scan off a row's cells. Returns which are a thing.
std::uint64_t settle_row(std::uint8_t* cells, std::uint8_t thing_from) {
  const std::uint64_t to_top_bit = kEachByte * static_cast<std::uint64_t>(kTouched - thing_from);
  std::uint64_t things = 0;
  for (std::uint32_t word = 0; word < 8; ++word) {
    std::uint64_t eight;
    std::memcpy(&eight, cells + 8 * word, sizeof(eight));
    eight &= kEachByte * kValueMost;
    std::memcpy(cells + 8 * word, &eight, sizeof(eight));
    things |= top_bits(eight + to_top_bit) << (8 * word);
  }
  return things;
}

std::int64_t squared(std::int64_t a) {
  return a * a;
}

}  // namespace

void GridMap::lay_out(Arena& arena, const pose_wall_planar_map_settings& settings) {
  const bool with_distances = settings.distance_cap_m > 0.0;
  tiles_.lay_out(arena, settings.tiles, with_distances);
  distances_.lay_out(arena, with_distances);
  beams_ = arena.take<Beam>(POSE_WALL_PLANAR_BEAMS_MAX);
  free_ = arena.take<float>(POSE_WALL_PLANAR_BEAMS_MAX);
  unstored_ = arena.take<std::uint8_t>(POSE_WALL_PLANAR_BEAMS_MAX);
  touched_ = arena.take<std::uint32_t>(settings.tiles);
  order_ = arena.take<std::uint32_t>(settings.tiles);
  nowhere_ = arena.take<std::uint8_t>(kTileCells);
  record_ = arena.take_one<pose_wall_planar_tile>();
  arriving_ = arena.take_one<pose_wall_planar_tile>();
}

void GridMap::open(const pose_wall_planar_map_settings& settings) {
  settings_ = settings;
  model_ = CellModel(settings);
  distances_.open(&tiles_, static_cast<std::int32_t>(std::floor(settings.distance_cap_m / settings.cell_m + 1e-9)));
  nowhere_.fill(kNeverSeen);
  clear();
}

void GridMap::clear() {
  tiles_.clear();
  call_ = 0;
  touched_count_ = 0;
  cursor_ = Cursor();
  sensor_ = MapPlace();
}

std::uint8_t GridMap::value_at(std::int32_t x, std::int32_t y) const {
  const std::uint32_t tile = tiles_.find(tile_of(x), tile_of(y));
  return tile != kNoTile ? tiles_.cells(tile)[inside_tile(y) * kTileSide + inside_tile(x)] : kNeverSeen;
}

// Never one that this call wrote to: those of its cells that are still marked must not be saved.
std::uint32_t GridMap::tile_to_give() const {
  const std::int64_t sensor_x = 2 * static_cast<std::int64_t>(sensor_.cell_x());
  const std::int64_t sensor_y = 2 * static_cast<std::int64_t>(sensor_.cell_y());
  std::uint32_t chosen = kNoTile;
  std::int64_t farthest = -1;
  for (std::uint32_t tile = 0; tile < tiles_.count(); ++tile) {
    const TileHead& head = tiles_.head(tile);
    if (head.last_call == call_) continue;
    if (settings_.eviction == POSE_WALL_PLANAR_FARTHEST) {
      const CellBox box = head.box();
      const std::int64_t away = squared(box.x0 + box.x1 - sensor_x) + squared(box.y0 + box.y1 - sensor_y);
      if (away > farthest) chosen = tile;
      farthest = std::max(farthest, away);
    } else if (chosen == kNoTile || head.last_call < tiles_.head(chosen).last_call ||
               (head.last_call == tiles_.head(chosen).last_call && head.stamp_ns < tiles_.head(chosen).stamp_ns)) {
      chosen = tile;
    }
  }
  return chosen;
}

bool GridMap::give(std::uint32_t tile) {
  if (save == nullptr) return false;
  copy_out(tile, record_);
  return save(save_context, record_) == 0;
}

std::uint32_t GridMap::tile_for_writing(std::int32_t column, std::int32_t row, MapWork* work) {
  std::uint32_t tile = tiles_.find(column, row);
  if (tile == kNoTile) {
    if (work->refused) return kNoTile;
    if (!tiles_.full()) {
      tile = tiles_.add(column, row);
    } else {
      tile = tile_to_give();
      work->refused = tile == kNoTile || !give(tile);
      if (work->refused) return kNoTile;
      distances_.tile_goes(tile);
      tiles_.reuse(tile, column, row);
      ++work->tiles_saved;
    }
    distances_.tile_came(tile);
    ++work->tiles_new;
  }
  TileHead& head = tiles_.head(tile);
  if (head.last_call != call_) touched_[touched_count_++] = tile;
  head.last_call = call_;
  return tile;
}

void GridMap::read_things(std::uint32_t tile) {
  std::uint64_t* const things = tiles_.things(tile);
  std::uint32_t count = 0;
  for (std::int32_t y = 0; y < kTileSide; ++y) {
    things[y] = settle_row(tiles_.cells(tile) + y * kTileSide, model_.thing_from);
    count += static_cast<std::uint32_t>(bits_in(things[y]));
  }
  tiles_.head(tile).things = count;
}

// The work of a few changes, one by one, is bounded by that of many.
void GridMap::tell_changes(std::uint32_t tile, const std::uint64_t* before, MapWork* work) {
  const std::uint64_t* const things = tiles_.things(tile);
  const CellBox whole = tiles_.head(tile).box();
  std::uint32_t changes = 0;
  for (std::int32_t y = 0; y < kTileSide; ++y) {
    work->things_new += static_cast<std::uint32_t>(bits_in(things[y] & ~before[y]));
    work->things_gone += static_cast<std::uint32_t>(bits_in(before[y] & ~things[y]));
    changes += static_cast<std::uint32_t>(bits_in(before[y] ^ things[y]));
  }
  if (changes > kManyChanges) distances_.things_changed(whole);
  if (changes > kManyChanges || changes == 0) return;
  for (std::int32_t y = 0; y < kTileSide; ++y) {
    for (std::uint64_t changed = before[y] ^ things[y]; changed != 0; changed &= changed - 1) {
      const auto x = static_cast<std::int32_t>(highest_bit(changed & (~changed + 1)));
      const bool came = (things[y] >> x & 1U) != 0;
      if (came) distances_.thing_came(whole.x0 + x, whole.y0 + y);
      if (!came) distances_.thing_went(whole.x0 + x, whole.y0 + y);
    }
  }
}

void GridMap::settle_tile(std::uint32_t tile, MapWork* work) {
  std::uint64_t before[kTileSide];
  std::memcpy(before, tiles_.things(tile), sizeof(before));
  read_things(tile);
  tell_changes(tile, before, work);
}

void GridMap::settle(MapWork* work) {
  for (std::uint32_t k = 0; k < touched_count_; ++k) settle_tile(touched_[k], work);
  touched_count_ = 0;
  cursor_ = Cursor();
  renew(settings_.renewals);
}

void GridMap::add_cells(std::uint32_t tile, const pose_wall_planar_tile& record) {
  std::uint8_t* const cells = tiles_.cells(tile);
  for (std::uint32_t k = 0; k < kTileCells; ++k) cells[k] = sum_of(model_, cells[k], record.cells[k]);
  TileHead& head = tiles_.head(tile);
  head.stamp_ns = head.scans != 0 ? std::max(head.stamp_ns, record.stamp_ns) : record.stamp_ns;
  head.scans += record.scans;
}

// Copied first: the callback that makes room may well move its own tiles, of which this can be one.
bool GridMap::put(const pose_wall_planar_tile& tile) {
  ++call_;
  MapWork work;
  *arriving_ = tile;
  const std::uint32_t place = tile_for_writing(arriving_->column, arriving_->row, &work);
  if (place != kNoTile) add_cells(place, *arriving_);
  settle(&work);
  return place != kNoTile;
}

void GridMap::load(const pose_wall_planar_tile& tile) {
  add_cells(tiles_.add(tile.column, tile.row), tile);
}

void GridMap::finish_loading() {
  for (std::uint32_t tile = 0; tile < tiles_.count(); ++tile) read_things(tile);
  for (std::uint32_t tile = 0; tile < tiles_.count(); ++tile) distances_.tile_came(tile);
  renew(tiles_.count());
}

void GridMap::copy_out(std::uint32_t tile, pose_wall_planar_tile* record) const {
  const TileHead& head = tiles_.head(tile);
  record->struct_size = sizeof(*record);
  record->column = head.column;
  record->row = head.row;
  record->cell_m = settings_.cell_m;
  record->stamp_ns = head.stamp_ns;
  record->scans = head.scans;
  std::memcpy(record->cells, tiles_.cells(tile), kTileCells);
  record->crc32 = crc_of(*record);
}

Span<const std::uint32_t> GridMap::in_order() {
  for (std::uint32_t tile = 0; tile < tiles_.count(); ++tile) order_[tile] = tile;
  heap_sort(order_.begin(), order_.begin() + tiles_.count(), [this](std::uint32_t a, std::uint32_t b) {
    const TileHead &one = tiles_.head(a), &other = tiles_.head(b);
    return one.row != other.row ? one.row < other.row : one.column < other.column;
  });
  return order_.first(tiles_.count());
}

}  // namespace pose_wall::planar
