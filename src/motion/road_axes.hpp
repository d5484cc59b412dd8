// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The axes of the road: along is where the surfaces hold a scan least.

#pragma once

#include "motion/gates.hpp"
#include "motion/surface_fit.hpp"

namespace pose_wall::motion {

// The road's axes in the map: along is where the surfaces give least hold.
struct RoadAxes {
  Eigen::Vector3d along = Eigen::Vector3d::UnitX(), left = Eigen::Vector3d::UnitY(), up = Eigen::Vector3d::UnitZ();
  double hold = 0.0;  // information of the surfaces' normals along it, over that across; 1: a hall, 0: a smooth road

  // Planes that face along give the way by themselves. Along a road there are none: surfaces that look so are relief.
  bool tell_along() const { return !passes<gate::ROAD>(hold); }
  // Turns from the map into the road.
  Eigen::Matrix3d in_road() const {
    Eigen::Matrix3d rows;
    rows << along.transpose(), left.transpose(), up.transpose();
    return rows;
  }
};
// By the surfaces that the scan meets at a pose. Where too few are met, the axes before.
RoadAxes find_axes(const Scan& scan, const Pose& pose, const Eigen::Vector3d& forward_map, const RoadAxes& before);

bool faces_along(const Eigen::Vector3f& normal, const Eigen::Vector3f& along);

}  // namespace pose_wall::motion
