// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "peer_pcl_settings.hpp"

#include <cmath>
#include <stdexcept>

namespace pose_wall::bench {
namespace {

constexpr double kRadPerDeg = 0.017453292519943295;

Eigen::Affine3f extrinsic(const api::Config& config) {
  using Turn = Eigen::AngleAxisd;
  using Vector = Eigen::Vector3d;
  const Eigen::Affine3d base_from_lidar =
      Eigen::Translation3d(config.number("extrinsic_x"), config.number("extrinsic_y"), config.number("extrinsic_z")) *
      Turn(config.number("extrinsic_yaw"), Vector::UnitZ()) * Turn(config.number("extrinsic_pitch"), Vector::UnitY()) *
      Turn(config.number("extrinsic_roll"), Vector::UnitX());
  return base_from_lidar.cast<float>();
}

std::vector<Eigen::AlignedBox3f> body_boxes(const api::Config& config) {
  std::vector<Eigen::AlignedBox3f> boxes;
  for (const char* key : {"body_box_1", "body_box_2", "body_box_3", "body_box_4"}) {
    double b[6] = {};
    const bool is_set = pose_wall_config_get_box(config.get(), key, b) == POSE_WALL_OK && b[0] < b[1];
    if (!is_set) continue;
    boxes.emplace_back(Eigen::Vector3d(b[0], b[2], b[4]).cast<float>(),
                       Eigen::Vector3d(b[1], b[3], b[5]).cast<float>());
  }
  return boxes;
}

}  // namespace

PclSettings pcl_settings(const api::Config& config, float ground_radius_m) {
  const auto real = [&](const char* key) { return static_cast<float>(config.number(key)); };
  const auto whole = [&](const char* key) { return static_cast<int>(config.number(key)); };
  PclSettings s;
  s.base_from_lidar = extrinsic(config);
  s.range_min_m = real("range_min");
  s.range_max_m = real("range_max");
  s.body_boxes_base = body_boxes(config);
  s.voxel_leaf_m = real("voxel_leaf");
  s.outlier_radius_m = config.number("outlier_radius");
  s.outlier_min_neighbors = whole("outlier_min_neighbors");
  s.ground_radius_m = ground_radius_m;
  s.ground_percentile = config.number("ground_z_percentile") / 100.0;
  s.ground_tilt_max_rad = config.number("ground_tilt_max_deg") * kRadPerDeg;
  s.ground_threshold_m = config.number("ground_ransac_thresh");
  s.ground_iterations = whole("ground_iterations");
  s.wall_z_min_m = real("wall_z_min");
  s.wall_z_max_m = real("wall_z_max");
  s.wall_voxel_leaf_m = real("wall_voxel_leaf");
  s.wall_lean_max_rad = config.number("wall_lean_max_deg") * kRadPerDeg;
  s.wall_threshold_m = config.number("wall_ransac_thresh");
  s.wall_iterations = whole("wall_iterations");
  s.s_front_m = config.number("s_front");
  s.s_back_m = config.number("s_back");
  return s;
}

float best_ground_radius_m(const std::string& sensor, PclMethod method) {
  struct Best {
    const char* sensor;
    float ransac_m, mlesac_m;
  };
  // Of 3, 5, 7, 10 and 15 m the one of the least RMS error of roll and pitch: `--roads 30 --frames 1
  // --pcl-ground-radius M`.
  constexpr Best kBest[] = {
      {"vlp16", 15.0F, 10.0F}, {"mid360", 15.0F, 5.0F}, {"os1-64", 10.0F, 15.0F}, {"os0-128", 10.0F, 3.0F}};
  for (const Best& best : kBest) {
    if (sensor == best.sensor) return method == PclMethod::kRansac ? best.ransac_m : best.mlesac_m;
  }
  throw std::invalid_argument("no radius is known to be best for PCL on " + sensor);
}

}  // namespace pose_wall::bench
