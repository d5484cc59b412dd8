// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 3: the floor, and with it roll and pitch.

#pragma once

#include "base/math/random.hpp"
#include "engine/floor/result.hpp"
#include "engine/floor/scene.hpp"

namespace pose_wall {

// Looks for the floor within ground_roi_radius. Where that floor is not known well enough to be valid, the radius grows
// in steps up to ground_roi_radius_max.
FloorResult find_floor(const FloorScene& scene, Random* random, FloorScratch* scratch);

}  // namespace pose_wall
