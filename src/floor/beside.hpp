// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What else may be the floor that the machine stands on. The floor that shows most need not be: at the foot of a ramp a
// sensor sees the ramp before it, and of the flat ground that it stands on next to nothing.

#pragma once

#include "floor/candidates.hpp"

namespace pose_wall {

// Looks for planes in the open points that the floor leaves over. Where the two meet in a line and the machine stands
// on the other one's side of it, or the other one lies below the floor all over, the levels reach to it.
void reach_to_floors_beside(const BoundedPoints& cloud_base, const Settings& settings, const Axes& axes,
                            const Eigen::Vector3d& sensor_base_m, Random* random, FloorScratch* scratch,
                            FloorResult* floor);

}  // namespace pose_wall
