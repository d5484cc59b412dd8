// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The full fit of a chosen wall: which points are its surface, where it bends, and the plane through it.

#pragma once

#include "walls/fit/strips.hpp"
#include "walls/propose/evidence.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

// The full fit around a hypothesis. Leaves the grid marked with it by the threshold.
WallSurface fit_surface(const WallScene& scene, const Plane& start, WallGrid* grid, WallFitScratch* scratch);

}  // namespace pose_wall
