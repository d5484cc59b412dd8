// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "pose_wall.hpp"

namespace pose_wall::bench {

enum class PclMethod { kRansac, kMlesac };

// What pose_wall's config says, as far as PCL's parts can be told it.
struct PclSettings {
  Eigen::Affine3f base_from_lidar;
  float range_min_m, range_max_m;
  std::vector<Eigen::AlignedBox3f> body_boxes_base;
  float voxel_leaf_m;
  double outlier_radius_m;
  int outlier_min_neighbors;
  float ground_radius_m;     // PCL has nothing that would find it out
  double ground_percentile;  // 0 to 1
  double ground_tilt_max_rad, ground_threshold_m;
  int ground_iterations;
  float wall_z_min_m, wall_z_max_m, wall_voxel_leaf_m;
  double wall_lean_max_rad, wall_threshold_m;
  int wall_iterations;
  double s_front_m, s_back_m;
};

// Of a config whose forward_axis is +X.
PclSettings pcl_settings(const api::Config& config, float ground_radius_m);

// Chosen by hand, in PCL's favour: that of 3, 5, 7, 10 and 15 m by which roll and pitch came out best on these frames.
float best_ground_radius_m(const std::string& sensor, PclMethod method);

}  // namespace pose_wall::bench
