// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// One direction for two walls of a road.

#pragma once

#include "walls/scene.hpp"
#include "walls/wall.hpp"

namespace pose_wall {

// Turns two walls of nearly the same direction onto their weighted mean, each about its pivot, and adds to the bounds
// of their distances what that moved. Roughness, doors and the sensor's own motion during a scan turn the walls apart
// by a degree; two metres from the machine's centre that is centimetres. Walls that truly run apart by more than
// wall_parallel_within_deg keep their own directions. yaw_rad of each wall stays as measured.
void share_direction(const WallScene& scene, JudgedWall (*walls)[2]);

}  // namespace pose_wall
