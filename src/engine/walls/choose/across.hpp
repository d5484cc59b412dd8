// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Tests whether the machine stands across the road: then the planes ahead and behind make a better roadway than the
// sides.

#pragma once

#include "base/math/random.hpp"
#include "engine/walls/choose/choose.hpp"
#include "engine/walls/propose/candidates.hpp"
#include "engine/walls/scene.hpp"

namespace pose_wall {

// Largest area over which a plane across the machine can be solid, wherever it stands. It may be turned by up to
// yaw_max_deg and kRefineSlack_deg and lean by up to wall_lean_max_deg. No column of it is solid where nothing is seen
// at that place beside the machine. In a road that is its width, and a little more. Exact to a float's error at the
// edges of cells.
double most_area_across_m2(const WallScene& scene);

// False if two planes with this area together show no more than the chosen walls. Then neither, or not the second, has
// to be sought. Without a chosen wall it is true: planes across may explain why.
bool may_stand_across(double pair_m2, const WallChoice& choice, const Settings& settings);
// The same with the planes found ahead, before any draws behind. Directions found behind may show more ahead, but only
// up to a share of the chosen area, or the draws would have found it.
bool is_behind_to_be_drawn(double ahead_m2, double most_behind_m2, const WallChoice& choice, const Settings& settings);

// Refuses both sides if the machine stands across the road, or may stand so and nothing was sought. The planes ahead
// and behind are sought only where they could show more than the chosen walls.
void refuse_where_across(const WallScene& scene, Random* random, ProposeScratch* scratch, WallChoice* choice);

}  // namespace pose_wall
