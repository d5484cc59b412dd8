// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What speaks against a wall that was chosen and fitted.

#pragma once

#include "walls/choose/choose.hpp"
#include "walls/scratch.hpp"
#include "walls/wall.hpp"

namespace pose_wall {

// The fitted wall of a side with all doubts that concern it alone: its own gates, its rival (found in choose/), its
// distance from the machine, and what is seen of it from close by. side: 0 left, 1 right. The grid is marked with it.
JudgedWall judge_wall(const WallScene& scene, const SideView& view, const WallChoice& choice, int side,
                      const FittedWall& fitted, WallsScratch* scratch);

// A wall that stands alone tells the road's direction only as well as the other side does not speak against it, and
// must be long enough by itself. beside: all that could be walls, by side.
void doubt_those_alone(const Settings& settings, const WallChoice& choice, const WallCandidates (&beside)[2],
                       JudgedWall (*walls)[2]);

// Two walls vouch for each other as far as they run alike. One that is too short to stand alone, beside one that runs
// otherwise, may be a boulder.
void doubt_short_ones_apart(const Settings& settings, const WallChoice& choice, JudgedWall (*walls)[2]);

// Returns nearer than range_min that take up most of a side hide what is behind them: that side is refused.
void refuse_blocked_sides(const IngestCounts& counts, const Settings& settings, JudgedWall (*walls)[2]);

// Both sides lean the same way about the road: one out, the other in. Each wall may lean by itself, but where both do
// so by this much it is the level that is wrong: a heap's flank was taken for the floor. Returns the turn by which the
// levelled frame may be off, as a vector along the road, rad. Zero unless both are sure.
Eigen::Vector3d tilt_by_walls(const WallScene& scene, const WallCandidates (&beside)[2]);

}  // namespace pose_wall
