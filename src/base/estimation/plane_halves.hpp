// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Whether both halves of a surface slope as the whole does. A kerb of a few centimetres between two parts that slope
// alike tilts the plane through both, and leaves residuals that look like roughness.

#pragma once

#include <Eigen/Core>

#include "base/containers/span.hpp"
#include "base/estimation/surface_patches.hpp"

namespace pose_wall {

// How much further than its own error explains the slope of a half lies from that of the whole, as an angle answers to
// it; the largest over the halves on either side of both axes. 0 where a half holds too few patches to tell.
// correction: of the whole (offset, slope along u, slope along v), about which residuals are taken. response: of the
// angle to such a correction.
double reach_of_halves(Span<const SurfacePatch> patches, const Eigen::Vector3d& correction,
                       const Eigen::Vector3d& response);

}  // namespace pose_wall
