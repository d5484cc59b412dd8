// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The chosen floor, refined: second selection by height over it, Tukey, patches, and what that says of roll and pitch.

#pragma once

#include "config.hpp"
#include "stages/ground.hpp"
#include "types.hpp"

namespace pose_wall {

// start: the chosen hypothesis. open: the points to select from; those count whose ray meets the plane within radius_m.
FloorResult fit_floor(const PointSet& cloud_base, Span<const std::uint32_t> open, double radius_m, const Plane& start,
                      const Settings& settings, const Eigen::Vector3d& sensor_base_m, GroundScratch* scratch);

}  // namespace pose_wall
