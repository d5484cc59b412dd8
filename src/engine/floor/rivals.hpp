// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Other readings of the floor: another plane in the same look, another look, other ground under the machine, and the
// lean of the walls. The protection levels reach to every reading that is as good, or nearly.

#pragma once

#include <Eigen/Core>

#include "base/math/random.hpp"
#include "engine/floor/candidates.hpp"
#include "engine/floor/levelling.hpp"
#include "engine/floor/result.hpp"
#include "engine/floor/scene.hpp"

namespace pose_wall {

// Planes in the same look that are nearly as good, by ground that the fit leaves out. A tilted plane through the fit's
// own points is no other floor: the fit's errors cover it. A small floor must stand alone, or is refused.
void reach_to_rivals(const FloorScene& scene, const PointSet& within_base, const FloorCandidates& candidates,
                     FloorScratch* scratch, FloorResult* floor);

// The floor within another radius.
void reach_to_other_look(const FloorResult& other, const Settings& settings, FloorResult* floor);

// Picking the smallest of several levels is optimistic: widens the level for each other one.
void widen_by_claims(std::uint32_t claims, const Settings& settings, FloorResult* floor);

// A floor seen to one side of the machine only may not carry it: at the foot of a ramp a sensor that hardly looks down
// sees the ramp ahead. Searches the open points that the floor leaves over for planes. Where the machine may stand on
// one, the levels reach to it. Where its own ground is not seen at all, they reach to a ramp.
void reach_to_floors_beside(const FloorScene& scene, Random* random, FloorScratch* scratch, FloorResult* floor);

// A floor that has rivals and is steep may be a heap's flank: the levels reach to upright.
void reach_to_upright(FloorResult* floor);

// The same floor with levels that reach to the tilt error that both walls indicate.
FloorResult doubted_by_walls(const FloorResult& floor, const Eigen::Vector3d& tilt_level_rad, const Settings& settings,
                             const Levelling& levelling);

}  // namespace pose_wall
