// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Labels each point of the cloud with the surface that it lies on.

#pragma once

#include "base/containers/point_set.hpp"
#include "base/containers/span.hpp"
#include "engine/config.hpp"
#include "engine/types.hpp"

namespace pose_wall {

// Writes a POSE_WALL_LABEL_ for each point: the floor's and the walls' within ground_ransac_thresh and
// wall_ransac_thresh, the walls' only inside the wall band. A surface that was not found gets no points, and without a
// floor no wall does.
void label_points(const PointSet& cloud_base, const Surfaces& found, const Settings& settings,
                  Span<std::uint8_t> labels);

}  // namespace pose_wall
