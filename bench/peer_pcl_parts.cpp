// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "peer_pcl_parts.hpp"

#include <pcl/filters/crop_box.h>
#include <pcl/filters/passthrough.h>
#include <pcl/filters/radius_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/sample_consensus/method_types.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <algorithm>

namespace pose_wall::bench {

PclCloud::Ptr points_in_base(const std::vector<float>& xyz_intensity_lidar, const PclSettings& settings) {
  PclCloud::Ptr cloud(new PclCloud);
  cloud->reserve(xyz_intensity_lidar.size() / 4);
  const float near2 = settings.range_min_m * settings.range_min_m, far2 = settings.range_max_m * settings.range_max_m;
  for (std::size_t i = 0; i + 3 < xyz_intensity_lidar.size(); i += 4) {
    const Eigen::Vector3f p(xyz_intensity_lidar[i], xyz_intensity_lidar[i + 1], xyz_intensity_lidar[i + 2]);
    const float range2 = p.squaredNorm();
    if (!(range2 >= near2 && range2 <= far2)) continue;
    const Eigen::Vector3f base = settings.base_from_lidar * p;
    cloud->emplace_back(base.x(), base.y(), base.z());
  }
  return cloud;
}

PclCloud::Ptr without_body(const PclCloud::Ptr& cloud, const PclSettings& settings) {
  PclCloud::Ptr kept = cloud;
  for (const Eigen::AlignedBox3f& box : settings.body_boxes_base) {
    pcl::CropBox<pcl::PointXYZ> crop;
    crop.setMin(box.min().homogeneous());
    crop.setMax(box.max().homogeneous());
    crop.setNegative(true);
    crop.setInputCloud(kept);
    PclCloud::Ptr outside(new PclCloud);
    crop.filter(*outside);
    kept = outside;
  }
  return kept;
}

PclCloud::Ptr one_per_voxel(const PclCloud::Ptr& cloud, float leaf_m) {
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setLeafSize(leaf_m, leaf_m, leaf_m);
  grid.setDownsampleAllData(false);  // there is nothing but x, y, z: the same result, sooner
  grid.setInputCloud(cloud);
  PclCloud::Ptr kept(new PclCloud);
  grid.filter(*kept);
  return kept;
}

PclCloud::Ptr without_outliers(const PclCloud::Ptr& cloud, const PclSettings& settings) {
  pcl::RadiusOutlierRemoval<pcl::PointXYZ> removal;
  removal.setRadiusSearch(settings.outlier_radius_m);
  removal.setMinNeighborsInRadius(settings.outlier_min_neighbors);
  removal.setInputCloud(cloud);
  PclCloud::Ptr kept(new PclCloud);
  removal.filter(*kept);
  return kept;
}

PclCloud::Ptr lowest_nearby(const PclCloud& cloud, double share, float radius_m) {
  PclCloud::Ptr near(new PclCloud);
  for (const pcl::PointXYZ& p : cloud) {
    if (p.x * p.x + p.y * p.y <= radius_m * radius_m) near->push_back(p);
  }
  if (near->empty()) return near;
  const auto end = near->begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(near->size() - 1));
  std::nth_element(near->begin(), end, near->end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  near->resize(static_cast<std::size_t>(end - near->begin()));
  return near;
}

PclCloud::Ptr between_heights(const PclCloud::Ptr& cloud, float z_min_m, float z_max_m) {
  pcl::PassThrough<pcl::PointXYZ> band;
  band.setFilterFieldName("z");
  band.setFilterLimits(z_min_m, z_max_m);
  band.setInputCloud(cloud);
  PclCloud::Ptr kept(new PclCloud);
  band.filter(*kept);
  return kept;
}

PclCloud::Ptr one_side(const PclCloud& cloud, float sign) {
  PclCloud::Ptr kept(new PclCloud);
  kept->reserve(cloud.size());
  for (const pcl::PointXYZ& p : cloud) {
    if (p.y * sign > 0.0F) kept->push_back(p);
  }
  return kept;
}

std::optional<PclPlane> find_plane(const PclCloud::Ptr& cloud, const PclPlaneSearch& search, PclMethod method) {
  if (cloud->size() < 3) return std::nullopt;
  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setOptimizeCoefficients(true);
  segmentation.setModelType(search.model);
  segmentation.setMethodType(method == PclMethod::kRansac ? pcl::SAC_RANSAC : pcl::SAC_MLESAC);
  segmentation.setAxis(Eigen::Vector3f::UnitZ());
  segmentation.setEpsAngle(search.angle_rad);
  segmentation.setDistanceThreshold(search.threshold_m);
  segmentation.setMaxIterations(search.iterations);
  segmentation.setInputCloud(cloud);
  pcl::ModelCoefficients coefficients;
  pcl::PointIndices inliers;
  segmentation.segment(inliers, coefficients);
  if (inliers.indices.empty()) return std::nullopt;
  const auto& c = coefficients.values;
  const Eigen::Vector3d normal = Eigen::Vector3f(c[0], c[1], c[2]).cast<double>();
  return PclPlane{normal / normal.norm(), static_cast<double>(c[3]) / normal.norm()};
}

}  // namespace pose_wall::bench
