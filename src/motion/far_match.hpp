// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The way along the road after a gap: curves side by side, as far as the machine can have gone.

#pragma once

#include "base/containers/work.hpp"
#include "motion/along_match.hpp"

namespace pose_wall::motion {

// The best curve, and the place of its middle.
struct FarPlace {
  Curve curve;
  Eigen::Vector3d t;
};

// If another curve that is not the best one's neighbour fits nearly as well, that is a second place, even if it is no
// evidence by itself.
FarPlace match_far(const Scan& scan, double far_m, const Alignment& middle, CurveScratch* scratch, Work* work);

}  // namespace pose_wall::motion
