// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The full fit of a chosen wall: which points are its surface, where it bends, and the plane through it.

#pragma once

#include "walls/fit/strips.hpp"
#include "walls/propose/evidence.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

// Where the wall bends towards the machine at its top or its foot (an arched roof, pipes, a heap), that end is cut off.
// True where it was, and the fit is to be repeated between what is left of the heights.
bool cut_bent_rows(const WallSurface& fit, Heights* heights);

// The full fit around a hypothesis. Leaves the grid marked with it by the threshold.
WallSurface fit_surface(const WallScene& scene, const Plane& start, WallGrid* grid, WallFitScratch* scratch);

}  // namespace pose_wall
