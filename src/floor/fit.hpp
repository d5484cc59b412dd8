// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The chosen floor, refined: second selection by height over it, Tukey, patches, and what that says of roll and pitch.

#pragma once

#include "floor/result.hpp"
#include "floor/scene.hpp"

namespace pose_wall {

// A radius, the open points, and those of them within it. The fit goes by where the rays meet the floor, and so chooses
// among all that are open; its inliers are counted of those within. It takes an even share of so many open points, and
// of half as many that lie on the floor.
struct FloorLook {
  double radius_m;
  const PointSet &open_base, &within_base;
  std::uint32_t open_most = 4 * kFloorFitPoints;
};

// start: the chosen hypothesis.
FloorResult fit_floor(const FloorScene& scene, const FloorLook& look, const Plane& start, FloorScratch* scratch);

}  // namespace pose_wall
