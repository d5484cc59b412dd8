// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a perfect instrument would report. Straight walls: the formulas of the specification on the mean planes. Where
// a wall is no plane at the height of the sampling point (curve, arch, widening, narrow place): the distance from the
// sampling point to the nearest mean rock on that side in the levelled horizontal plane through it; yaw by the centre
// line's tangent.
#pragma once

#include "sim/pose.hpp"
#include "sim/world.hpp"
#include "truth/truth_csv.hpp"

namespace pose_wall::tools::sim {

TruthRow truth_of(const Setup& setup, const World& mean_rock, const MachinePose& pose);

}  // namespace pose_wall::tools::sim
