// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/direction.hpp"

#include <cmath>

#include "base/math/elementary.hpp"

namespace pose_wall {
namespace {

// 0.2 degrees that no fit covers: scans skewed by motion, walls that are no planes. Prevents one wall from setting the
// direction alone.
constexpr double kModelError_rad = 0.0035;  // swept: half 1 won, twice 164 moved

// A doubtful wall must not turn a good one.
bool can_share(const JudgedWall& wall) {
  return !wall.fit.refused && (wall.fit.reasons & kDoubts) == 0;
}

// 1 up to the limit, falling to 0 at twice the limit.
double share_of(double difference_rad, double limit_rad) {
  if (!(limit_rad > 0.0)) return 0.0;
  const double beyond = std::fabs(difference_rad) / limit_rad - 1.0;
  if (beyond <= 0.0) return 1.0;
  return beyond < 1.0 ? 1.0 - beyond : 0.0;
}

// Turns the plane about the vertical through the pivot.
Plane turned(const Plane& plane, const Eigen::Vector3d& pivot, double angle_rad) {
  const double c = cosine(angle_rad), s = sine(angle_rad);
  Plane out;
  out.n = Eigen::Vector3d(c * plane.n.x() - s * plane.n.y(), s * plane.n.x() + c * plane.n.y(), plane.n.z());
  out.d = plane.d + plane.n.dot(pivot) - out.n.dot(pivot);
  return out;
}

void turn(const WallScene& scene, int side, double angle_rad, JudgedWall* wall) {
  wall->fit.plane = turned(wall->fit.plane, wall->pivot_level_m, angle_rad);
  wall->along_level = along_of(wall->fit.plane, scene.forward_level);
  for (int end = 0; end < 2; ++end) {
    const double before = wall->distance_m[end];
    wall->distance_m[end] = distance_at(wall->fit.plane, scene.sample_level_m[side][end]);
    wall->distance_bound_m[end][POSE_WALL_PART_BEND] += std::fabs(wall->distance_m[end] - before);
  }
}

}  // namespace

void share_direction(const WallScene& scene, JudgedWall (*walls)[2]) {
  JudgedWall& left = (*walls)[0];
  JudgedWall& right = (*walls)[1];
  if (!can_share(left) || !can_share(right)) return;
  const double difference = left.yaw_rad - right.yaw_rad;
  const double share = share_of(difference, radians(scene.settings.wall_parallel_within_deg));
  const double model2 = kModelError_rad * kModelError_rad;
  const double left_variance = left.yaw_sigma_rad * left.yaw_sigma_rad + model2;
  const double right_variance = right.yaw_sigma_rad * right.yaw_sigma_rad + model2;
  const double sum = left_variance + right_variance;
  turn(scene, 0, -share * difference * left_variance / sum, &left);
  turn(scene, 1, share * difference * right_variance / sum, &right);
}

}  // namespace pose_wall
