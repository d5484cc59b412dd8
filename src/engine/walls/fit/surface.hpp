// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The full fit of a chosen wall: the points of its surface, its bends, and the plane through it.

#pragma once

#include "engine/walls/fit/strips.hpp"
#include "engine/walls/propose/evidence.hpp"
#include "engine/walls/scene.hpp"

namespace pose_wall {

// Cuts off the end of a wall that bends towards the machine at its top or foot (an arched roof, pipes, a heap). True if
// it did; then repeat the fit between the remaining heights.
bool cut_bent_rows(const WallSurface& fit, Heights* heights);

// The full fit around a hypothesis. Leaves the grid marked with it at the threshold.
WallSurface fit_surface(const WallScene& scene, const Plane& start, WallGrid* grid, WallFitScratch* scratch);

}  // namespace pose_wall
