// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The other truth of a road: planes of the rock that is really there beside the machine, as a surveyor would fit them
// to a dense scan, written once more from the words of include/DEFINITIONS.md.

#pragma once

#include "judge/machine.hpp"

namespace pose_wall::judge {

// Of the rock alone, without what stands before it. NaN where a wall is none by the definition.
Truth surveyed_truth(const Road& road, const Machine& machine, const Pose& pose);

}  // namespace pose_wall::judge
