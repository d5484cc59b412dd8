// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include "base/simd/four_floats.hpp"

namespace pose_wall {

// Tukey's biweight: 95 % efficient on Gaussian residuals with this cutoff (Holland and Welsch 1977).
constexpr double kTukeyCutoff = 4.685;

// Weight of a residual for a given scale: (1 - (r / (c s))^2)^2 inside, 0 outside.
inline double tukey_weight(double residual, double scale) {
  const double x = residual / (kTukeyCutoff * scale);
  const double left = 1.0 - x * x;
  return left > 0.0 ? left * left : 0.0;
}

// Full weight within flat_m, Tukey's fall beyond. Voxel faces along the surface split the noise of its points into two
// thin layers of different weight. A weight that depends on the residual of a centroid then biases the fit. So within
// the noise of the sensor nothing may depend on the residual.
inline double flat_top_weight(double residual_m, double flat_m, double scale_m) {
  const double size = residual_m < 0.0 ? -residual_m : residual_m;
  return size > flat_m ? tukey_weight(size - flat_m, scale_m) : 1.0;
}

// Of four residuals; per_cutoff: 1 / (kTukeyCutoff scale).
inline FourFloats tukey_weights(FourFloats residuals, float per_cutoff) {
  const FourFloats x = residuals * per_cutoff, left = 1.0F - x * x, none{};
  const FourFloats some = left > none ? left : none;
  return some * some;
}

inline FourFloats flat_top_weights(FourFloats residuals_m, float flat_m, float per_cutoff) {
  const FourFloats beyond = magnitude_of(residuals_m) - flat_m, none{};
  return tukey_weights(beyond > none ? beyond : none, per_cutoff);
}

}  // namespace pose_wall
