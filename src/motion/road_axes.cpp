// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/road_axes.hpp"

#include <cmath>

#include "base/estimation/small_cholesky.hpp"

namespace pose_wall::motion {
namespace {

// Cosine of 45 degrees to the machine's up. The sixteen rings of a VLP-16 see little floor and roof, and know least
// which way is up (engine_with_motion_test). No road is as steep: halfway between the two.
constexpr double kUpright = 0.7;
constexpr std::uint32_t kEvery = 8;     // an axis needs no more normals than every eighth
constexpr double kNormalsLeast = 10.0;  // of these: fewer are of one surface or two

// By inverse iteration: the smallest eigenvalue is far below the others on a road, and any axis does in a hall.
bool least_known(const Eigen::Matrix3d& N, Eigen::Vector3d* axis) {
  const SmallCholesky<3> factor(N);
  if (!factor.solved()) return false;
  for (int k = 0; k < 8; ++k) {
    *axis = factor.solve(*axis);
    *axis /= std::sqrt(axis->squaredNorm());
  }
  return true;
}

}  // namespace

RoadAxes find_axes(const Scan& scan, const Pose& pose, const Eigen::Vector3d& forward_map, const RoadAxes& before) {
  RoadAxes axes = before;
  const LocalPose local(pose, scan.map->corner());
  Eigen::Matrix3d N = Eigen::Matrix3d::Zero();
  for (std::uint32_t i = 0; i < scan.observation.size(); i += kEvery) {
    Fit fit;
    if (!fit_observation(scan, local, scan.observation[i], &fit)) continue;
    if (fit.surface.tile->stands_free != 0) continue;
    const Eigen::Vector3d n = fit.normal.cast<double>();
    // By how near it is. What faces along lies off while the way is not known yet, and must still count.
    const double off = static_cast<double>(fit.surface.above_m / kLayer_m), near = 1.0 - off * off;
    N += near * near * n * n.transpose();
  }
  const double all = N.trace();
  if (!(all > kNormalsLeast)) return axes;
  N.diagonal().array() += 1e-6 * all;
  const Eigen::Vector3d up = pose.R.col(2);
  Eigen::Vector3d axis = before.along;
  if (!least_known(N, &axis)) return axes;
  if (std::fabs(axis.dot(up)) > kUpright) {
    axis = forward_map;
    if (!least_known(N + all * up * up.transpose(), &axis)) return axes;
  }
  if (axis.dot(forward_map) < 0.0) axis = -axis;
  const double least = axis.dot(N * axis);
  axes.along = axis;

  const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(axis);
  const double flat = std::sqrt(left.squaredNorm());
  axes.left = flat > 0.1 ? Eigen::Vector3d(left / flat) : Eigen::Vector3d(Eigen::Vector3d::UnitY());
  axes.up = axis.cross(axes.left);
  axes.hold = least / axes.left.dot(N * axes.left);
  return axes;
}

bool faces_along(const Eigen::Vector3f& normal, const Eigen::Vector3f& along) {
  return std::fabs(along.dot(normal)) > kFaces;
}

}  // namespace pose_wall::motion
