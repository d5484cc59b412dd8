// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Which of the surfaces that were found each point of the cloud lies on.

#pragma once

#include "base/containers/point_set.hpp"
#include "base/containers/span.hpp"
#include "config.hpp"
#include "types.hpp"

namespace pose_wall {

// Writes a POSE_WALL_LABEL_ for each point: the floor's and the walls' by ground_ransac_thresh and wall_ransac_thresh,
// the walls' within the wall band; nothing lies on what was not found, or on walls where the floor was not.
void label_points(const PointSet& cloud_base, const Surfaces& found, const Settings& settings,
                  Span<std::uint8_t> labels);

}  // namespace pose_wall
