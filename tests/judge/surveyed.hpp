// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The other truth of a road: planes of the rock that is really there beside the machine, as a surveyor would fit them
// to a dense scan, written once more from the words of include/DEFINITIONS.md.

#pragma once

#include "judge/machine.hpp"

namespace pose_wall::judge {

// Where the floor's region begins and ends, ahead and behind: the keys floor_region_min and floor_region_max.
struct FloorRegion {
  double from_m = 1.5, to_m = 3.5;
};

// Of the rock alone, without what stands before it. NaN where a wall is none by the definition.
Truth surveyed_truth(const Road& road, const Machine& machine, const Pose& pose, const FloorRegion& floor = {});

}  // namespace pose_wall::judge
