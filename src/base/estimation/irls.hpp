// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "base/containers/point_set.hpp"
#include "base/estimation/plane.hpp"
#include "base/estimation/tangent_points.hpp"

namespace pose_wall {

// Metres and slopes: a fit that is followed by one over patches, which takes a step of its own, may stop here. Saved
// 0.9 M of 107.5 M instructions (bench/README.md); a twentieth of a millimetre is far below any level.
constexpr double kBeforePatches = 5e-5;

struct IrlsSettings {
  double gate_m;       // larger residuals do not count, not even in the scale
  double scale_min_m;  // the scale is kept within these
  double scale_max_m;
  int rounds;
  // Metres and slopes. Far below the accuracy of any fit, and above the rounding of sums of floats.
  double stands_still = 3e-6;
  // Number of residuals for the scale, a third of it at least. A thousand give it to four per cent, which hardly
  // changes the weights.
  std::uint32_t scale_points = 1024;
};

// A few rounds on a part of the points, to compare hypotheses: a scale to a tenth is enough.
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

// Iteratively reweighted least squares with Tukey weights, from a start that is already near, on the first `count`
// points. A point weighs by the number that it stands for (TangentPoints::weight, capped) times Tukey. Points without
// weight do not count, not even in the scale.
IrlsOver irls_tukey(const TangentPoints& points, std::uint32_t count, const PlaneOver& start,
                    const IrlsSettings& settings);

struct IrlsResult {
  Plane plane;
  PlaneOver over;  // the same plane, over the one it began with
  double scale_m = 0.0;
  bool solved = false;
  std::uint64_t work = 0;
};

// The same on points of a cloud. Takes no more points than fit: thin longer lists before (even_share.hpp). Leaves its
// points in `points`, in the frame of its first plane.
IrlsResult irls_tukey(const PointSet& cloud, Span<const std::uint32_t> indices, const Plane& start,
                      const Eigen::Vector3d& u_hint, const IrlsSettings& settings, TangentPoints* points);

}  // namespace pose_wall
