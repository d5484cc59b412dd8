// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The floor of the region below the machine, in place of an endless one (include/DEFINITIONS.md).

#pragma once

#include "engine/floor/result.hpp"
#include "engine/floor/scene.hpp"

namespace pose_wall {

// Takes roll and pitch from the plane of the region, where that is known better, is seen ahead and behind, and is the
// same surface at the machine. Else the floor stays as it is. Refused if the budget is
// spent.
void measure_floor_region(const FloorScene& scene, FloorScratch* scratch, FloorResult* floor);

}  // namespace pose_wall
