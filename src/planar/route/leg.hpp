// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A route as straight stretches with turns on the spot between them, and its cost.

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "base/containers/span.hpp"
#include "place/pose2.hpp"

namespace pose_wall::planar::route {

struct Costs {
  double turn_m_rad = 0.5;  // metres of way that a radian of turning is worth
  double reverse = 1.0;     // a metre backwards, in metres forwards
  double cusp_m = 0.0;      // of a change between forwards and backwards

  double of_stretch(double length_m, std::int32_t gear) const { return gear < 0 ? reverse * length_m : length_m; }
  double of_turn(double turn_rad) const { return turn_m_rad * (turn_rad < 0.0 ? -turn_rad : turn_rad); }
};

// A place where the machine turns by turn_rad and leaves straight in `gear` (1 forwards, -1 backwards) with yaw_rad.
// The last one of a route is left in no direction: gear 0 and the goal's yaw.
struct Corner {
  double x_m = 0.0, y_m = 0.0, yaw_rad = 0.0, turn_rad = 0.0;
  std::int32_t gear = 0;
  std::uint32_t tried = 0;  // steps by which moving it was no use, a bit each

  Eigen::Vector2d place() const { return {x_m, y_m}; }
  Pose2 left_as() const { return {x_m, y_m, yaw_rad}; }
};

// The yaw of a machine that drives from a to b; `otherwise` if they are one place.
inline double driving_yaw(const Eigen::Vector2d& a, const Eigen::Vector2d& b, std::int32_t gear, double otherwise) {
  const Eigen::Vector2d way = b - a;
  if (!(way.squaredNorm() > 1e-12)) return otherwise;
  return gear < 0 ? arc_tangent2(-way.y(), -way.x()) : arc_tangent2(way.y(), way.x());
}

}  // namespace pose_wall::planar::route
