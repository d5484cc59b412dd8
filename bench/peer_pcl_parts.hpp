// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// PCL's parts, each set up as the pipeline needs it.
#pragma once

#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "peer_pcl_settings.hpp"

namespace pose_wall::bench {

using PclCloud = pcl::PointCloud<pcl::PointXYZ>;

struct PclPlane {
  Eigen::Vector3d normal;
  double d;
};

struct PclPlaneSearch {
  int model;         // pcl::SacModel
  double angle_rad;  // of the normal or the plane to +Z
  double threshold_m;
  int iterations;
};

// Within range of the sensor, moved into base.
PclCloud::Ptr points_in_base(const std::vector<float>& xyz_intensity_lidar, const PclSettings& settings);
PclCloud::Ptr without_body(const PclCloud::Ptr& cloud, const PclSettings& settings);
PclCloud::Ptr one_per_voxel(const PclCloud::Ptr& cloud, float leaf_m);
PclCloud::Ptr without_outliers(const PclCloud::Ptr& cloud, const PclSettings& settings);
// The lowest part of what lies within the radius.
PclCloud::Ptr lowest_nearby(const PclCloud& cloud, double share, float radius_m);
PclCloud::Ptr between_heights(const PclCloud::Ptr& cloud, float z_min_m, float z_max_m);
// With y > 0 (sign 1) or y < 0 (sign -1).
PclCloud::Ptr one_side(const PclCloud& cloud, float sign);
std::optional<PclPlane> find_plane(const PclCloud::Ptr& cloud, const PclPlaneSearch& search, PclMethod method);

}  // namespace pose_wall::bench
