// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/map/tile_record.hpp"

#include "base/math/crc32.hpp"
#include "part/saved_bytes.hpp"
#include "part/status.hpp"
#include "part/struct_sizes.hpp"
#include "planar/map/grid_map.hpp"

namespace pose_wall::planar {
namespace {

constexpr std::uint64_t kMagic = 0x0A50414D4C505750ULL;  // bytes: "PWPLMAP" and a newline
constexpr std::uint32_t kVersion = 1;                    // of this layout
constexpr std::uint64_t kHeadBytes = 40;                 // magic to the zero behind cell_m
constexpr std::uint64_t kTileBytes = 24 + kTileCells;    // column to the last cell
constexpr std::uint64_t kTailBytes = 8;                  // the sum and a zero

bool fits(std::int32_t column, std::int32_t row, const std::uint8_t* cells, double cell_m) {
  const auto most = static_cast<std::int32_t>(POSE_WALL_PLANAR_MAP_REACH_M * 1.01 / cell_m / kTileSide);  // and beams
  bool inside = column >= -most && column < most && row >= -most && row < most;
  for (std::uint32_t k = 0; k < kTileCells; ++k) inside = inside && cells[k] <= kValueMost;
  return inside;
}

void read_tile(SavedReader* reader, pose_wall_planar_tile* tile) {
  tile->column = reader->get<std::int32_t>();
  tile->row = reader->get<std::int32_t>();
  tile->stamp_ns = reader->get<std::int64_t>();
  tile->scans = reader->get<std::uint64_t>();
  reader->get_bytes(tile->cells, kTileCells);
}

// All but the sum: whole tiles, each further on than the one before it.
bool are_tiles(const unsigned char* bytes, std::uint32_t tiles, double cell_m) {
  std::int32_t row_before = 0, column_before = 0;
  for (std::uint32_t k = 0; k < tiles; ++k) {
    const unsigned char* const at = bytes + kHeadBytes + k * kTileBytes;
    SavedReader reader(at);
    const auto column = reader.get<std::int32_t>(), row = reader.get<std::int32_t>();
    if (!fits(column, row, at + kTileBytes - kTileCells, cell_m)) return false;
    const bool further = row > row_before || (row == row_before && column > column_before);
    if (k != 0 && !further) return false;
    row_before = row;
    column_before = column;
  }
  return true;
}

bool is_whole(const unsigned char* bytes, std::uint64_t size) {
  SavedReader tail(bytes + size - kTailBytes);
  return tail.get<std::uint32_t>() == crc32(bytes, size - kTailBytes) && tail.get<std::uint32_t>() == 0;
}

}  // namespace

std::uint32_t crc_of(const pose_wall_planar_tile& tile) {
  BulkCrc32 crc;
  crc.add_number(static_cast<std::uint32_t>(tile.column), 4);
  crc.add_number(static_cast<std::uint32_t>(tile.row), 4);
  crc.add_number(saved_word(tile.cell_m), 8);
  crc.add_number(static_cast<std::uint64_t>(tile.stamp_ns), 8);
  crc.add_number(tile.scans, 8);
  crc.add(tile.cells, kTileCells);
  return crc.value();
}

std::int32_t check_tile(const pose_wall_planar_tile& tile, double cell_m) {
  if (const std::int32_t size = pose_wall::check_struct(tile); size != POSE_WALL_OK) return size;
  const bool good =
      tile.crc32 == crc_of(tile) && tile.cell_m == cell_m && fits(tile.column, tile.row, tile.cells, cell_m);
  return ok_if(good, POSE_WALL_PLANAR_E_MAP_FILE);
}

std::uint64_t map_bytes(std::uint32_t tiles) {
  return kHeadBytes + tiles * kTileBytes + kTailBytes;
}

void write_map(GridMap* map, unsigned char* bytes) {
  const Span<const std::uint32_t> order = map->in_order();
  const std::uint64_t size = map_bytes(order.size());
  SavedWriter writer(bytes);
  writer.put(kMagic);
  writer.put(kVersion);
  writer.put(order.size());
  writer.put(size);
  writer.put(map->settings().cell_m);
  writer.put(std::uint64_t{0});
  for (const std::uint32_t tile : order) {
    const TileHead& head = map->tiles().head(tile);
    writer.put(head.column);
    writer.put(head.row);
    writer.put(head.stamp_ns);
    writer.put(head.scans);
    writer.put_bytes(map->tiles().cells(tile), kTileCells);
  }
  writer.put(crc32(bytes, size - kTailBytes));
  writer.put(std::uint32_t{0});
}

std::int32_t read_map(GridMap* map, const unsigned char* bytes, std::uint64_t size) {
  if (size < kHeadBytes + kTailBytes) return POSE_WALL_PLANAR_E_MAP_FILE;
  SavedReader reader(bytes);
  const bool known = reader.get<std::uint64_t>() == kMagic && reader.get<std::uint32_t>() == kVersion;
  const auto tiles = reader.get<std::uint32_t>();
  const double cell_m = map->settings().cell_m;
  const bool fitting = reader.get<std::uint64_t>() == size && map_bytes(tiles) == size &&
                       reader.get<double>() == cell_m && reader.get<std::uint64_t>() == 0;
  if (!known || !fitting || !is_whole(bytes, size)) return POSE_WALL_PLANAR_E_MAP_FILE;
  if (tiles > map->tiles().capacity()) return POSE_WALL_E_BUFFER_SMALL;
  if (!are_tiles(bytes, tiles, cell_m)) return POSE_WALL_PLANAR_E_MAP_FILE;
  map->clear();
  pose_wall_planar_tile tile{};
  for (std::uint32_t k = 0; k < tiles; ++k) {
    read_tile(&reader, &tile);
    map->load(tile);
  }
  map->finish_loading();
  return POSE_WALL_OK;
}

}  // namespace pose_wall::planar
