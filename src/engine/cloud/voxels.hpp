// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 1: raw cloud to voxel centroids in base.

#pragma once

#include "engine/cloud/direction_grid.hpp"
#include "engine/cloud/result.hpp"
#include "engine/cloud/voxel_grid.hpp"
#include "engine/config.hpp"
#include "engine/types.hpp"
#include "lidar/cloud_print.hpp"
#include "pose_wall.h"

namespace pose_wall {

// What is told of all returns, before the filters.
struct AllReturns {
  ReturnsByDirection* by_direction_lidar;
  CloudPrint* print;
};

// Filters (finite, not zero, range_min..range_max from the sensor, outside the body boxes), moves points to base and
// averages them by voxel. A frame with more voxels than there is room for starts again with a larger leaf. One with far
// fewer tries a smaller leaf. There are three such restarts at most. The leaf depends on the set of points and on the
// last cloud's memory, not on the points' order. With an odometry the points of a cloud with times lie where they were
// at the stamp (skew).
VoxelResult build_voxels(const pose_wall_cloud& cloud, const pose_wall_odometry* odometry, const Settings& settings,
                         const Extrinsic& extrinsic, const Axes& axes, const LeafMemory& last, VoxelGrid* grid,
                         const AllReturns& all_returns, PointSet* cloud_base);

}  // namespace pose_wall
