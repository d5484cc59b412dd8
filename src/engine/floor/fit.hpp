// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Fits the chosen floor: selects points again by height over it, then Tukey, then patches, then the errors of roll and
// pitch.

#pragma once

#include "engine/floor/result.hpp"
#include "engine/floor/scene.hpp"

namespace pose_wall {

// A radius, the open points, and those within the radius. The fit selects by where the rays meet the floor, so it needs
// all open points. Inliers are counted among those within. The fit takes an even share of open_most open points, and of
// half as many that lie on the floor.
struct FloorLook {
  double radius_m;
  const PointSet &open_base, &within_base;
  std::uint32_t open_most = 4 * kFloorFitPoints;
};

// start: the chosen hypothesis.
FloorResult fit_floor(const FloorScene& scene, const FloorLook& look, const Plane& start, FloorScratch* scratch);

}  // namespace pose_wall
