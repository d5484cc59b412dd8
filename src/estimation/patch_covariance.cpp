// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// What a patch fit knows of its own errors: correlation of the rock, covariance, and whether the surface is a plane.

#include <Eigen/Cholesky>
#include <cmath>

#include "estimation/patch_fit.hpp"

namespace pose_wall {
namespace {

// The quadratic must explain this much more (chi-square with 3 degrees of freedom: 1 in 10^4 by chance).
constexpr double kBendChi2 = 21.1;
constexpr double kBendShare = 0.6;
constexpr double kBendPatchesMin = 20.0;
constexpr double kCorrelationMax = 0.95;
constexpr double kVisibilityPerPatch = 0.8;
constexpr double kNoiseLooksRough = 0.05;

}  // namespace

double PatchFit::variance_at(double u_m, double v_m) const {
  const Eigen::Vector3d a(1.0, u_m, v_m);
  return a.dot(covariance * a);
}

double PatchFit::bend_at(double u, double v) const {
  return bend[0] + bend[1] * u + bend[2] * v + bend[3] * u * u + bend[4] * u * v + bend[5] * v * v;
}

double PatchFit::bend_slope_u_at(double u, double v) const {
  return bend[1] + 2.0 * bend[3] * u + bend[4] * v;
}

double PatchFit::bend_slope_v_at(double u, double v) const {
  return bend[2] + bend[4] * u + 2.0 * bend[5] * v;
}

// Each unordered pair of patches of one layer up to kLags apart, once.
template <typename Visit>
void PatchGrid::for_each_pair(std::uint32_t n, const Visit& visit) const {
  const auto columns = static_cast<std::int32_t>(columns_), rows = static_cast<std::int32_t>(rows_);
  for (std::uint32_t i = 0; i < n; ++i) {
    const Mean& p = means_[i];
    for (std::int32_t dv = 0; dv <= kLags && p.iv + dv < rows; ++dv) {
      for (std::int32_t du = dv == 0 ? 1 : -kLags; du <= kLags; ++du) {
        const std::int32_t iu = p.iu + du;
        if (iu < 0 || iu >= columns) continue;
        const auto row = p.layer * rows_ + static_cast<std::uint32_t>(p.iv + dv);
        const std::int32_t j = mean_of_cell_[row * columns_ + static_cast<std::uint32_t>(iu)];
        const int lag = static_cast<int>(std::sqrt(static_cast<double>(du * du + dv * dv)) + 0.5);
        if (lag <= kLags && j >= 0) visit(p, means_[static_cast<std::uint32_t>(j)], lag);
      }
    }
  }
}

// Correlation of the rock by distance between patches, from products of errors. Errors about a fitted plane are smaller
// than the rock is, and more so the fewer independent patches there are: the fit's own variance is given back to them.
void PatchGrid::measure_correlation(std::uint32_t n, const Eigen::Matrix3d& fitted,
                                    Roughness (*roughness)[kLayersMax]) const {
  double products[kLayersMax][kLags + 1] = {};
  double pairs[kLayersMax][kLags + 1] = {};
  for_each_pair(n, [&](const Mean& p, const Mean& o, int lag) {
    products[p.layer][lag] += p.error * o.error + p.a.dot(fitted * o.a);
    pairs[p.layer][lag] += 1.0;
  });
  for (std::uint32_t layer = 0; layer < layers_; ++layer) {
    Roughness& rough = (*roughness)[layer];
    double upper = kCorrelationMax;
    for (int lag = 1; lag <= kLags; ++lag) {
      const double measured =
          pairs[layer][lag] > 0.0 && rough.tau2 > 0.0 ? products[layer][lag] / (pairs[layer][lag] * rough.tau2) : 0.0;
      rough.at_lag[lag] = measured < 0.0 ? 0.0 : (measured > upper ? upper : measured);
      upper = rough.at_lag[lag];
    }
  }
}

// Variance of the rock between patches, with what the fit took from it beyond the leverage of independent patches.
void PatchGrid::give_back(std::uint32_t n, const Eigen::Matrix3d& beyond, Roughness (*roughness)[kLayersMax]) const {
  double taken[kLayersMax] = {}, patches[kLayersMax] = {};
  for (const Mean& p : means_.first(n)) {
    taken[p.layer] += p.a.dot(beyond * p.a);
    patches[p.layer] += 1.0;
  }
  for (std::uint32_t layer = 0; layer < layers_; ++layer) {
    if (taken[layer] > 0.0) (*roughness)[layer].tau2 += taken[layer] / patches[layer];
  }
}

void PatchGrid::sandwich(std::uint32_t n, const Roughness (&roughness)[kLayersMax], const Eigen::Matrix3d& inverse,
                         PatchFit* out) const {
  Eigen::Matrix3d middle = Eigen::Matrix3d::Zero();
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  double sum[kLayersMax] = {}, squares[kLayersMax] = {};
  for (const Mean& p : means_.first(n)) {
    middle += p.information * p.information * (roughness[p.layer].tau2 + p.noise_variance) * p.a * p.a.transpose();
    bias += p.information * p.b_centred * p.a;
    sum[p.layer] += p.information;
    squares[p.layer] += p.information * p.information;
  }
  for_each_pair(n, [&](const Mean& p, const Mean& o, int lag) {
    const Roughness& rough = roughness[p.layer];
    if (rough.at_lag[lag] <= 0.0) return;
    const double covariance = rough.at_lag[lag] * rough.tau2, ww = p.information * o.information;
    middle += ww * covariance * (p.a * o.a.transpose() + o.a * p.a.transpose());
    // Only the rock's part is shared between patches; the noise of their points is their own.
    squares[p.layer] += 2.0 * ww * covariance * std::sqrt(ww);
  });
  out->covariance = inverse * middle * inverse;
  // Correlation can only cost; where the estimated one would promise more than independence, independence stands.
  for (int k = 0; k < 3; ++k) {
    if (!(out->covariance(k, k) >= inverse(k, k))) out->covariance = inverse;
  }
  out->bias_response = inverse * bias;
  const double independent = sum[0] * sum[0] / squares[0];
  out->dof = independent > 5.0 ? independent - 3.0 : 2.0;
  const double both = (sum[0] + sum[1]) * (sum[0] + sum[1]) / (squares[0] + squares[1]);
  out->dof_slope = layers_ == 1 ? out->dof : (both > 6.0 ? both - 4.0 : 2.0);
}

// Grows with the roughness and with its slopes, and those with the scatter inside a patch: factor and form are measured
// on simulated rock of 2 to 8 cm over 0.1 to 1 m. Scatter without roughness between patches is noise of the sensor.
double PatchGrid::visibility(double tau2) const {
  double scatter = 0.0, freedom = 0.0;
  for (const Patch& p : cells_.first(columns_ * rows_)) {
    if (p.count < 2) continue;
    scatter += p.rr - p.r * p.r / static_cast<double>(p.count);
    freedom += static_cast<double>(p.count - 1);
  }
  if (!(freedom > 0.0 && scatter > 0.0)) return 0.0;
  const double within2 = scatter / freedom;
  const double rock = tau2 / (tau2 + kNoiseLooksRough * within2);
  return kVisibilityPerPatch * cells_per_m_ * rock * std::sqrt(within2 * (within2 + tau2));
}

void PatchGrid::test_bend(std::uint32_t n, PatchFit* out) const {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Matrix6 m = Matrix6::Zero();
  Vector6 rhs = Vector6::Zero();
  double plane_chi2 = 0.0, patches = 0.0;
  for (const Mean& p : means_.first(n)) {
    if (p.layer != 0) continue;
    Vector6 a;
    a << 1.0, p.u, p.v, p.u * p.u, p.u * p.v, p.v * p.v;
    m += p.information * a * a.transpose();
    rhs += p.information * p.error * a;
    plane_chi2 += p.information * p.error * p.error;
    patches += 1.0;
  }
  // A faint pull to zero keeps directions without data from being made up (sparse rings: no spread in v).
  for (int k = 3; k < 6; ++k) m(k, k) *= 1.0 + 1e-6;
  const Eigen::LDLT<Matrix6> solver(m);
  const Vector6 bend = solver.solve(rhs);
  const double gain = bend.dot(rhs);  // chi-square explained by the quadratic terms
  if (solver.info() != Eigen::Success || !(gain >= 0.0) || !(gain <= 1.01 * plane_chi2)) return;
  const double per_patch = patches / (out->dof + 3.0);  // correlated patches count for fewer
  // A strong bend makes neighbouring patches err alike, which looks like few independent ones; but then it explains
  // most of what they err.
  out->bends = gain > kBendChi2 * per_patch || (patches >= kBendPatchesMin && gain > kBendShare * plane_chi2);
  Vector6 e = Vector6::Zero();
  e[5] = 1.0;
  out->curvature_v = bend[5];
  out->curvature_v_sigma = std::sqrt(per_patch * solver.solve(e)[5]);
  if (out->bends) out->bend = bend;
}

}  // namespace pose_wall
