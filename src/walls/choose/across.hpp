// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Whether the planes ahead and behind could make a better roadway than the sides do, told without looking for them.

#pragma once

#include "walls/choose/choose.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

// What a plane across the machine can be solid over at most, wherever it stands, turned by up to yaw_max_deg and
// kRefineSlack_deg and leaning by up to wall_lean_max_deg: no column of it is solid where nothing is seen at that place
// beside the machine. In a road that is its width, and a little more. To what floats know of a cell's edge.
double most_area_across_m2(const WallScene& scene);

// False where two planes that show no more than this together show no more than what is chosen: then none need be
// looked for, or not the second one.
bool may_stand_across(double pair_m2, const WallChoice& choice);
// So with what the draws ahead have found, while none were made behind, whose directions may show more ahead: up to a
// share of what is chosen, or the draws would have found it.
bool is_behind_to_be_drawn(double ahead_m2, double most_behind_m2, const WallChoice& choice);

}  // namespace pose_wall
