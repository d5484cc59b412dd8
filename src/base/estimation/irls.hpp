// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "base/containers/point_set.hpp"
#include "base/estimation/plane.hpp"
#include "base/estimation/tangent_points.hpp"

namespace pose_wall {

// Metres and slopes: where a fit stands still that is followed by one over patches, which takes a step of its own.
// Saved 0.9 M of 107.5 M instructions (bench/README.md); a twentieth of a millimetre is far below any level.
constexpr double kBeforePatches = 5e-5;

struct IrlsSettings {
  double gate_m;       // residuals beyond play no part, nor in the scale
  double scale_min_m;  // the scale is kept within these
  double scale_max_m;
  int rounds;
  // Metres and slopes. The least is far below what any fit is worth, and above what sums of floats leave.
  double stands_still = 3e-6;
  // Of how many residuals the scale is told, a third of it at least: a thousand know it to four per cent, and the
  // weights hardly notice.
  std::uint32_t scale_points = 1024;
};

// A few rounds on a part of the points, to see which hypothesis is worth more: the scale to a tenth will do.
inline IrlsSettings quick_irls(double gate_m, double scale_min_m, double scale_max_m, int rounds) {
  IrlsSettings quick{gate_m, scale_min_m, scale_max_m, rounds};
  quick.scale_points = 256;
  return quick;
}

struct IrlsOver {
  PlaneOver over;
  double scale_m = 0.0;
  bool solved = false;  // false: too few points, or all on a line
  std::uint64_t work = 0;
};

// Iteratively reweighted least squares with Tukey weights around a start that is near already, on the first `count`
// points. Points weigh by what they stand for (TangentPoints::weight, capped) times Tukey; those without weight play no
// part, nor in the scale.
IrlsOver irls_tukey(const TangentPoints& points, std::uint32_t count, const PlaneOver& start,
                    const IrlsSettings& settings);

struct IrlsResult {
  Plane plane;
  PlaneOver over;  // the same plane, over the one it began with
  double scale_m = 0.0;
  bool solved = false;
  std::uint64_t work = 0;
};

// The same on points of a cloud. Of more than points has room for only the first are taken: who has more thins them
// before (even_share.hpp). What it was fitted on is left in points, in the frame of the plane it began with.
IrlsResult irls_tukey(const PointSet& cloud, Span<const std::uint32_t> indices, const Plane& start,
                      const Eigen::Vector3d& u_hint, const IrlsSettings& settings, TangentPoints* points);

}  // namespace pose_wall
