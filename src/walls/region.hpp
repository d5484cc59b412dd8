// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The wall of the region beside the machine, in place of an endless one (include/DEFINITIONS.md).

#pragma once

#include "walls/scene.hpp"
#include "walls/scratch.hpp"
#include "walls/wall.hpp"

namespace pose_wall {

// Takes yaw and distances of each wall from the plane of its region, where that shows a wall: it passes the gates of an
// endless one, answers all over, and the sensor looks neither over nor past it. Else the wall stays as it is, also
// where its distances are known better. Both sides are refused if the budget is spent.
void measure_wall_regions(const WallScene& scene, WallsScratch* scratch, JudgedWall (*walls)[2]);

}  // namespace pose_wall
