// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a perfect instrument would report. Straight walls: the formulas of the specification on the mean planes; at a
// step in the wall, on the plane square to which the sampling point lies. Where a wall is no plane at the height of the
// sampling point (curve, arch's curved part): the distance from the sampling point to the nearest mean rock on that
// side in the levelled horizontal plane through it. Yaw by the walls' mean direction; in a curve, by the centre line's
// tangent.
#pragma once

#include "io/csv/truth_csv.hpp"
#include "lab/sim/pose.hpp"
#include "lab/sim/world.hpp"

namespace pose_wall::tools::sim {

// How far a stepped wall (widening, narrow place) is: square to it, as the specification's formula has it, or to its
// nearest rock, so that the corner of a step counts.
enum class StepRule { kSquare, kNearest };

TruthRow truth_of(const Setup& setup, const World& mean_rock, const MachinePose& pose, StepRule rule);

}  // namespace pose_wall::tools::sim
