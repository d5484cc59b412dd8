// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "base/estimation/plane.hpp"

namespace pose_wall {

// Two axes in a plane and the point they start from: coordinates (u, v) of points, and the three small corrections a
// fit solves for (offset, slope along u, slope along v).
struct TangentFrame {
  Eigen::Vector3d origin;
  Eigen::Vector3d u;
  Eigen::Vector3d v;
};

// u is the in-plane direction nearest to u_hint (not parallel to the normal); v completes u, v, n right-handed.
inline TangentFrame tangent_frame(const Plane& plane, const Eigen::Vector3d& origin, const Eigen::Vector3d& u_hint) {
  TangentFrame f;
  f.origin = origin - plane.signed_distance(origin) * plane.n;
  f.u = (u_hint - u_hint.dot(plane.n) * plane.n).normalized();
  f.v = plane.n.cross(f.u);
  return f;
}

// The plane on which residual - (offset + slope_u u + slope_v v) vanishes.
inline Plane corrected(const Plane& plane, const TangentFrame& f, const Eigen::Vector3d& correction) {
  Plane out;
  out.n = plane.n - correction[1] * f.u - correction[2] * f.v;
  out.d = plane.d - correction[0] + correction[1] * f.u.dot(f.origin) + correction[2] * f.v.dot(f.origin);
  const double norm = std::sqrt(out.n.squaredNorm());
  out.n /= norm;
  out.d /= norm;
  return out;
}

}  // namespace pose_wall
