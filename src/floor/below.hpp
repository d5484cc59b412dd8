// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What lies below a plane that may be the floor: nothing does, but for reflections in wet ground.

#pragma once

#include "floor/evidence.hpp"

namespace pose_wall {

// Whether more than a share of all points within the radius lie below the marked plane without being reflections in it.
// Nothing does below a floor; below a deck, a bench or a table there is floor, seen past the edge. The radius is that
// of find_open, which counted all points within it.
bool has_much_below(const FloorGrid& marked, const Plane& marked_plane, const BoundedPoints& points_base,
                    double radius_m, const Eigen::Vector3d& sensor_base_m, double share_max);

// Share of the open points on 'below' whose ray from the sensor passes through open floor of the plane marked in the
// grid: no light comes through a floor, so such a plane is a reflection in wet ground.
double share_seen_through(const FloorGrid& marked, const Plane& marked_plane, const Plane& below,
                          const PointSet& open_base, const Eigen::Vector3d& sensor_base_m, double thresh_m);

}  // namespace pose_wall
