// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The other truth of a road: planes of the rock that is really there beside the machine, as a surveyor would fit them
// to a dense scan. The same regions as of tools/sim/survey_truth.hpp, written once more from those words.

#pragma once

#include "judge/machine.hpp"

namespace pose_wall::judge {

// Floor: 3 m ahead and behind base, 1.1 m to each side. Walls: 2.5 m ahead and behind, 0.25 to 2.5 m above that floor.
// Of the rock alone, without what stands before it. NaN where less than half of a wall is near one plane.
Truth surveyed_truth(const Road& road, const Machine& machine, const Pose& pose);

}  // namespace pose_wall::judge
