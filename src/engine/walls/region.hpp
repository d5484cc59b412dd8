// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The wall of the region beside the machine, in place of an endless one (include/DEFINITIONS.md).

#pragma once

#include "engine/walls/scene.hpp"
#include "engine/walls/scratch.hpp"
#include "engine/walls/wall.hpp"

namespace pose_wall {

// Fills in both sides' regions and endless walls. A side becomes its region's wall where that is one: it passes the
// gates of an endless one, answers all over, and the sensor looks neither over nor past it. The endless wall stays
// where it is known better and both agree. Both sides are refused if the budget is spent.
void measure_wall_regions(const WallScene& scene, WallsScratch* scratch, MeasuredWalls* walls);

}  // namespace pose_wall
