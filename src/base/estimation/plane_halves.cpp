// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/plane_halves.hpp"

#include <Eigen/LU>
#include <cmath>

#include "base/estimation/normal_equations.hpp"

namespace pose_wall {
namespace {

// With fewer patches the three terms of a plane leave too little to estimate their errors.
constexpr double kPatchesMin = 10.0;  // swept: half 9 moved, twice 19 moved
// A slope within two of its own standard deviations may be chance, and is no kerb.
constexpr double kOwnErrors = 2.0;  // swept: half 2 lost, twice 4 won

// Beyond a line through the origin, or before it.
struct Half {
  double u, v;  // across the line
  bool holds(const SurfacePatch& p) const { return u * p.u + v * p.v >= 0.0; }
};

double reach_of(const Half& half, Span<const SurfacePatch> patches, const Eigen::Vector3d& correction,
                const Eigen::Vector3d& response) {
  NormalEquations sums;
  double squares = 0.0;
  for (const SurfacePatch& p : patches) {
    if (!half.holds(p)) continue;
    const double r = p.residual - correction.dot(Eigen::Vector3d(1.0, p.u, p.v));
    sums.add(p.u, p.v, r, 1.0);
    squares += r * r;
  }
  const Eigen::Matrix3d m = sums.information();
  const double volume = m(0, 0) * m(1, 1) * m(2, 2), count = sums.weight();
  if (count < kPatchesMin || !(m.determinant() > 1e-6 * volume)) return 0.0;
  const Eigen::Matrix3d inverse = m.inverse();
  const Eigen::Vector3d slopes = inverse * sums.right_side();
  const double left = (squares - slopes.dot(sums.right_side())) / (count - 3.0);
  const double variance = (left > 0.0 ? left : 0.0) * response.dot(inverse * response);
  return std::fabs(response.dot(slopes)) - kOwnErrors * std::sqrt(variance);
}

}  // namespace

double reach_of_halves(Span<const SurfacePatch> patches, const Eigen::Vector3d& correction,
                       const Eigen::Vector3d& response) {
  double reach = 0.0;
  if (patches.size() == 0) return reach;
  // Along the road, too, as a kerb runs, whichever way the machine stands. A floor as wide as long has no length of its
  // own, and the axes are left.
  NormalEquations places;
  for (const SurfacePatch& p : patches) places.add(p.u, p.v, 0.0, 1.0);
  const Eigen::Vector2d a = places.main_direction();
  for (const Half& half : {Half{-a.x(), -a.y()}, Half{a.x(), a.y()}, Half{a.y(), -a.x()}, Half{-a.y(), a.x()},
                           Half{-1.0, 0.0}, Half{1.0, 0.0}, Half{0.0, -1.0}, Half{0.0, 1.0}}) {
    const double of_half = reach_of(half, patches, correction, response);
    reach = of_half > reach ? of_half : reach;
  }
  return reach;
}

}  // namespace pose_wall
