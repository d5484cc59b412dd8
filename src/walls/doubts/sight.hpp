// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A close look at a chosen plane near the sensor, direction by direction: does everything answer that the sensor looks
// at there, and from the plane?

#pragma once

#include "base/estimation/plane.hpp"
#include "cloud/direction_grid.hpp"
#include "walls/doubts/sight_lines.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

// Shares of what the sensor sees of the plane, 0..1. One gap that is no wider than a third of it does not count, nor do
// one or two that are seen through and as wide as a road or a door.
struct WallSight {
  // Nothing comes back, neither from the plane nor from before or behind it: pipes before a wall that is too dark to be
  // seen.
  double silent = 0.0;
  // Silent, or seen through between what lies on the plane: a row of props or pipes.
  double open = 0.0;
  // Nearly all voxels whose rays pass the plane here lie no deeper behind it. 0: none do.
  double depth_m = 0.0;
  // Of its columns: over its top nothing is seen, or something behind it. A wall reaches up to the roof, a curtain, a
  // vehicle or a conveyor does not.
  double topless = 0.0;
  // So few returns all over it, or so much silence elsewhere too, that gaps would not be noticed.
  bool dim = false;
};

struct SightScratch {
  DirectionGrid kept_lidar;    // points that are left after the filters; once tell_kept() was called
  DirectionGrid behind_lidar;  // of these and of what is too far, what has passed through the plane
  ExpectedReturns expected;
  SeenColumns seen;
  bool kept_is_told = false;

  void lay_out(Arena& arena) {
    kept_lidar.lay_out(arena);
    behind_lidar.lay_out(arena);
  }
};

// Once a frame, before any plane is looked at: tells what is to be expected of directions.
void learn_directions(const WallScene& scene, SightScratch* scratch);

// What was kept by direction, at the first call after learn_directions(): few frames ask for it.
void tell_kept(const WallScene& scene, SightScratch* scratch);

// behind_m: returns this far behind the plane have passed through it.
WallSight look_at(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, double behind_m,
                  SightScratch* scratch);

}  // namespace pose_wall
