// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The directions in which the sensor looks at a plane.

#pragma once

#include "base/estimation/plane.hpp"
#include "cloud/direction_grid.hpp"
#include "walls/scene.hpp"

namespace pose_wall {

// Where the middles of the cells meet a plane.
class SightLines {
 public:
  static constexpr double kReach_m = 8.0;
  static constexpr double kFarReach_m = 10.0;

  // The sensor is on the plane's positive side.
  SightLines(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level);

  struct Crossing {
    bool near;       // within the reach of a close look, not too flat
    double along_m;  // along the road from the sensor
    double z_level_m;
  };
  Crossing at(std::uint32_t row, std::uint32_t column) const;
  // False only where at() is near in no row, as in about half of the columns; true where it may be.
  bool looks_towards(std::uint32_t column) const;
  // The same up to kFarReach_m and at a grazing angle, where a cell's middle says little about its edges.
  Crossing far(std::uint32_t row, std::uint32_t column) const;
  // Where else the sensor looks; along the road it may see nothing for being too far.
  enum Zone { kBeside, kAbove, kBelow, kAlong };
  Zone zone(std::uint32_t row, std::uint32_t column) const;
  // Sine of the elevation in the levelled frame.
  double up(std::uint32_t row, std::uint32_t column) const { return up_lidar_.dot(ray_lidar(row, column)); }
  // The column that looks straight away from the plane.
  std::uint32_t column_away() const;

 private:
  Crossing within(double reach_m, double towards_min, std::uint32_t row, std::uint32_t column) const;
  Eigen::Vector3d ray_lidar(std::uint32_t row, std::uint32_t column) const {
    return {column_[column].x * flat_[row], column_[column].y * flat_[row], DirectionGrid::up(row)};
  }

  DirectionGrid::Column column_[DirectionGrid::kColumns];
  double flat_[DirectionGrid::kRows];  // cosines of the elevations
  double inside_m_, sensor_z_level_m_;
  Eigen::Vector3d n_lidar_, along_lidar_, up_lidar_;
};

}  // namespace pose_wall
