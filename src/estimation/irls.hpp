// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "containers/point_set.hpp"
#include "estimation/plane.hpp"

namespace pose_wall {

struct IrlsSettings {
  double gate_m;       // residuals beyond play no part, nor in the scale
  double scale_min_m;  // the scale is kept within these
  double scale_max_m;
  int rounds;
};

struct IrlsResult {
  Plane plane;
  double scale_m = 0.0;
  bool solved = false;  // false: too few points, or all on a line
};

// Iteratively reweighted least squares with Tukey weights around a start that is near already. Points weigh by what
// they stand for (PointSet::weight, capped) times Tukey. residuals: scratch as long as indices.
IrlsResult irls_tukey(const PointSet& points, Span<const std::uint32_t> indices, const Plane& start,
                      const Eigen::Vector3d& u_hint, const IrlsSettings& settings, Span<float> residuals);

// Residual of each indexed point.
void signed_distances(const PointSet& points, Span<const std::uint32_t> indices, const Plane& plane,
                      Span<float> residuals);

}  // namespace pose_wall
