// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Maps as map_server and Nav2 keep them: an image of grey cells (PGM), and a YAML that places it.
//
//     pixel     0 a thing, 254 free, 205 unknown; the image's top row is that of the most y
//     YAML      image, resolution, origin [x, y, yaw], negate, occupied_thresh, free_thresh, mode
//
// A pixel's darkness (1 - pixel / most, or pixel / most where negate is set) is the probability of a thing. Above
// occupied_thresh it is one, below free_thresh the cell is free, and between them unknown (mode trinary, also where
// there is none), or a share of 100 (scale). In mode raw pixels of 0 to 100 are the cells themselves.

#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "pose_wall_planar_grid.h"

namespace pose_wall::tools {

struct MapFile {
  std::uint32_t width = 0, height = 0;
  double resolution_m = 0.0, origin_x_m = 0.0, origin_y_m = 0.0;
  std::vector<std::int8_t> cells;  // row by row from the least y; -1 unknown, 0 to 100
  std::string note;                // what a person should know of the file; empty: nothing

  // As the library takes it; as long as this lives.
  pose_wall_planar_grid grid() const;
};

bool is_inside(const pose_wall_planar_grid& grid, double x_m, double y_m);
// "The map reaches from x ... to ... m and from y ... to ... m."
std::string extent_text(const pose_wall_planar_grid& grid);

// Names file, line and key, and what is allowed.
class MapFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Writes NAME.pgm and NAME.yaml in mode trinary; `yaml` is NAME.yaml. Cells from occupied_per_cent are things, those up
// to free_per_cent free, all others unknown. The thresholds in the file are those that tell 0, 205 and 254 apart.
// Throws std::runtime_error.
void write_map_files(const std::filesystem::path& yaml, const pose_wall_planar_grid& grid, int occupied_per_cent = 65,
                     int free_per_cent = 35);

// Unknown cells that are specks in the open become free: no thing touches them, and five of the eight cells round them
// are free. Returns how many there were.
std::size_t free_specks(MapFile* map);

// PGM of either kind (P5, P2), of 1 or 2 bytes. Throws MapFileError.
//
// Nav2 up to 2025 wrote free_thresh 0.25, by which its own unknown (205) reads as free. Here unknown stays unknown in
// mode trinary, and `note` says so.
MapFile read_map_files(const std::filesystem::path& yaml);

}  // namespace pose_wall::tools
