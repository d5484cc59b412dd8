// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "floor/below.hpp"

#include <cmath>

#include "base/estimation/near_plane.hpp"

namespace pose_wall {

bool has_much_below(const FloorGrid& marked, const Plane& marked_plane, const BoundedPoints& points_base,
                    double radius_m, const Eigen::Vector3d& sensor_base_m, double share_max) {
  // The floor may fall away from its local plane by this much, and more the farther away.
  constexpr double kBelow_m = 0.2;
  constexpr double kFall = 0.03;
  const double limit2 = radius_m * radius_m, sensor_height_m = marked_plane.signed_distance(sensor_base_m);
  const auto most = static_cast<std::uint32_t>(share_max * marked.points_within());
  std::uint32_t below = 0;
  const Slab low(marked_plane, kAnyDepth_m, -kBelow_m);
  for_each_in_while(points_base, low, [&](std::uint32_t i, float height_m) {
    const Eigen::Vector3d p = points_base.at(i);
    const double away2 = p.head<2>().squaredNorm(), height = static_cast<double>(height_m);
    if (!(away2 <= limit2) || !(height < -(kBelow_m + kFall * std::sqrt(away2)))) return true;
    const Eigen::Vector3d crossing =
        sensor_base_m + (p - sensor_base_m) * (sensor_height_m / (sensor_height_m - height));
    if (!marked.marked_behind(sensor_base_m, crossing)) ++below;
    return below <= most;
  });
  return below > most;
}

double share_seen_through(const FloorGrid& marked, const Plane& marked_plane, const Plane& below,
                          const PointSet& open_base, const Eigen::Vector3d& sensor_base_m, double thresh_m) {
  const double sensor_height_m = marked_plane.signed_distance(sensor_base_m);
  std::uint32_t on_below = 0, through = 0;
  for (std::uint32_t i = 0; i < open_base.count; ++i) {
    const Eigen::Vector3d p = open_base.at(i);
    if (!(std::fabs(below.signed_distance(p)) <= thresh_m)) continue;
    ++on_below;
    const double height = marked_plane.signed_distance(p);
    if (!(height < -2.0 * thresh_m)) continue;
    const Eigen::Vector3d crossing =
        sensor_base_m + (p - sensor_base_m) * (sensor_height_m / (sensor_height_m - height));
    if (marked.marked_near(crossing.x(), crossing.y())) ++through;
  }
  return on_below > 0 ? static_cast<double>(through) / static_cast<double>(on_below) : 0.0;
}

}  // namespace pose_wall
