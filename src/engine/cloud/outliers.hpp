// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 2: lone voxels go.

#pragma once

#include "base/containers/bounded_points.hpp"
#include "base/containers/work.hpp"
#include "engine/cloud/voxel_grid.hpp"
#include "engine/config.hpp"
#include "engine/types.hpp"

namespace pose_wall {

// Drops centroids with fewer than outlier_min_neighbors others within outlier_radius, keeps the order of the rest and
// bounds them. Once the leaf has grown the radius is at least two leaves, or no centroid would have neighbours. Returns
// the number of dropped ones. points: the grid's last extract; keep: scratch, one byte for each point.
std::uint32_t remove_outliers(const Settings& settings, VoxelGrid* grid, Span<std::uint8_t> keep, BoundedPoints* points,
                              Work* work);

}  // namespace pose_wall
