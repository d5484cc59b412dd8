// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What else the floor may be: other planes of the same look, other looks, other ground that the machine may stand on,
// and what the walls say. The protection levels reach to all that is as good, or nearly.

#pragma once

#include <Eigen/Core>

#include "base/math/random.hpp"
#include "floor/candidates.hpp"
#include "floor/levelling.hpp"
#include "floor/result.hpp"
#include "floor/scene.hpp"

namespace pose_wall {

// Planes of the same look that are nearly as good. A small floor stands alone, or is refused.
void reach_to_rivals(const FloorCandidate& best, Span<const FloorCandidate> candidates, const Settings& settings,
                     FloorResult* floor);

// Within another radius the floor looks otherwise.
void reach_to_other_look(const FloorResult& other, const Settings& settings, FloorResult* floor);

// Choosing the best of several levels makes it too small: it is widened for each other one.
void widen_by_claims(std::uint32_t claims, const Settings& settings, FloorResult* floor);

// A floor that is seen to one side of the machine only may not be what the machine stands on: at the foot of a ramp a
// sensor that hardly looks down sees the ramp ahead. Planes are looked for in the open points that the floor leaves
// over; where the machine may stand on one of them, the levels reach to it.
void reach_to_floors_beside(const FloorScene& scene, Random* random, FloorScratch* scratch, FloorResult* floor);

// A floor that has rivals and is steep may be a heap's flank: the levels reach to upright.
void reach_to_upright(FloorResult* floor);

// The same floor with levels that reach to the turn by which it is off, as both walls say.
FloorResult doubted_by_walls(const FloorResult& floor, const Eigen::Vector3d& tilt_level_rad, const Settings& settings,
                             const Levelling& levelling);

}  // namespace pose_wall
