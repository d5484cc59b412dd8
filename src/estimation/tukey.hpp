// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

namespace pose_wall {

// Tukey's biweight: 95 % efficient on Gaussian residuals with this cutoff (Holland and Welsch 1977).
constexpr double kTukeyCutoff = 4.685;

// Weight of a residual for a given scale: (1 - (r / (c s))^2)^2 inside, 0 outside.
inline double tukey_weight(double residual, double scale) {
  const double x = residual / (kTukeyCutoff * scale);
  const double left = 1.0 - x * x;
  return left > 0.0 ? left * left : 0.0;
}

}  // namespace pose_wall
