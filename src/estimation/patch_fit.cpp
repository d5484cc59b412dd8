// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "estimation/patch_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace pose_wall {
namespace {

// Tukey weights make residuals look smaller than they are and the estimate a little less efficient; together the
// variance of a mean is this much above sum(w r^2) / sum(w)^2 (Gaussian residuals, cutoff 4.685).
constexpr double kTukeyVariance = 1.16;
// A patch's own scatter counts like this many more points of the pooled scatter.
constexpr double kPriorPoints = 10.0;
constexpr std::uint32_t kPatchesMin = 8;
// Floor of the noise of one point: no LiDAR repeats better than a millimetre.
constexpr double kNoiseMin_m = 0.001;
// The quadratic must explain this much more (chi-square with 3 degrees of freedom: 1 in 10^4 by chance).
constexpr double kBendChi2 = 21.1;

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

void PatchGrid::lay_out(Arena& arena) {
  cells_ = arena.take<Patch>(kSide * kSide);
  means_ = arena.take<Mean>(kSide * kSide);
  mean_of_cell_ = arena.take<std::int32_t>(kSide * kSide);
}

void PatchGrid::begin(double u_min_m, double u_max_m, double v_min_m, double v_max_m, double patch_m) {
  const double extent = u_max_m - u_min_m > v_max_m - v_min_m ? u_max_m - u_min_m : v_max_m - v_min_m;
  const double fits = extent / static_cast<double>(kSide - 1);
  patch_m_ = patch_m > fits ? patch_m : fits;
  cells_per_m_ = 1.0 / patch_m_;
  u_min_ = u_min_m;
  v_min_ = v_min_m;
  cells_.fill(Patch{});
}

void PatchGrid::add(double u_m, double v_m, double residual_m, double weight, double bias) {
  const double fu = (u_m - u_min_) * cells_per_m_, fv = (v_m - v_min_) * cells_per_m_;
  if (!(fu >= 0.0 && fu < kSide && fv >= 0.0 && fv < kSide)) return;
  const std::uint32_t cell = static_cast<std::uint32_t>(fv) * kSide + static_cast<std::uint32_t>(fu);
  Patch& p = cells_[cell];
  p.w += weight;
  p.wu += weight * u_m;
  p.wv += weight * v_m;
  p.wr += weight * residual_m;
  p.wrr += weight * residual_m * residual_m;
  p.wb += weight * bias;
  ++p.count;
}

std::uint32_t PatchGrid::collect_means(PatchFit* out) {
  double scatter = 0.0, freedom = 0.0;
  for (const Patch& p : cells_) {
    if (p.count < 2) continue;
    scatter += p.wrr - p.wr * p.wr / p.w;
    freedom += static_cast<double>(p.count - 1);
  }
  double pooled = freedom > 0.0 ? kTukeyVariance * scatter / freedom : 0.0;
  if (!(pooled > kNoiseMin_m * kNoiseMin_m)) pooled = kNoiseMin_m * kNoiseMin_m;
  out->noise_m = std::sqrt(pooled);

  std::uint32_t n = 0;
  for (std::uint32_t c = 0; c < cells_.size(); ++c) {
    const Patch& p = cells_[c];
    mean_of_cell_[c] = -1;
    if (!(p.w > 1e-9)) continue;
    const double own = kTukeyVariance * (p.wrr - p.wr * p.wr / p.w);
    const double s2 = (kPriorPoints * pooled + (own > 0.0 ? own : 0.0)) / (kPriorPoints + p.count - 1.0);
    Mean& m = means_[n];
    m.u = p.wu / p.w;
    m.v = p.wv / p.w;
    m.r = p.wr / p.w;
    m.b = p.wb / p.w;
    m.noise_variance = s2 / p.w;
    m.information = 1.0 / m.noise_variance;
    m.iu = static_cast<std::int32_t>(c % kSide);
    m.iv = static_cast<std::int32_t>(c / kSide);
    mean_of_cell_[c] = static_cast<std::int32_t>(n++);
  }
  out->patches = n;
  return n;
}

bool PatchGrid::solve(std::uint32_t n, Eigen::Vector3d* solution, Eigen::Matrix3d* inverse) {
  Eigen::Matrix3d m = Eigen::Matrix3d::Zero();
  Eigen::Vector3d rhs = Eigen::Vector3d::Zero();
  for (const Mean& p : means_.first(n)) {
    const Eigen::Vector3d a(1.0, p.u, p.v);
    m += p.information * a * a.transpose();
    rhs += p.information * p.r * a;
  }
  const double volume = m(0, 0) * m(1, 1) * m(2, 2);
  if (!(volume > 0.0) || !(m.determinant() > 1e-9 * volume)) return false;
  *inverse = m.inverse();
  *solution = *inverse * rhs;
  for (Mean& p : means_.first(n)) {
    p.error = p.r - ((*solution)[0] + (*solution)[1] * p.u + (*solution)[2] * p.v);
  }
  return true;
}

// DerSimonian and Laird's moment estimate, with the leverage of the three fitted parameters taken out.
double PatchGrid::between_patch_variance(std::uint32_t n, const Eigen::Matrix3d& inverse) const {
  double q = 0.0, sum = 0.0;
  Eigen::Matrix3d squared = Eigen::Matrix3d::Zero();
  for (const Mean& p : means_.first(n)) {
    const Eigen::Vector3d a(1.0, p.u, p.v);
    q += p.information * p.error * p.error;
    sum += p.information;
    squared += p.information * p.information * a * a.transpose();
  }
  const double excess = q - (static_cast<double>(n) - 3.0);
  const double scale = sum - (inverse * squared).trace();
  return excess > 0.0 && scale > 0.0 ? excess / scale : 0.0;
}

// Each unordered pair of patches up to kLags apart, once.
template <typename Visit>
void PatchGrid::for_each_pair(std::uint32_t n, const Visit& visit) const {
  const auto patch_at = [this](std::int32_t iu, std::int32_t iv) {
    constexpr auto kEnd = static_cast<std::int32_t>(kSide);
    const bool inside = iu >= 0 && iu < kEnd && iv >= 0 && iv < kEnd;
    return inside ? mean_of_cell_[static_cast<std::uint32_t>(iv) * kSide + static_cast<std::uint32_t>(iu)] : -1;
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::int32_t dv = 0; dv <= kLags; ++dv) {
      for (std::int32_t du = dv == 0 ? 1 : -kLags; du <= kLags; ++du) {
        const int lag = static_cast<int>(std::sqrt(static_cast<double>(du * du + dv * dv)) + 0.5);
        const std::int32_t j = patch_at(means_[i].iu + du, means_[i].iv + dv);
        if (lag <= kLags && j >= 0) visit(means_[i], means_[static_cast<std::uint32_t>(j)], lag);
      }
    }
  }
}

