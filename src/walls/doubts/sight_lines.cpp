// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "walls/doubts/sight_lines.hpp"

#include <cmath>

namespace pose_wall {
namespace {

// Cosine of the angle from the normal: rays that run along the plane say nothing about it.
constexpr double kTowardsMin = 0.2;

}  // namespace

SightLines::SightLines(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level)
    : inside_m_(wall.signed_distance(scene.sensor_level_m)), sensor_z_level_m_(scene.sensor_level_m.z()) {
  const Eigen::Matrix3d R_lidar_level = (scene.R_level_base * scene.extrinsic.R_base_lidar).transpose();
  n_lidar_ = R_lidar_level * wall.n;
  along_lidar_ = R_lidar_level * along_level;
  up_lidar_ = R_lidar_level.col(2);
  for (std::uint32_t c = 0; c < DirectionGrid::kColumns; ++c) column_[c] = DirectionGrid::column(c);
  for (std::uint32_t row = 0; row < DirectionGrid::kRows; ++row) {
    const double up = DirectionGrid::up(row);
    flat_[row] = std::sqrt(1.0 - up * up);
  }
}

SightLines::Crossing SightLines::at(std::uint32_t row, std::uint32_t column) const {
  return within(kReach_m, kTowardsMin, row, column);
}

bool SightLines::looks_towards(std::uint32_t column) const {
  constexpr double kLittleLess = 0.99;  // rounding may make a ray a little longer than 1
  // In the row that looks most towards the plane.
  const double flat = -(n_lidar_.x() * column_[column].x + n_lidar_.y() * column_[column].y);
  const double most2 = (flat > 0.0 ? flat * flat : 0.0) + n_lidar_.z() * n_lidar_.z();
  return most2 > kLittleLess * kTowardsMin * kTowardsMin;
}

SightLines::Crossing SightLines::far(std::uint32_t row, std::uint32_t column) const {
  return within(kFarReach_m, 0.0, row, column);
}

SightLines::Crossing SightLines::within(double reach_m, double towards_min, std::uint32_t row,
                                        std::uint32_t column) const {
  const Eigen::Vector3d ray = ray_lidar(row, column);
  const double towards = -n_lidar_.dot(ray);
  if (!(towards > towards_min && inside_m_ <= reach_m * towards)) return {false, 0.0, 0.0};
  const double range_m = inside_m_ / towards;
  return {true, range_m * along_lidar_.dot(ray), sensor_z_level_m_ + range_m * up_lidar_.dot(ray)};
}

SightLines::Zone SightLines::zone(std::uint32_t row, std::uint32_t column) const {
  constexpr double kAlongCos = 0.8;
  constexpr double kUpSine = 0.34;  // 20 degrees
  const Eigen::Vector3d ray = ray_lidar(row, column);
  if (std::fabs(along_lidar_.dot(ray)) > kAlongCos) return kAlong;
  const double up = up_lidar_.dot(ray);
  if (std::fabs(up) <= kUpSine) return kBeside;
  return up > 0.0 ? kAbove : kBelow;
}

std::uint32_t SightLines::column_away() const {
  std::uint32_t best = 0;
  double best_away = -2.0;
  for (std::uint32_t column = 0; column < DirectionGrid::kColumns; ++column) {
    const DirectionGrid::Column& c = column_[column];
    const double away = n_lidar_.x() * c.x + n_lidar_.y() * c.y;
    if (away > best_away) {
      best_away = away;
      best = column;
    }
  }
  return best;
}

}  // namespace pose_wall
