// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <Eigen/Core>
#include <cmath>

namespace pose_wall {

// Of a symmetric matrix of the plane, as the spread of points or the information about a place. Without sines: the same
// bits at less cost.
struct PrincipalAxes {
  Eigen::Vector2d most;            // unit: the direction of the larger value
  double most_value, least_value;  // least_value may be rounded below 0

  PrincipalAxes(double xx, double xy, double yy) {
    const double half = 0.5 * (xx - yy), root = std::sqrt(half * half + xy * xy), middle = 0.5 * (xx + yy);
    most_value = middle + root;
    least_value = middle - root;
    // The longer of the two forms of the same vector; of a round matrix any direction will do.
    const Eigen::Vector2d first(half + root, xy), second(xy, root - half);
    const Eigen::Vector2d longer = first.squaredNorm() > second.squaredNorm() ? first : second;
    const double length = std::sqrt(longer.squaredNorm());
    most = length > 0.0 ? Eigen::Vector2d(longer / length) : Eigen::Vector2d(Eigen::Vector2d::UnitX());
  }
  Eigen::Vector2d least() const { return {-most.y(), most.x()}; }
};

}  // namespace pose_wall
