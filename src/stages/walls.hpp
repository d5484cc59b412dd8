// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 5: at most one wall on each side.

#pragma once

#include "math/random.hpp"
#include "stages/walls_edges.hpp"
#include "stages/walls_search.hpp"
#include "stages/walls_sight.hpp"
#include "stages/walls_surface.hpp"
#include "types.hpp"

namespace pose_wall {

struct WallsScratch {
  WallSearch search[2];
  WallGrid grid;
  WallFitScratch fit;
  SightScratch sight;
  EdgeScratch edges;

  void lay_out(Arena& arena, std::uint32_t points_max);
};

struct WallsResult {
  WallResult side[2];  // left, right
  // The level itself is off by about this much about the road, by what both sides say; 0 unless they are sure.
  double common_lean_rad = 0.0;
};

// last: the planes of the last frame by side, or nullptr; scored like any other hypothesis.
WallsResult find_walls(const WallScene& scene, const Plane* const last[2], Random* random, WallsScratch* scratch);

}  // namespace pose_wall
