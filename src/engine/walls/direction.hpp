// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// One direction for two walls of a road.

#pragma once

#include "engine/walls/scene.hpp"
#include "engine/walls/wall.hpp"

namespace pose_wall {

// Turns two walls of nearly the same direction onto their weighted mean, each about its pivot. The bounds of their
// distances take in how far that moved them. Roughness, doors and the sensor's own motion during a scan turn walls
// apart by a degree; two metres from the machine's centre that is centimetres. Walls that run apart by more than
// wall_parallel_within_deg keep their own directions. The yaw_rad of each wall stays as measured.
void share_direction(const WallScene& scene, JudgedWall (*walls)[2]);

}  // namespace pose_wall
