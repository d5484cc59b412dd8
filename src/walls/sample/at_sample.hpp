// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What is seen of the wall right at a sampling point: the plane may be right and the wall elsewhere just there.

#pragma once

#include "types.hpp"
#include "walls/fit/surface.hpp"
#include "walls/propose/evidence.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

struct AtSample {
  bool interrupted = false;  // the wall stands out there, steps back, or a road branches off
  double bound_m = 0.0;      // by which the distance may be off for it
  double hole_m = 0.0;       // length around it in which nothing is seen of the plane
};

// wall: its plane and direction are set.
AtSample look_at_sample(const WallScene& scene, const WallSurface& surface, const WallGrid& grid,
                        const WallResult& wall, const Eigen::Vector3d& sample_level_m);

}  // namespace pose_wall