// Correlation of the rock by distance between patches, from products of errors.
PatchGrid::Correlation PatchGrid::correlation_of_errors(std::uint32_t n, double tau2) const {
  double products[kLags + 1] = {};
  double pairs[kLags + 1] = {};
  for_each_pair(n, [&](const Mean& a, const Mean& b, int lag) {
    products[lag] += a.error * b.error;
    pairs[lag] += 1.0;
  });
  Correlation correlation;
  double upper = 0.95;
  for (int lag = 1; lag <= kLags; ++lag) {
    // Errors about a fitted plane sum to nearly nothing, which pulls every lag down by about 3 / n.
    const double measured =
        pairs[lag] > 0.0 && tau2 > 0.0 ? products[lag] / (pairs[lag] * tau2) + 3.0 / static_cast<double>(n) : 0.0;
    correlation.at_lag[lag] = measured < 0.0 ? 0.0 : (measured > upper ? upper : measured);
    upper = correlation.at_lag[lag];
  }
  return correlation;
}

void PatchGrid::sandwich(std::uint32_t n, double tau2, const Eigen::Matrix3d& inverse, PatchFit* out) {
  const Correlation correlation = correlation_of_errors(n, tau2);
  Eigen::Matrix3d middle = Eigen::Matrix3d::Zero();
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  double sum = 0.0, squares = 0.0, cross = 0.0;
  for (const Mean& p : means_.first(n)) {
    const Eigen::Vector3d a(1.0, p.u, p.v);
    middle += p.information * a * a.transpose();  // information^2 times variance
    bias += p.information * p.b * a;
    sum += p.information;
    squares += p.information * p.information;
  }
  for_each_pair(n, [&](const Mean& p, const Mean& o, int lag) {
    if (correlation.at_lag[lag] <= 0.0) return;
    const double covariance = correlation.at_lag[lag] * tau2, ww = p.information * o.information;
    const Eigen::Vector3d a(1.0, p.u, p.v), b(1.0, o.u, o.v);
    middle += ww * covariance * (a * b.transpose() + b * a.transpose());
    // Only the rock's part is shared between patches; the noise of their points is their own.
    cross += 2.0 * ww * covariance * std::sqrt(ww);
  });
  out->covariance = inverse * middle * inverse;
  // Correlation can only cost; where the estimated one would promise more than independence, independence stands.
  for (int k = 0; k < 3; ++k) {
    if (!(out->covariance(k, k) >= inverse(k, k))) out->covariance = inverse;
  }
  out->bias_response = inverse * bias;
  const double effective = sum * sum / (squares + cross);
  out->dof = effective > 5.0 ? effective - 3.0 : 2.0;
  // Three of the independent pieces went into the fit and make the rest look smoother than the rock is.
  out->covariance *= (out->dof + 3.0) / out->dof;
}

