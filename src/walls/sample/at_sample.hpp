// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What is seen of the wall right at a sampling point: the plane may be right and the wall elsewhere just there.

#pragma once

#include "walls/fit/surface.hpp"
#include "walls/propose/evidence.hpp"
#include "walls/scene.hpp"
#include "walls/wall.hpp"

namespace pose_wall {

struct AtSample {
  double bound_m = 0.0;  // the distance may be so far off: the wall stands out, steps back, or a road branches off
  double hole_m = 0.0;   // length around it in which nothing is seen of the plane
};

// wall: its plane and direction are set.
AtSample look_at_sample(const WallScene& scene, const WallSurface& surface, const WallGrid& grid,
                        const FittedWall& wall, const Eigen::Vector3d& sample_level_m);

}  // namespace pose_wall
