// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A close look at a chosen plane near the sensor, direction by direction: does everything answer that the sensor looks
// at there, and from the plane?

#pragma once

#include "containers/direction_grid.hpp"
#include "estimation/plane.hpp"
#include "stages/walls_scene.hpp"

namespace pose_wall {

// Shares of what the sensor sees of the plane, 0..1.
struct WallSight {
  // Nothing comes back, neither from the plane nor from before or behind it: pipes before a wall that is too dark to be
  // seen. One wide gap does not count.
  double silent = 0.0;
  // Silent, or seen through between what lies on the plane: a row of props or pipes. Gaps as wide as a road or a door
  // do not count.
  double open = 0.0;
  double depth_m = 0.0;  // how far behind the plane most rays end that pass it
  // Of its columns: over its top nothing is seen, or something behind it. A wall reaches up to the roof, a curtain, a
  // vehicle or a conveyor does not.
  double topless = 0.0;
  // So few returns all over it that silence would not be noticed.
  bool dim = false;
};

// behind_m: returns this far behind the plane have passed through it. behind_lidar: scratch.
WallSight look_at(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, double behind_m,
                  DirectionGrid* behind_lidar);

}  // namespace pose_wall