void PatchGrid::test_bend(std::uint32_t n, PatchFit* out) {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  Matrix6 m = Matrix6::Zero();
  Vector6 rhs = Vector6::Zero();
  double plane_chi2 = 0.0;
  for (const Mean& p : means_.first(n)) {
    Vector6 a;
    a << 1.0, p.u, p.v, p.u * p.u, p.u * p.v, p.v * p.v;
    m += p.information * a * a.transpose();
    rhs += p.information * p.error * a;
    plane_chi2 += p.information * p.error * p.error;
  }
  // A faint pull to zero keeps directions without data from being made up (sparse rings: no spread in v).
  for (int k = 3; k < 6; ++k) m(k, k) *= 1.0 + 1e-6;
  const Eigen::LDLT<Matrix6> solver(m);
  const Vector6 bend = solver.solve(rhs);
  const double gain = bend.dot(rhs);  // chi-square explained by the quadratic terms
  if (solver.info() != Eigen::Success || !(gain >= 0.0) || !(gain <= 1.01 * plane_chi2)) return;
  const double per_patch = static_cast<double>(n) / (out->dof + 3.0);  // correlated patches count for fewer
  out->bends = gain > kBendChi2 * per_patch;
  Vector6 e = Vector6::Zero();
  e[5] = 1.0;
  out->curvature_v = bend[5];
  out->curvature_v_sigma = std::sqrt(per_patch * solver.solve(e)[5]);
  if (out->bends) out->bend = bend;
}

PatchFit PatchGrid::fit() {
  PatchFit out;
  const std::uint32_t n = collect_means(&out);
  if (n < kPatchesMin) return out;
  Eigen::Matrix3d inverse;
  if (!solve(n, &out.correction, &inverse)) return out;
  const double tau2 = between_patch_variance(n, inverse);
  for (Mean& p : means_.first(n)) p.information = 1.0 / (tau2 + p.noise_variance);
  if (!solve(n, &out.correction, &inverse)) return out;
  out.tau_m = std::sqrt(tau2);
  sandwich(n, tau2, inverse, &out);
  test_bend(n, &out);
  out.solved = true;
  return out;
}

}  // namespace pose_wall
