// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What speaks against a wall that was chosen and measured: its rival, its distance from the machine, what is seen of it
// from close by, and the wall on the other side. It widens the protection levels, or refuses the wall.

#pragma once

#include "types.hpp"
#include "walls/choose/choose.hpp"
#include "walls/scratch.hpp"

namespace pose_wall {

// The truth may be the rival: the protection levels reach to it. side: 0 left, 1 right.
void reach_to_rival(const WallScene& scene, const Plane& rival, int side, WallResult* wall);

// A wall that is seen only well ahead of the machine, or behind it: in between the road may bend.
void extend_to_machine(double away_m, WallResult* wall);

// Near the sensor, what passes for a wall and is none gives itself away. grooved: its surface lies in two depths.
void look_closely(const WallScene& scene, bool grooved, WallsScratch* scratch, WallResult* wall);

// A wall that stands alone tells the road's direction only as well as the other side does not speak against it.
// beside: all that could be walls, by side.
void doubt_those_alone(const Settings& settings, const WallChoice& choice, const WallCandidates (&beside)[2],
                       WallResult (*walls)[2]);

// Two walls vouch for each other as far as they run alike. One that is too short to stand alone, beside one that runs
// otherwise, may be a boulder.
void doubt_short_ones_apart(const Settings& settings, const WallChoice& choice, WallResult (*walls)[2]);

}  // namespace pose_wall
