// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 5: at most one wall on each side.

#pragma once

#include "math/random.hpp"
#include "stages/walls_fit.hpp"
#include "types.hpp"

namespace pose_wall {

struct WallsScratch {
  WallSearch search[2];
  WallGrid grid;
  WallFitScratch fit;

  void lay_out(Arena& arena, std::uint32_t points_max);
};

struct WallsResult {
  WallResult side[2];  // left, right
};

// last: the planes of the last frame by side, or nullptr; scored like any other hypothesis.
WallsResult find_walls(const WallScene& scene, const Plane* const last[2], Random* random, WallsScratch* scratch);

// The scene of a levelled machine: axes, sensor and sampling points turned by R_level.
WallScene wall_scene(const PointSet& band_level, const Settings& settings, const LevelResult& level, const Axes& axes,
                     const Eigen::Vector3d& sensor_base_m);

}  // namespace pose_wall
