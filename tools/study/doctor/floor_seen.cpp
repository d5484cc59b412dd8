// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "study/doctor/floor_seen.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "io/config_file/sensor_mount.hpp"
#include "study/doctor/statistics.hpp"
#include "study/doctor/trial.hpp"

namespace pose_wall::tools::doctor {
namespace {

Eigen::Vector3d median_direction(const std::vector<Eigen::Vector3d>& directions) {
  Eigen::Vector3d middle;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> parts;
    parts.reserve(directions.size());
    for (const Eigen::Vector3d& direction : directions) parts.push_back(direction[axis]);
    middle[axis] = median(parts);
  }
  return middle.normalized();
}

double angle_rad(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

FloorSeen look_at_floor(const api::Config& config, const std::vector<KeptFrame>& frames, std::size_t frames_max) {
  const Trial trial(config, frames, frames_max);
  const SensorMount mount(config);
  FloorSeen seen;
  seen.measured = trial.measured(POSE_WALL_ROLL);
  seen.valid = std::min(trial.valid(POSE_WALL_ROLL), trial.valid(POSE_WALL_PITCH));
  std::vector<Eigen::Vector3d> ups;
  std::vector<double> heights, sigmas, levels, points, areas, rms;
  for (const pose_wall_result& r : trial.results()) {
    const pose_wall_value &roll = r.quantity[POSE_WALL_ROLL], &pitch = r.quantity[POSE_WALL_PITCH];
    if (!is_measured(roll)) continue;
    const Eigen::Vector3d up_base(r.floor.normal[0], r.floor.normal[1], r.floor.normal[2]);
    ups.push_back(mount.R_base_lidar().transpose() * up_base);
    heights.push_back(up_base.dot(mount.position_base_m()) + r.floor.d_m);
    sigmas.push_back(std::hypot(roll.sigma, pitch.sigma));
    levels.push_back(std::max(roll.protection_level, pitch.protection_level));
    points.push_back(r.floor.inliers);
    areas.push_back(r.floor.area_m2);
    rms.push_back(r.floor.rms_m);
  }
  if (ups.empty()) return seen;
  seen.up_lidar = median_direction(ups);
  std::vector<double> off_rad;
  off_rad.reserve(ups.size());
  for (const Eigen::Vector3d& up : ups) off_rad.push_back(angle_rad(up, seen.up_lidar));
  seen.tilt_spread_rad = quantile(off_rad, 0.9);
  seen.height_m = median(heights);
  seen.height_spread_m = spread90(heights);
  seen.tilt_sigma_rad = median(sigmas);
  seen.tilt_level_rad = median(levels);
  seen.points = median(points);
  seen.area_m2 = median(areas);
  seen.rms_m = median(rms);
  return seen;
}

void level_mount(api::Config& config, const Eigen::Vector3d& up_lidar) {
  // Of the same turns the one nearest to what was set, so that 3.14 does not become -3.14.
  const double before = config.number("extrinsic_roll");
  const double roll = std::atan2(up_lidar.y(), up_lidar.z());
  config.set("extrinsic_roll", before + std::remainder(roll - before, 2.0 * M_PI));
  config.set("extrinsic_pitch", std::atan2(-up_lidar.x(), std::hypot(up_lidar.y(), up_lidar.z())));
}

void flip_mount(api::Config& config) {
  config.set("extrinsic_roll", std::remainder(config.number("extrinsic_roll") + M_PI, 2.0 * M_PI));
}

double tilt_rad(const api::Config& config, const Eigen::Vector3d& up_lidar) {
  return angle_rad(SensorMount(config).R_base_lidar() * up_lidar, Eigen::Vector3d::UnitZ());
}

}  // namespace pose_wall::tools::doctor
