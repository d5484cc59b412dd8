// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Whether the machine stands across the road: the planes ahead and behind make a better roadway than the sides do.

#pragma once

#include "base/math/random.hpp"
#include "walls/choose/choose.hpp"
#include "walls/propose/candidates.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

// What a plane across the machine can be solid over at most, wherever it stands, turned by up to yaw_max_deg and
// kRefineSlack_deg and leaning by up to wall_lean_max_deg: no column of it is solid where nothing is seen at that place
// beside the machine. In a road that is its width, and a little more. To what floats know of a cell's edge.
double most_area_across_m2(const WallScene& scene);

// False where two planes that show no more than this together show no more than what is chosen: then none need be
// looked for, or not the second one. Where nothing was chosen, what stands across may tell why.
bool may_stand_across(double pair_m2, const WallChoice& choice, const Settings& settings);
// So with what the draws ahead have found, while none were made behind, whose directions may show more ahead: up to a
// share of what is chosen, or the draws would have found it.
bool is_behind_to_be_drawn(double ahead_m2, double most_behind_m2, const WallChoice& choice, const Settings& settings);

// Nothing is reported of a machine that stands across the road, nor of one that may, as long as nobody has looked. The
// planes ahead and behind are looked for only where they could show more than what is chosen.
void refuse_where_across(const WallScene& scene, Random* random, ProposeScratch* scratch, WallChoice* choice);

}  // namespace pose_wall
