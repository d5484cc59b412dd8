// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/map/tile_record.hpp"

#include <cstring>

#include "base/math/crc32.hpp"
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

class Writer {
 public:
  explicit Writer(unsigned char* to) : to_(to) {}
  template <typename Number>
  void add(Number number) {
    auto word = static_cast<std::uint64_t>(number);
    for (std::size_t k = 0; k < sizeof(Number); ++k, word >>= 8) *to_++ = static_cast<unsigned char>(word & 0xFFU);
  }
  void add_cells(const std::uint8_t* cells) {
    std::memcpy(to_, cells, kTileCells);
    to_ += kTileCells;
  }

 private:
  unsigned char* to_;
};

class Reader {
 public:
  explicit Reader(const unsigned char* from) : from_(from) {}
  template <typename Number>
  Number get() {
    std::uint64_t word = 0;
    for (std::size_t k = 0; k < sizeof(Number); ++k) word |= static_cast<std::uint64_t>(*from_++) << (8 * k);
    return static_cast<Number>(word);
  }
  void get(std::uint8_t* cells) {
    std::memcpy(cells, from_, kTileCells);
    from_ += kTileCells;
  }

 private:
  const unsigned char* from_;
};

std::uint64_t bits_of(double value) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

bool fits(std::int32_t column, std::int32_t row, const std::uint8_t* cells, double cell_m) {
  const auto most = static_cast<std::int32_t>(POSE_WALL_PLANAR_MAP_REACH_M * 1.01 / cell_m / kTileSide);  // and beams
  bool inside = column >= -most && column < most && row >= -most && row < most;
  for (std::uint32_t k = 0; k < kTileCells; ++k) inside = inside && cells[k] <= kValueMost;
  return inside;
}

void read_tile(Reader* reader, pose_wall_planar_tile* tile) {
  tile->column = reader->get<std::int32_t>();
  tile->row = reader->get<std::int32_t>();
  tile->stamp_ns = reader->get<std::int64_t>();
  tile->scans = reader->get<std::uint64_t>();
  reader->get(tile->cells);
}

// All but the sum: whole tiles, each further on than the one before it.
bool are_tiles(const unsigned char* bytes, std::uint32_t tiles, double cell_m) {
  std::int32_t row_before = 0, column_before = 0;
  for (std::uint32_t k = 0; k < tiles; ++k) {
    const unsigned char* const at = bytes + kHeadBytes + k * kTileBytes;
    Reader reader(at);
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
  Reader tail(bytes + size - kTailBytes);
  BulkCrc32 crc;
  crc.add(bytes, size - kTailBytes);
  return tail.get<std::uint32_t>() == crc.value() && tail.get<std::uint32_t>() == 0;
}

}  // namespace

std::uint32_t crc_of(const pose_wall_planar_tile& tile) {
  BulkCrc32 crc;
  crc.add_number(static_cast<std::uint32_t>(tile.column), 4);
  crc.add_number(static_cast<std::uint32_t>(tile.row), 4);
  crc.add_number(bits_of(tile.cell_m), 8);
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
  Writer writer(bytes);
  writer.add(kMagic);
  writer.add(kVersion);
  writer.add(order.size());
  writer.add(size);
  writer.add(bits_of(map->settings().cell_m));
  writer.add(std::uint64_t{0});
  for (const std::uint32_t tile : order) {
    const TileHead& head = map->tiles().head(tile);
    writer.add(head.column);
    writer.add(head.row);
    writer.add(head.stamp_ns);
    writer.add(head.scans);
    writer.add_cells(map->tiles().cells(tile));
  }
  BulkCrc32 crc;
  crc.add(bytes, size - kTailBytes);
  writer.add(crc.value());
  writer.add(std::uint32_t{0});
}

std::int32_t read_map(GridMap* map, const unsigned char* bytes, std::uint64_t size) {
  if (size < kHeadBytes + kTailBytes) return POSE_WALL_PLANAR_E_MAP_FILE;
  Reader reader(bytes);
  const bool known = reader.get<std::uint64_t>() == kMagic && reader.get<std::uint32_t>() == kVersion;
  const auto tiles = reader.get<std::uint32_t>();
  const double cell_m = map->settings().cell_m;
  const bool fitting = reader.get<std::uint64_t>() == size && map_bytes(tiles) == size &&
                       reader.get<std::uint64_t>() == bits_of(cell_m) && reader.get<std::uint64_t>() == 0;
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
