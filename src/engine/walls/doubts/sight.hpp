// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A close look at a chosen plane near the sensor, direction by direction: does every direction toward it answer, and
// from the plane?

#pragma once

#include "base/estimation/plane.hpp"
#include "engine/cloud/direction_grid.hpp"
#include "engine/walls/doubts/sight_lines.hpp"
#include "engine/walls/scene.hpp"

namespace pose_wall {

// Shares of the plane as the sensor sees it, 0..1. One gap of up to a third of it does not count, nor do one or two
// gaps as wide as a road or a door that rays pass.
struct WallSight {
  // No return from the plane, from before or from behind it: pipes before a wall too dark to be seen.
  double silent = 0.0;
  // Silent, or seen through between things on the plane: a row of props or pipes.
  double open = 0.0;
  // Nearly all voxels whose rays pass the plane here lie within this depth behind it. 0: no ray passes.
  double depth_m = 0.0;
  // Too few returns all over it, or too much silence elsewhere, for gaps to be noticed.
  bool dim = false;
};

struct SightScratch {
  DirectionGrid kept_lidar;    // points left after the filters; valid after tell_kept()
  DirectionGrid behind_lidar;  // of these and of returns too far away, those that passed through the plane
  ExpectedReturns expected;
  SeenColumns seen;
  bool kept_is_told = false;

  void lay_out(Arena& arena) {
    kept_lidar.lay_out(arena);
    behind_lidar.lay_out(arena);
  }
};

// Call once a frame before any look_at(): finds the expected returns of all directions.
void learn_directions(const WallScene& scene, SightScratch* scratch);

// Counts the kept points by direction, at the first call after learn_directions(), since few frames need it.
void tell_kept(const WallScene& scene, SightScratch* scratch);

// behind_m: returns this far behind the plane passed through it.
WallSight look_at(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, double behind_m,
                  SightScratch* scratch);

}  // namespace pose_wall
