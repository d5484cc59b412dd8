// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Where a wall is no plane over its whole height: an arched roof begins within the band, a heap ends in it, pipes run
// along its top.

#pragma once

#include "walls/fit/strips.hpp"

namespace pose_wall {

// Where the wall bends towards the machine at its top or its foot, that end is cut off. True where it was, and the fit
// is to be repeated between what is left of the heights.
bool cut_bent_rows(const WallSurface& fit, Heights* heights);

}  // namespace pose_wall
