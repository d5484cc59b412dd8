// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "peer_pcl_pipeline.hpp"

#include <pcl/common/transforms.h>
#include <pcl/sample_consensus/model_types.h>

#include <cmath>
#include <limits>

#include "cpu_time.hpp"

namespace pose_wall::bench {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// Time since the last stage's end, or since the start.
class StageTimer {
 public:
  explicit StageTimer(PclReading* out) : out_(out) {}

  void done(pose_wall_stage stage) {
    const std::int64_t now_ns = cpu_time_ns();
    out_->stage_ns[stage] = now_ns - last_ns_;
    last_ns_ = now_ns;
  }

 private:
  PclReading* out_;
  std::int64_t last_ns_ = cpu_time_ns();
};

PclCloud::Ptr wall_band(const PclCloud& cloud, const Eigen::Matrix3d& R_level_base, double floor_z_m,
                        const PclSettings& s) {
  Eigen::Affine3f level = Eigen::Affine3f::Identity();
  level.linear() = R_level_base.cast<float>();
  PclCloud::Ptr levelled(new PclCloud);
  pcl::transformPointCloud(cloud, *levelled, level);
  const auto floor_z = static_cast<float>(floor_z_m);
  return one_per_voxel(between_heights(levelled, floor_z + s.wall_z_min_m, floor_z + s.wall_z_max_m),
                       s.wall_voxel_leaf_m);
}

Eigen::Matrix3d levelling_by(const PclPlane& floor, PclReading* out) {
  const Eigen::Vector3d& n = floor.normal;
  const double roll = std::atan2(n.y(), n.z()), pitch = std::atan2(-n.x(), std::hypot(n.y(), n.z()));
  out->value[POSE_WALL_ROLL] = roll;
  out->value[POSE_WALL_PITCH] = pitch;
  return (Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

double yaw_by(const PclPlane& wall, const Eigen::Vector3d& forward) {
  Eigen::Vector3d along = Eigen::Vector3d::UnitZ().cross(wall.normal).normalized();
  if (along.dot(forward) < 0.0) along = -along;
  return std::atan2(along.y(), along.x()) - std::atan2(forward.y(), forward.x());
}

void read_walls(const std::optional<PclPlane> (&walls)[2], const Eigen::Vector3d& forward, const PclSettings& s,
                PclReading* out) {
  double yaw_sum = 0.0;
  int found = 0;
  for (const std::size_t side : {0U, 1U}) {
    if (!walls[side]) continue;
    const PclPlane& wall = *walls[side];
    out->value[POSE_WALL_D_LF + 2 * side] = std::abs(wall.normal.dot(s.s_front_m * forward) + wall.d);
    out->value[POSE_WALL_D_LB + 2 * side] = std::abs(wall.normal.dot(s.s_back_m * forward) + wall.d);
    yaw_sum += yaw_by(wall, forward);
    ++found;
  }
  if (found > 0) out->value[POSE_WALL_YAW] = yaw_sum / found;
}

}  // namespace

PclReading measure_with_pcl(const std::vector<float>& xyz_intensity_lidar, const PclSettings& s, PclMethod method) {
  PclReading out;
  out.value.fill(kNone);
  StageTimer timer(&out);
  const PclCloud::Ptr voxels = one_per_voxel(without_body(points_in_base(xyz_intensity_lidar, s), s), s.voxel_leaf_m);
  timer.done(POSE_WALL_STAGE_VOXEL);
  const PclCloud::Ptr cloud = without_outliers(voxels, s);
  timer.done(POSE_WALL_STAGE_OUTLIERS);

  const PclPlaneSearch floor_search{pcl::SACMODEL_PERPENDICULAR_PLANE, s.ground_tilt_max_rad, s.ground_threshold_m,
                                    s.ground_iterations};
  auto floor = find_plane(lowest_nearby(*cloud, s.ground_percentile, s.ground_radius_m), floor_search, method);
  timer.done(POSE_WALL_STAGE_FLOOR);
  if (!floor) return out;
  if (floor->normal.z() < 0.0) *floor = {-floor->normal, -floor->d};
  const Eigen::Matrix3d R_level_base = levelling_by(*floor, &out);
  const PclCloud::Ptr band = wall_band(*cloud, R_level_base, -floor->d, s);
  timer.done(POSE_WALL_STAGE_BAND);

  const PclPlaneSearch wall_search{pcl::SACMODEL_PARALLEL_PLANE, s.wall_lean_max_rad, s.wall_threshold_m,
                                   s.wall_iterations};
  const std::optional<PclPlane> walls[2] = {find_plane(one_side(*band, 1.0F), wall_search, method),
                                            find_plane(one_side(*band, -1.0F), wall_search, method)};
  timer.done(POSE_WALL_STAGE_WALLS);
  read_walls(walls, R_level_base * Eigen::Vector3d::UnitX(), s, &out);
  timer.done(POSE_WALL_STAGE_OUTPUT);
  return out;
}

}  // namespace pose_wall::bench
