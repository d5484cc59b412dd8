// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Yaw and the distances at the sampling points, from a wall's surface, and their standard deviations.

#pragma once

#include "base/estimation/patch_fit.hpp"
#include "engine/walls/fit/surface.hpp"
#include "engine/walls/wall.hpp"

namespace pose_wall {

// side: 0 left, 1 right. grid: marked with the RANSAC threshold.
// The standard deviations are left to set_sigmas(). errors: gets the surface's.
FittedWall measure_wall(const WallScene& scene, const WallSurface& surface, int side, const WallGrid& grid,
                        PatchErrors* errors);

// Sets the standard deviations, their degrees of freedom and the pivot of each wall that is found, left and right. What
// one wall shows of the rock holds for the other as well if both are accepted. errors: of their surfaces. sigmas: as in
// spread_of_mixture().
void set_sigmas(const PatchErrors (&errors)[2], double sigmas, JudgedWall (*walls)[2]);

}  // namespace pose_wall
