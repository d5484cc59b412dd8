// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Tiles and whole maps as they are saved. Every number is written low byte first, whatever the host.
//
//     map:   magic (8 bytes), version, tiles, bytes in all (8), cell_m as bits of a double (8), 0 (8), tiles, CRC-32
//            of everything before it, 0. Words of four bytes where nothing is said.
//     tile:  column, row, stamp_ns (8), scans (8), 4,096 cells. By rows, then columns.

#pragma once

#include <cstdint>

#include "pose_wall_planar_map.h"

namespace pose_wall::planar {

class GridMap;

// Of all of a record but struct_size and the sum itself.
std::uint32_t crc_of(const pose_wall_planar_tile& tile);

// POSE_WALL_OK, POSE_WALL_E_STRUCT_SIZE or POSE_WALL_PLANAR_E_MAP_FILE.
std::int32_t check_tile(const pose_wall_planar_tile& tile, double cell_m);

std::uint64_t map_bytes(std::uint32_t tiles);
// `bytes` has room for map_bytes().
void write_map(GridMap* map, unsigned char* bytes);
// POSE_WALL_OK, POSE_WALL_PLANAR_E_MAP_FILE or POSE_WALL_E_BUFFER_SMALL; the map is unchanged unless POSE_WALL_OK.
std::int32_t read_map(GridMap* map, const unsigned char* bytes, std::uint64_t size);

}  // namespace pose_wall::planar
