// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/normal_equations.hpp"

#include <Eigen/LU>
#include <cmath>

namespace pose_wall {

double NormalEquations::Scatter::radius() const {
  return std::sqrt(half * half + uv * uv);
}

NormalEquations::Scatter NormalEquations::scatter() const {
  const double mu = wu_ / w_, mv = wv_ / w_;
  const double uu = wuu_ / w_ - mu * mu, vv = wvv_ / w_ - mv * mv;
  return {0.5 * (uu + vv), 0.5 * (uu - vv), wuv_ / w_ - mu * mv};
}

double NormalEquations::smaller_spread_m() const {
  if (!(w_ > 0.0)) return 0.0;
  const Scatter s = scatter();
  const double smaller = s.mean - s.radius();
  return smaller > 0.0 ? std::sqrt(smaller) : 0.0;
}

// The angle of the main axis is half of that of (half, uv).
Eigen::Vector2d NormalEquations::main_direction() const {
  const Scatter s = scatter();
  const double radius = s.radius();
  if (!(radius > 0.0)) return {1.0, 0.0};
  const double cosine = std::sqrt(0.5 * (1.0 + s.half / radius)), sine = std::sqrt(0.5 * (1.0 - s.half / radius));
  return {cosine, s.uv < 0.0 ? -sine : sine};
}

bool NormalEquations::solve(double spread_min_m, Eigen::Vector3d* solution) const {
  if (!(smaller_spread_m() >= spread_min_m)) return false;
  *solution = information().inverse() * right_side();
  return true;
}

}  // namespace pose_wall
