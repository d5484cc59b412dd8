// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Doubts about a chosen and fitted wall.

#pragma once

#include "engine/walls/choose/choose.hpp"
#include "engine/walls/scratch.hpp"
#include "engine/walls/wall.hpp"

namespace pose_wall {

// The fitted wall of one side with all doubts about it alone: its own gates, its rivals (found in choose/), its
// distance from the machine, and the close look. beside: the planes of its side. side: 0 left, 1 right. The grid is
// marked with it.
JudgedWall judge_wall(const WallScene& scene, const SideView& view, const WallChoice& choice,
                      const WallCandidates& beside, int side, const FittedWall& fitted, WallsScratch* scratch);

// A wall alone gives the road's direction only as well as the other side allows, and must be long enough by itself.
// beside: all planes that may be walls, by side.
void doubt_those_alone(const Settings& settings, const WallChoice& choice, const WallCandidates (&beside)[2],
                       JudgedWall (*walls)[2]);

// Refuses a side if most of its returns are nearer than range_min: they hide everything behind them.
void refuse_blocked_sides(const IngestCounts& counts, const Settings& settings, JudgedWall (*walls)[2]);

// Both sides lean the same way about the road, one out and the other in. Each wall may lean by itself, but if both do
// so by this much, the level is wrong: a heap's flank was taken for the floor. Returns the possible tilt error of the
// levelled frame as a vector along the road, rad. Zero unless both are sure.
Eigen::Vector3d tilt_by_walls(const WallScene& scene, const WallCandidates (&beside)[2]);

}  // namespace pose_wall
