// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The map of scans whose poses are final.

#pragma once

#include <cstdint>
#include <vector>

#include "io/planar_files/map_files.hpp"
#include "study/planar/scan_trail.hpp"

namespace pose_wall::tools {

struct BuiltMap {
  MapFile map;  // without a note
  std::uint64_t cells_seen = 0, things = 0;
  std::uint64_t beams_not_stored = 0;  // the map had no tile for them: its file is not whole
  std::uint64_t block_bytes = 0;
};

// poses: of base at each of the scans. Throws PlanarError for cells so small that the map is wider than
// POSE_WALL_PLANAR_GRID_SIDE_MAX of them.
BuiltMap build_map(const std::vector<KeptScan>& scans, const std::vector<pose_wall_planar_pose>& poses, double cell_m);

}  // namespace pose_wall::tools
