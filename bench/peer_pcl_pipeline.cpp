// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "peer_pcl_pipeline.hpp"

#include <pcl/common/transforms.h>
#include <pcl/filters/crop_box.h>
#include <pcl/filters/extract_indices.h>
#include <pcl/filters/passthrough.h>
#include <pcl/filters/radius_outlier_removal.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/sample_consensus/method_types.h>
#include <pcl/sample_consensus/model_types.h>
#include <pcl/segmentation/sac_segmentation.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace pose_wall::bench {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

constexpr float kRangeMin_m = 0.3F;
constexpr float kRangeMax_m = 30.0F;
// The floor is first seen at 3.4 m by this sensor; pose_wall widens its 3 m to about this.
constexpr float kGroundRadius_m = 7.0F;
constexpr double kGroundPercentile = 0.25;
constexpr int kIterations = 300;
constexpr double kFrontBack_m = 2.0;
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct PlaneModel {
  Eigen::Vector3d normal;
  double d;
};

Cloud::Ptr in_range(const std::vector<float>& xyz_intensity) {
  Cloud::Ptr cloud(new Cloud);
  cloud->reserve(xyz_intensity.size() / 4);
  for (std::size_t i = 0; i + 3 < xyz_intensity.size(); i += 4) {
    const Eigen::Vector3f p(xyz_intensity[i], xyz_intensity[i + 1], xyz_intensity[i + 2]);
    const float range = p.norm();
    if (range >= kRangeMin_m && range <= kRangeMax_m) cloud->emplace_back(p.x(), p.y(), p.z());
  }
  return cloud;
}

Cloud::Ptr without_body(const Cloud::Ptr& cloud, const std::array<double, 6>& box) {
  pcl::CropBox<pcl::PointXYZ> crop;
  crop.setMin(Eigen::Vector4d(box[0], box[2], box[4], 1.0).cast<float>());
  crop.setMax(Eigen::Vector4d(box[1], box[3], box[5], 1.0).cast<float>());
  crop.setNegative(true);
  crop.setInputCloud(cloud);
  Cloud::Ptr kept(new Cloud);
  crop.filter(*kept);
  return kept;
}

Cloud::Ptr voxels(const Cloud::Ptr& cloud, float leaf_m) {
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setLeafSize(leaf_m, leaf_m, leaf_m);
  grid.setInputCloud(cloud);
  Cloud::Ptr kept(new Cloud);
  grid.filter(*kept);
  return kept;
}

Cloud::Ptr without_outliers(const Cloud::Ptr& cloud) {
  pcl::RadiusOutlierRemoval<pcl::PointXYZ> removal;
  removal.setRadiusSearch(0.20);
  removal.setMinNeighborsInRadius(3);
  removal.setInputCloud(cloud);
  Cloud::Ptr kept(new Cloud);
  removal.filter(*kept);
  return kept;
}

Cloud::Ptr lowest_nearby(const Cloud::Ptr& cloud) {
  Cloud::Ptr near(new Cloud);
  for (const pcl::PointXYZ& p : *cloud) {
    if (std::hypot(p.x, p.y) <= kGroundRadius_m) near->push_back(p);
  }
  if (near->empty()) return near;
  const auto middle =
      near->begin() + static_cast<std::ptrdiff_t>(kGroundPercentile * static_cast<double>(near->size()));
  std::nth_element(near->begin(), middle, near->end(), [](const auto& a, const auto& b) { return a.z < b.z; });
  near->resize(static_cast<std::size_t>(middle - near->begin()));
  return near;
}

struct PlaneSearch {
  int model;
  double angle_rad;  // to +Z
  double threshold_m;
};

std::optional<PlaneModel> find_plane(const Cloud::Ptr& cloud, const PlaneSearch& search, PclMethod method) {
  if (cloud->size() < 3) return std::nullopt;
  pcl::SACSegmentation<pcl::PointXYZ> segmentation;
  segmentation.setOptimizeCoefficients(true);
  segmentation.setModelType(search.model);
  segmentation.setMethodType(method == PclMethod::kRansac ? pcl::SAC_RANSAC : pcl::SAC_MLESAC);
  segmentation.setAxis(Eigen::Vector3f::UnitZ());
  segmentation.setEpsAngle(search.angle_rad);
  segmentation.setDistanceThreshold(search.threshold_m);
  segmentation.setMaxIterations(kIterations);
  segmentation.setInputCloud(cloud);
  pcl::ModelCoefficients coefficients;
  pcl::PointIndices inliers;
  segmentation.segment(inliers, coefficients);
  if (inliers.indices.empty()) return std::nullopt;
  const auto& c = coefficients.values;
  const Eigen::Vector3d normal = Eigen::Vector3f(c[0], c[1], c[2]).cast<double>();
  return PlaneModel{normal / normal.norm(), static_cast<double>(c[3]) / normal.norm()};
}

