// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Yaw and the distances at the sampling points, from a wall's surface.

#pragma once

#include "engine/walls/fit/surface.hpp"
#include "engine/walls/wall.hpp"

namespace pose_wall {

// side: 0 left, 1 right. grid: marked with the RANSAC threshold.
// The standard deviations are left to set_sigmas(). errors: gets the surface's.
FittedWall measure_wall(const WallScene& scene, const WallSurface& surface, int side, const WallGrid& grid,
                        PatchErrors* errors);

}  // namespace pose_wall
