// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A way through a real road that nobody gave poses for: along the middle, as a machine would drive.
#pragma once

#include <vector>

#include "lab/sim/rock_surface.hpp"

namespace pose_wall::tools::sim {

// Begins at places within the bounds that are most like a road: walls all around within reach, a floor below. From
// there it goes both ways, in steps of step_m between the walls, until the road ends or comes back to itself, and the
// longest way counts. At junctions it goes on as straight as it can. Poses look along the way, stand on the floor as it
// lies, and are height_m above it. Empty: no place is like a road.
std::vector<Placement> propose_path(const RockSurface& rock, const Vector& low, const Vector& high, double step_m,
                                    double height_m);

}  // namespace pose_wall::tools::sim