Cloud::Ptr wall_band(const Cloud::Ptr& cloud, const Eigen::Matrix3d& R_level_base, double floor_z_m) {
  Eigen::Affine3f level = Eigen::Affine3f::Identity();
  level.linear() = R_level_base.cast<float>();
  Cloud::Ptr levelled(new Cloud);
  pcl::transformPointCloud(*cloud, *levelled, level);
  pcl::PassThrough<pcl::PointXYZ> band;
  band.setFilterFieldName("z");
  band.setFilterLimits(static_cast<float>(floor_z_m + 0.25), static_cast<float>(floor_z_m + 2.5));
  band.setInputCloud(levelled);
  Cloud::Ptr kept(new Cloud);
  band.filter(*kept);
  return voxels(kept, 0.08F);
}

Cloud::Ptr side(const Cloud& cloud, float sign) {
  Cloud::Ptr kept(new Cloud);
  for (const pcl::PointXYZ& p : cloud) {
    if (p.y * sign > 0.0F) kept->push_back(p);
  }
  return kept;
}

struct WallReading {
  double yaw_rad, front_m, back_m;
};

WallReading read_wall(const PlaneModel& wall, const Eigen::Matrix3d& R_level_base) {
  const Eigen::Vector3d forward = R_level_base * Eigen::Vector3d::UnitX();
  Eigen::Vector3d along = Eigen::Vector3d::UnitZ().cross(wall.normal).normalized();
  if (along.dot(forward) < 0.0) along = -along;
  const double yaw = std::atan2(along.y(), along.x()) - std::atan2(forward.y(), forward.x());
  return {yaw, std::abs(wall.normal.dot(kFrontBack_m * forward) + wall.d),
          std::abs(wall.normal.dot(-kFrontBack_m * forward) + wall.d)};
}

void read_walls(const Cloud& band, const Eigen::Matrix3d& R_level_base, PclMethod method, PclMeasurement& out) {
  const PlaneSearch search{pcl::SACMODEL_PARALLEL_PLANE, 0.35, 0.05};
  double yaw_sum = 0.0;
  int walls = 0;
  for (const int right : {0, 1}) {
    const auto wall = find_plane(side(band, right != 0 ? -1.0F : 1.0F), search, method);
    if (!wall) continue;
    const WallReading reading = read_wall(*wall, R_level_base);
    out[static_cast<std::size_t>(3 + 2 * right)] = reading.front_m;
    out[static_cast<std::size_t>(4 + 2 * right)] = reading.back_m;
    yaw_sum += reading.yaw_rad;
    ++walls;
  }
  if (walls > 0) out[2] = yaw_sum / walls;
}

}  // namespace

PclMeasurement measure_with_pcl(const std::vector<float>& xyz_intensity, const std::array<double, 6>& body_box,
                                PclMethod method) {
  PclMeasurement out;
  out.fill(kNone);
  const Cloud::Ptr cloud = without_outliers(voxels(without_body(in_range(xyz_intensity), body_box), 0.05F));
  auto floor = find_plane(lowest_nearby(cloud), {pcl::SACMODEL_PERPENDICULAR_PLANE, 0.61, 0.03}, method);
  if (!floor) return out;
  if (floor->normal.z() < 0.0) *floor = {-floor->normal, -floor->d};
  const Eigen::Vector3d& n = floor->normal;
  out[0] = std::atan2(n.y(), n.z());
  out[1] = std::atan2(-n.x(), std::hypot(n.y(), n.z()));
  const Eigen::Matrix3d R_level_base =
      (Eigen::AngleAxisd(out[1], Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(out[0], Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  read_walls(*wall_band(cloud, R_level_base, -floor->d), R_level_base, method, out);
  return out;
}

}  // namespace pose_wall::bench
