// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 2: lone voxels go.

#pragma once

#include "base/containers/bounded_points.hpp"
#include "base/containers/work.hpp"
#include "cloud/voxel_grid.hpp"
#include "config.hpp"
#include "types.hpp"

namespace pose_wall {

// Drops centroids with fewer than outlier_min_neighbors others within outlier_radius (two leaves where the leaf has
// grown, or none would have any), keeping the order of the rest, and bounds these. Returns how many went. points: just
// what the grid has extracted; keep: scratch, one byte per point.
std::uint32_t remove_outliers(const Settings& settings, VoxelGrid* grid, Span<std::uint8_t> keep, BoundedPoints* points,
                              Work* work);

}  // namespace pose_wall
