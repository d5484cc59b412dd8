// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Stage 4: from the floor's plane to the levelled frame and the wall band.

#pragma once

#include "base/containers/bounded_points.hpp"
#include "engine/cloud/voxel_grid.hpp"
#include "engine/config.hpp"
#include "engine/types.hpp"

namespace pose_wall {

struct Levelling {
  Eigen::Matrix3d R_level_base = Eigen::Matrix3d::Identity();
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double forward_up = 0.0;       // z of the machine's forward axis in the levelled frame: sine of its elevation
  double floor_z_level_m = 0.0;  // z of the floor in the levelled frame: height above floor = z - floor_z
};

Levelling levelling_by(const Plane& floor_base, const Axes& axes);

// Room for points outside the band: an even part of them in all directions.
constexpr std::uint32_t kBeyondMax = 8192;  // swept: half 2 won, twice 2 moved

// Cuts the levelled points between wall_z_min and wall_z_max above the floor and averages them once more. Of the points
// above and below it keeps an even part. Both lists get bounds. A weight in beyond_level is the number of points that
// one stands for.
void cut_wall_band(const PointSet& cloud_base, const Levelling& levelling, const Settings& settings, VoxelGrid* grid,
                   BoundedPoints* band_level, BoundedPoints* beyond_level);

}  // namespace pose_wall
