// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/normal_equations.hpp"

#include <Eigen/LU>
#include <cmath>

namespace pose_wall {

double NormalEquations::smaller_spread_m() const {
  if (!(w_ > 0.0)) return 0.0;
  const double mu = wu_ / w_, mv = wv_ / w_;
  const double uu = wuu_ / w_ - mu * mu, vv = wvv_ / w_ - mv * mv, uv = wuv_ / w_ - mu * mv;
  // Smaller eigenvalue of the 2 x 2 scatter.
  const double mean = 0.5 * (uu + vv), half = 0.5 * (uu - vv);
  const double smaller = mean - std::sqrt(half * half + uv * uv);
  return smaller > 0.0 ? std::sqrt(smaller) : 0.0;
}

bool NormalEquations::solve(double spread_min_m, Eigen::Vector3d* solution) const {
  if (!(smaller_spread_m() >= spread_min_m)) return false;
  *solution = information().inverse() * right_side();
  return true;
}

}  // namespace pose_wall
