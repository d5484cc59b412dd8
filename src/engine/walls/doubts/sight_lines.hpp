// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The directions of the sensor: the returns expected from each, and where they meet a plane.

#pragma once

#include "base/estimation/plane.hpp"
#include "engine/cloud/direction_grid.hpp"
#include "engine/walls/scene.hpp"

namespace pose_wall {

// Expected returns of the directions of a frame, whatever plane is looked at.

// Number of returns of a cell of directions if nothing is dark. A sensor looks the same way all around, so each row is
// compared with itself.
class ExpectedReturns {
 public:
  void look_at(const DirectionGrid& returns_lidar);
  double at(std::uint32_t row, std::uint32_t column) const { return per_width_[row] * width_[column]; }

 private:
  double per_width_[DirectionGrid::kRows];
  double width_[DirectionGrid::kColumns];
};

// Columns in view. The two widest sectors without a return at any elevation are out of view: blocked, or beyond the
// field of view. More of them are gaps of a row of things with nothing behind it.
struct SeenColumns {
  void look_at(const DirectionGrid& returns_lidar, const ExpectedReturns& expected);
  bool is_seen[DirectionGrid::kColumns];
};

// The directions toward a plane.

// Points where the middles of the cells meet a plane.
class SightLines {
 public:
  // A direction (2.8 degrees) covers 0.4 m there; swept: half 1 won, twice 1 moved.
  static constexpr double kReach_m = 8.0;
  static constexpr double kFarReach_m = 10.0;  // low sensors see over a conveyor only so far ahead (README, Edges)

  // The sensor is on the plane's positive side.
  SightLines(const WallScene& scene, const Plane& wall, const Eigen::Vector3d& along_level);

  struct Crossing {
    bool near;       // within reach of a close look, and not too flat
    double along_m;  // along the road from the sensor
    double z_level_m;
  };
  Crossing at(std::uint32_t row, std::uint32_t column) const;
  // False only if at() is near in no row, as in about half of the columns; true where it may be.
  bool looks_towards(std::uint32_t column) const;
  // The same up to kFarReach_m and at any grazing angle, where a cell's middle says little about its edges.
  Crossing far(std::uint32_t row, std::uint32_t column) const;
  // Other zones of view. Along the road everything may be too far.
  enum Zone { kBeside, kAbove, kBelow, kAlong };
  Zone zone(std::uint32_t row, std::uint32_t column) const;
  // The column that looks straight away from the plane.
  std::uint32_t column_away() const;

 private:
  Crossing within(double reach_m, double towards_min, std::uint32_t row, std::uint32_t column) const;
  Eigen::Vector3d ray_lidar(std::uint32_t row, std::uint32_t column) const {
    return {column_[column].x * flat_[row], column_[column].y * flat_[row], up_[row]};
  }

  Directions::Column column_[Directions::kColumns];
  double up_[DirectionGrid::kRows];    // sines of the elevations
  double flat_[DirectionGrid::kRows];  // cosines of the elevations
  double inside_m_, sensor_z_level_m_;
  Eigen::Vector3d n_lidar_, along_lidar_, up_lidar_;
};

}  // namespace pose_wall
