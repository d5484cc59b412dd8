// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How well any unbiased instrument could measure a frame: the Cramer-Rao bound of the very points it had.
//
// The road is taken for clean: one flat floor, flat parallel upright walls, and ranges with Gaussian noise along the
// ray. A point's distance from its plane then varies by range noise times |normal . ray|: far along a wall, where rays
// graze it, points tell its direction best. The model knows what the specification knows: a floor of three parameters,
// one direction for both walls, each wall its own lean and distance. Walls are planes of the levelled frame, so errors
// of the floor turn into errors of yaw and distances; that is part of the bound.

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "io/config_file/sensor_mount.hpp"
#include "io/csv/truth_csv.hpp"
#include "pose_wall.hpp"

namespace pose_wall::tools {

// Where the instrument says it looked: points elsewhere do not count.
struct View {
  double floor_distance_m;  // of the base origin, which the truth of the seven quantities does not tell
  double floor_radius_m;    // horizontal, about the base origin
  // Left, right: from where to where along the road, from the base origin. NaN: no wall measured on this side.
  std::array<std::array<double, 2>, 2> wall_span_m;
};

struct FrameBound {
  // Least standard deviation, in the order of pose_wall_quantity; NaN where the points do not tell.
  std::array<double, kTruthQuantities> sigma{kNoTruth, kNoTruth, kNoTruth, kNoTruth, kNoTruth, kNoTruth, kNoTruth};
  std::size_t floor_points = 0;
  std::array<std::size_t, 2> wall_points{};  // left, right
  // Root mean square of the points' distances from the true planes, in units of what the range noise makes of it: 1
  // on a clean road. Cut off at kGateInSigmas.
  double noise_ratio = kNoTruth;
};

class CramerRao {
 public:
  // Points belong to a plane when they lie within this many of their standard deviations.
  static constexpr double kGateInSigmas = 5.0;
  // Floor nearer to a wall does not count: the wall's foot is there, and the engine, by cells of a quarter metre, keeps
  // about as clear of what stands on the floor.
  static constexpr double kFoot_m = 0.25;

  // Of the config: axes, sampling points, mounting, range limits, body boxes and the wall band.
  CramerRao(const api::Config& config, double range_noise_m);

  FrameBound bound(const pose_wall_cloud& cloud, const std::array<double, kTruthQuantities>& truth,
                   const View& view) const;

 private:
  static constexpr int kParameters = 8;  // roll, pitch, floor distance, yaw, lean and distance of left, of right
  using Parameters = Eigen::Matrix<double, kParameters, 1>;
  using Information = Eigen::Matrix<double, kParameters, kParameters>;
  // Columns: floor, left, right; rows: normal and distance in base.
  using Planes = Eigen::Matrix<double, 4, 3>;
  using Quantities = Eigen::Matrix<double, kTruthQuantities, 1>;
  struct Slopes;
  struct Gathered;

  Parameters parameters_of(const std::array<double, kTruthQuantities>& truth, double floor_distance_m) const;
  Planes planes_of(const Parameters& parameters) const;
  Quantities quantities_of(const Parameters& parameters) const;
  Slopes slopes_at(const Parameters& parameters) const;
  Gathered gather(const pose_wall_cloud& cloud, const Parameters& parameters, const Slopes& slopes,
                  const View& view) const;

  double range_noise_m_;
  SensorMount mount_;
  Eigen::Vector3d forward_base_;
  std::array<Eigen::Vector3d, 4> samples_base_m_;  // left front, left back, right front, right back
  double wall_z_min_m_, wall_z_max_m_;
};

}  // namespace pose_wall::tools
