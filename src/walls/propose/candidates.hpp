// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Planes that could be walls on one side: drawn, refined, merged where they became alike, and weighed by what the grid
// shows of them. Which of them is the wall is another question (walls_select).

#pragma once

#include "walls/choose/choose.hpp"
#include "walls/scratch.hpp"

namespace pose_wall {

// The part of the band on which hypotheses are refined, one side after the other, so that blocks of points lie on one.
void thin_out(const WallScene& scene, BoundedPoints* thin_level);

// last: a plane to be scored like any other hypothesis, or nullptr.
void draw_walls(const WallScene& scene, const SideView& view, const Plane* last, Random* random, WallSearch* search);

// Each side of a direction gets the other's.
void exchange_directions(WallSearch (&search)[2]);

// What the search has found; scratch->thin_level is to be thinned before.
void weigh_walls(const WallScene& scene, const SideView& view, WallSearch* search, WallsScratch* scratch,
                 WallCandidates* out);

// The gates that a plane fails, as pose_wall_reason bits.
std::uint32_t faults_of(const Plane& plane, const WallEvidence& evidence, const Settings& settings);

#ifdef POSE_WALL_TRACE
void note_faults(const Plane& plane, const WallEvidence& evidence, const Settings& settings);
#endif

}  // namespace pose_wall
