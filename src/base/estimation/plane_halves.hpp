// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Compares the slopes of both halves of a surface with that of the whole. A kerb of a few centimetres between two parts
// of equal slope tilts the plane through both, and leaves residuals that look like roughness.

#pragma once

#include <Eigen/Core>

#include "base/containers/span.hpp"
#include "base/estimation/surface_patches.hpp"

namespace pose_wall {

// Deviation of a half's slope from that of the whole beyond its own error, as the response of an angle; the largest
// over the halves on either side of both axes, and of the surface's greatest extent and across it. 0 if a half holds
// too few patches. correction: of the whole (offset, slope along u, slope along v); residuals are about it. response:
// of the angle to such a correction.
double reach_of_halves(Span<const SurfacePatch> patches, const Eigen::Vector3d& correction,
                       const Eigen::Vector3d& response);

}  // namespace pose_wall
