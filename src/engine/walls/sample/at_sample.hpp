// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The wall right at a sampling point: the plane may be right and the wall elsewhere just there.

#pragma once

#include "engine/walls/fit/surface.hpp"
#include "engine/walls/propose/evidence.hpp"
#include "engine/walls/scene.hpp"
#include "engine/walls/wall.hpp"

namespace pose_wall {

struct AtSample {
  double bound_m = 0.0;  // how far the distance may be off: the wall stands out, steps back, or a road branches off
  double hole_m = 0.0;   // length around it without a point on the plane
};

// wall: its plane and direction are set.
AtSample look_at_sample(const WallScene& scene, const WallSurface& surface, const WallGrid& grid,
                        const FittedWall& wall, const Eigen::Vector3d& sample_level_m);

}  // namespace pose_wall
