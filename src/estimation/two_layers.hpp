// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Ribs, cables and mesh in front of a surface: a second layer of residuals, always on the sensor's side.

#pragma once

#include <cstdint>

#include "containers/span.hpp"

namespace pose_wall {

// Two Gaussians of one width: the surface around `centre_m` and, `step_m` nearer to the sensor, what stands out of it.
struct TwoLayers {
  bool found = false;
  double centre_m = 0.0;  // of the surface, relative to the plane
  double sigma_m = 0.0;
  double step_m = 0.0;
  double share = 0.0;  // of the points that belong to the nearer layer

  // Probability that a point with this residual belongs to the surface.
  double surface_probability(double residual_m) const;
};

// Expectation maximisation on a histogram of the residuals within +-gate_m (positive: towards the sensor). found only
// where the two layers are clearly apart and both hold a fair share: a single rough surface has no second layer.
TwoLayers find_two_layers(Span<const float> residuals, double gate_m, double sigma_min_m);

// How far the residuals within +-gate_m lean towards the sensor: half the sum of their 20 % and 80 % quantiles about
// the median. Near 0 for rock, positive where something stands out of it that could not be told apart.
double lean_towards_sensor(Span<const float> residuals, double gate_m);

}  // namespace pose_wall
