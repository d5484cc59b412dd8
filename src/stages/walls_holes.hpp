// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A close look at a chosen plane near the sensor: is it a wall all over?

#pragma once

#include "estimation/plane.hpp"
#include "stages/walls_scene.hpp"

namespace pose_wall {

// Shares of the plane within a few metres of the sensor, 0..1.
struct WallHoles {
  // The sensor looks there, but nothing comes back, neither from the plane nor from before or behind it: pipes before a
  // wall too dark to be seen.
  double silent = 0.0;
  // Silent, or seen through between what lies on the plane: rows of props or pipes. Openings wide enough to be a road's
  // or a door's do not count.
  double open = 0.0;
  // Share of the plane's length over whose top the sensor sees roof or rock behind it: a wall reaches up to the roof, a
  // curtain, a vehicle or a conveyor does not.
  double overtopped = 0.0;
};

// hit_m: returns this near to the plane are the plane's.
WallHoles find_holes(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level, double hit_m);

}  // namespace pose_wall
