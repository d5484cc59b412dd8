// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <Eigen/Core>

namespace pose_wall {

// n . p + d = 0 with |n| = 1.
struct Plane {
  Eigen::Vector3d n = Eigen::Vector3d::UnitZ();
  double d = 0.0;

  double signed_distance(const Eigen::Vector3d& p) const { return n.dot(p) + d; }
  Plane flipped() const { return {-n, -d}; }
};

}  // namespace pose_wall
