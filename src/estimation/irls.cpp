// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "estimation/irls.hpp"

#include "estimation/normal_equations.hpp"
#include "estimation/robust_scale.hpp"
#include "estimation/tangent_frame.hpp"
#include "estimation/tukey.hpp"

namespace pose_wall {
namespace {

// A voxel right in front of the sensor stands for hundreds of points, but the rock under it is one piece.
constexpr double kWeightCap = 8.0;
constexpr double kSpreadMin_m = 0.05;
constexpr double kConverged = 1e-7;

double capped(float weight) {
  const double w = static_cast<double>(weight);
  return w < kWeightCap ? w : kWeightCap;
}

Eigen::Vector3d centroid_within(const PointSet& points, Span<const std::uint32_t> indices, Span<const float> residuals,
                                double gate_m) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double count = 0.0;
  for (std::uint32_t k = 0; k < indices.size(); ++k) {
    const double r = static_cast<double>(residuals[k]);
    if (!(r >= -gate_m && r <= gate_m)) continue;
    sum += points.at(indices[k]);
    count += 1.0;
  }
  return count > 0.0 ? Eigen::Vector3d(sum / count) : sum;
}

}  // namespace

void signed_distances(const PointSet& points, Span<const std::uint32_t> indices, const Plane& plane,
                      Span<float> residuals) {
  for (std::uint32_t k = 0; k < indices.size(); ++k) {
    residuals[k] = static_cast<float>(plane.signed_distance(points.at(indices[k])));
  }
}

IrlsResult irls_tukey(const PointSet& points, Span<const std::uint32_t> indices, const Plane& start,
                      const Eigen::Vector3d& u_hint, const IrlsSettings& settings, Span<float> residuals) {
  IrlsResult result;
  result.plane = start;
  for (int round = 0; round < settings.rounds; ++round) {
    const Span<float> r = residuals.first(indices.size());
    signed_distances(points, indices, result.plane, r);
    double scale = robust_scale(r, settings.gate_m);
    if (scale < settings.scale_min_m) scale = settings.scale_min_m;
    if (scale > settings.scale_max_m) scale = settings.scale_max_m;
    result.scale_m = scale;

    const TangentFrame frame =
        tangent_frame(result.plane, centroid_within(points, indices, r, settings.gate_m), u_hint);
    NormalEquations equations;
    for (std::uint32_t k = 0; k < indices.size(); ++k) {
      const double residual = static_cast<double>(r[k]);
      if (!(residual >= -settings.gate_m && residual <= settings.gate_m)) continue;
      const double w = tukey_weight(residual, scale);
      if (!(w > 0.0)) continue;
      const Eigen::Vector3d p = points.at(indices[k]) - frame.origin;
      equations.add(frame.u.dot(p), frame.v.dot(p), residual, w * capped(points.weight[indices[k]]));
    }
    Eigen::Vector3d correction;
    result.solved = equations.solve(kSpreadMin_m, &correction);
    if (!result.solved) return result;
    result.plane = corrected(result.plane, frame, correction);
    if (correction.cwiseAbs().maxCoeff() < kConverged) break;
  }
  return result;
}

}  // namespace pose_wall
