// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The errors of a patch fit: its covariance by the waves, and the test for a bend.

#include <Eigen/Core>
#include <cmath>

#include "base/containers/even_share.hpp"
#include "base/containers/work.hpp"
#include "base/estimation/patch_fit.hpp"
#include "base/estimation/small_cholesky.hpp"

namespace pose_wall {
namespace {

// Chi-square with 3 degrees of freedom: 1 in 10^4 by chance where the covariance is known. It is estimated: on
// simulated straight rock it is 1 to 5 in 1000, more where a wall is hardly longer than its rock's bumps, and so is
// bent.
constexpr double kBendChi2 = 21.1;
// A faint pull to zero keeps directions without data from being made up (sparse rings: no spread in v). A millionth
// hardly moves a coefficient that has data.
constexpr double kPull = 1e-6;
// By 1 + 15 / freedom kBendChi2 becomes three times the same quantile of F, to 6 % from 15 degrees of freedom on. Below
// that it falls short: 2.5 for 3.1 at ten.
constexpr double kFewPatches = 15.0;
// Equal errors everywhere would leave one independent patch, and a sandwich that is no covariance; it bounds by how
// much correlation may widen.
constexpr double kCorrelationMax = 0.95;
// Measured, as is the form, on simulated rock of 2 to 8 cm over 0.1 to 1 m; 1.0 at first, 2026-11-21.
constexpr double kVisibilityPerPatch = 0.8;
// Roughness between patches of a fifth of the scatter within them (sqrt 0.05) counts half as rock, half as noise.
constexpr double kNoiseLooksRough = 0.05;  // swept: half 187 moved, twice 1 won

// Lag of a patch that lies so many columns and rows away: its distance to the nearest patch.
struct Lags {
  static constexpr int kMost = PatchGrid::kLags;  // the largest lag
  std::uint8_t lag[kMost + 1][kMost + 1] = {};    // by row and column
  int reach[kMost + 1] = {};                      // columns that are within kMost, in a row
};
constexpr Lags lags_by_offset() {
  Lags out;
  for (int dv = 0; dv <= Lags::kMost; ++dv) {
    for (int du = 0; du <= Lags::kMost; ++du) {
      int lag = 0;
      while ((2 * lag + 1) * (2 * lag + 1) <= 4 * (du * du + dv * dv)) ++lag;
      out.lag[dv][du] = static_cast<std::uint8_t>(lag);
      if (lag <= Lags::kMost) out.reach[dv] = du;
    }
  }
  return out;
}
constexpr Lags kLagOf = lags_by_offset();

FourFloats packed(const Eigen::Vector3d& three, double fourth) {
  return FourFloats{static_cast<float>(three.x()), static_cast<float>(three.y()), static_cast<float>(three.z()),
                    static_cast<float>(fourth)};
}

Eigen::Vector3d first_three(FourFloats four) {
  return {static_cast<double>(four[0]), static_cast<double>(four[1]), static_cast<double>(four[2])};
}

// Six terms times the numbers for the first three and for the others.
double sum_of_products(const Eigen::Matrix<double, 6, 1>& terms, FourFloats first, FourFloats others) {
  return terms.head<3>().dot(first_three(first)) + terms.tail<3>().dot(first_three(others));
}

// Sums over pairs of patches: each part of one times each of the other.
struct Products {
  FourFloats row[kFour] = {};

  void add(FourFloats own, FourFloats others) {
    row[0] += own[0] * others;
    row[1] += own[1] * others;
    row[2] += own[2] * others;
    row[3] += own[3] * others;
  }
  Eigen::Matrix3d of_first_three() const {
    Eigen::Matrix3d out;
    for (int k = 0; k < 3; ++k) out.row(k) = first_three(row[k]);
    return out;
  }
};

}  // namespace

Spread PatchErrors::spread_of(const Eigen::Vector3d& at, double sigmas) const {
  Spread sum = layer[0].spread_of(at, sigmas);
  for (std::uint32_t k = 1; k < layers; ++k) sum = sum_of(sum, layer[k].spread_of(at, sigmas));
  return sum;
}

Eigen::Matrix3d PatchErrors::covariance() const {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (std::uint32_t k = 0; k < layers; ++k) sum += layer[k].mean_covariance();
  return sum;
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

std::uint32_t PatchGrid::neighbours_after(const Mean& p, Neighbour* out) const {
  const auto columns = static_cast<std::int32_t>(columns_), rows = static_cast<std::int32_t>(rows_);
  std::uint32_t count = 0;
  for (std::int32_t dv = 0; dv <= kLags && p.iv + dv < rows; ++dv) {
    const std::int32_t reach = kLagOf.reach[dv], left = p.iu < reach ? p.iu : reach;
    const std::int32_t first = dv == 0 ? 1 : -left, last = p.iu + reach < columns ? reach : columns - 1 - p.iu;
    const std::int32_t row = static_cast<std::int32_t>(p.layer) * rows + p.iv + dv;
    for (std::int32_t du = first; du <= last; ++du) {
      const std::int32_t j = mean_of_cell_[static_cast<std::uint32_t>(row * columns + p.iu + du)];
      if (j >= 0) out[count++] = {&means_[static_cast<std::uint32_t>(j)], kLagOf.lag[dv][du < 0 ? -du : du]};
    }
  }
  return count;
}

// Each unordered pair of patches of one layer up to kLags apart, once: a patch, and those of its neighbours that come
// after it, by their distance. Of more patches than kPairedMost an even share, by which sums over pairs are to be
// multiplied in the end.
template <typename Visit>
double PatchGrid::for_each_neighbourhood(std::uint32_t n, const Visit& visit) const {
  EvenShare share(kPairedMost, n);
  std::uint32_t visited = 0;
  Neighbour neighbours[kNeighboursMost] = {};
  for (const Mean& p : means_.first(n)) {
    if (!share.takes()) continue;
    ++visited;
    visit(p, Span<const Neighbour>(neighbours, neighbours_after(p, neighbours)));
  }
  return static_cast<double>(n) / static_cast<double>(visited);
}

// Correlation of the rock by distance between patches, from products of errors. Errors about a fitted surface are
// smaller than the rock is, and more so with fewer independent patches. So the fit's own variance is given back to
// them. taken_by_fit: by lag, over all pairs.
void PatchGrid::correlate_errors(const PairSums& sums, const double (&taken_by_fit)[kLags + 1], Roughness* rough) {
  double upper = kCorrelationMax;
  for (int lag = 1; lag <= kLags; ++lag) {
    const double pairs = sums.lag[lag].pairs, products = sums.lag[lag].errors + taken_by_fit[lag];
    const double measured = pairs > 0.0 && rough->tau2 > 0.0 ? products / (pairs * rough->tau2) : 0.0;
    rough->at_lag[lag] = measured < 0.0 ? 0.0 : (measured > upper ? upper : measured);
    upper = rough->at_lag[lag];
  }
}

// The patches of a square, and how the fit answers to them. No weight: there are none.
PatchGrid::Block PatchGrid::sum_block(std::int32_t first, std::int32_t row, std::int32_t column, std::int32_t side,
                                      const Eigen::Matrix3d& inverse) const {
  const auto columns = static_cast<std::int32_t>(columns_), rows = static_cast<std::int32_t>(rows_);
  Block sum;
  for (std::int32_t iv = row; iv < row + side && iv < rows; ++iv) {
    for (std::int32_t iu = column; iu < column + side && iu < columns; ++iu) {
      const std::int32_t at = mean_of_cell_[static_cast<std::uint32_t>(first + iv * columns + iu)];
      if (at < 0) continue;
      const Mean& p = means_[static_cast<std::uint32_t>(at)];
      sum.w += p.information;
      sum.u += p.information * p.u;
      sum.v += p.information * p.v;
      sum.r += p.information * p.error;
      sum.noise += p.information * p.information * p.noise_variance;
      sum.response += p.information * (inverse * p.a);
    }
  }
  return sum;
}

// Squares of neighbouring patches, as small as leave room for all. The fit answers to a block as to its patches.
std::uint32_t PatchGrid::collect_blocks(std::uint32_t layer, const Eigen::Matrix3d& inverse,
                                        std::int32_t* patches_wide) {
  const auto columns = static_cast<std::int32_t>(columns_), rows = static_cast<std::int32_t>(rows_);
  const std::int32_t first = static_cast<std::int32_t>(layer) * rows * columns;
  for (std::int32_t side = 1;; ++side) {
    std::uint32_t count = 0;
    bool fits = true;
    for (std::int32_t column = 0; column < columns && fits; column += side) {
      for (std::int32_t row = 0; row < rows && fits; row += side) {
        const Block sum = sum_block(first, row, column, side, inverse);
        if (!(sum.w > 0.0)) continue;
        fits = count < blocks_.size();
        if (!fits) break;
        blocks_[count] = {sum.u / sum.w, sum.v / sum.w, sum.r / sum.w, 0.0, sum.noise / (sum.w * sum.w)};
        responses_[count++] = sum.response;
      }
    }
    *patches_wide = side;
    if (fits) return count;
  }
}

// Each layer errs by its own waves. False where one has too few patches to know them.
bool PatchGrid::measure_errors(std::uint32_t n, const Eigen::Matrix3d& inverse, PatchFit* out) {
  Eigen::Vector3d bias = Eigen::Vector3d::Zero();
  for (const Mean& p : means_.first(n)) bias += p.information * p.b_centred * p.a;
  out->bias_response = inverse * bias;
  out->errors.layers = layers_;
  for (std::uint32_t layer = 0; layer < layers_; ++layer) {
    std::int32_t patches_wide = 1;
    const std::uint32_t count = collect_blocks(layer, inverse, &patches_wide);
    out->errors.layer[layer] = uneven_.errors_of(blocks_.first(count), responses_.first(count));
    out->errors.layer[layer].evidence.patch_m = static_cast<float>(patches_wide) / cells_per_m_;
    out->work += count * steps::kPatchWaved;
    if (!out->errors.layer[layer].solved()) return false;
  }
  return true;
}

// Grows with the roughness and with its slopes, and those with the scatter inside a patch: factor and form are measured
// on simulated rock of 2 to 8 cm over 0.1 to 1 m. Scatter without roughness between patches is noise of the sensor.
double PatchGrid::visibility(double tau2) const {
  double scatter = 0.0, freedom = 0.0;
  for (const PatchSums& p : cells_.first(columns_ * rows_)) {
    if (p.count < 2) continue;
    scatter += p.rr() - p.r() * p.r() / static_cast<double>(p.count);
    freedom += static_cast<double>(p.count - 1);
  }
  if (!(freedom > 0.0 && scatter > 0.0)) return 0.0;
  const double within2 = scatter / freedom;
  const double rock = tau2 / (tau2 + kNoiseLooksRough * within2);
  return kVisibilityPerPatch * cells_per_m_ * rock * std::sqrt(within2 * (within2 + tau2));
}

PatchGrid::Quadratic PatchGrid::quadratic_terms(const Mean& p) {
  Quadratic a;
  a << 1.0, p.u, p.v, p.u * p.u, p.u * p.v, p.v * p.v;
  return a;
}

// Variance of the rock between patches of the surface, by the errors about the quadratic.
double PatchGrid::rock_about_quadratic(std::uint32_t n) const {
  double left2 = 0.0, noise = 0.0, sum = 0.0, patches = 0.0;
  for (const Mean& p : means_.first(n)) {
    if (p.layer != 0) continue;
    left2 += p.information * p.error * p.error;
    noise += p.information * p.noise_variance;
    sum += p.information;
    patches += 1.0;
  }
  static_assert(kPatchesMin > kQuadraticTerms, "the quadratic takes as many patches' worth");
  const double rock2 = (left2 * patches / (patches - kQuadraticTerms) - noise) / sum;
  return rock2 > 0.0 ? rock2 : 0.0;
}

// Over the pairs of the surface: errors about the quadratic and answers of its coefficients.
PatchGrid::BendSums PatchGrid::sum_bend_pairs(std::uint32_t n) const {
  BendSums sums;
  Products weighted[kLags + 1];
  FourFloats linear[kLags + 1] = {}, quadratic[kLags + 1] = {};
  const double all = for_each_neighbourhood(n, [&](const Mean& p, Span<const Neighbour> neighbours) {
    if (p.layer != 0) return;
    FourFloats linear_after[kLags + 1] = {}, quadratic_after[kLags + 1] = {}, weighted_after[kLags + 1] = {};
    for (const Neighbour& o : neighbours) {
      linear_after[o.lag] += o.mean->of_pairs[0];
      quadratic_after[o.lag] += o.mean->of_pairs[1];
      weighted_after[o.lag] += o.mean->of_pairs[2];
    }
    const Quadratic terms = quadratic_terms(p);
    const FourFloats first = packed(terms.head<3>(), p.error), last = packed(terms.tail<3>(), 1.0);  // 1 x 1: a pair
    for (int lag = 1; lag <= kLags; ++lag) {
      linear[lag] += first * linear_after[lag];
      quadratic[lag] += last * quadratic_after[lag];
      weighted[lag].add(p.of_pairs[2], weighted_after[lag]);
    }
  });
  for (int lag = 1; lag <= kLags; ++lag) {
    PairSums::Lag& sum = sums.pairs.lag[lag];
    sum.pairs = all * static_cast<double>(quadratic[lag][3]);
    sum.errors = all * static_cast<double>(linear[lag][3]);
    sum.weighted = all * weighted[lag].of_first_three();
    sums.taken_by_fit[lag] = all * (first_three(linear[lag]).sum() + first_three(quadratic[lag]).sum());
  }
  for (const Mean& p : means_.first(n)) {
    if (p.layer != 0) continue;
    const Eigen::Vector3d own = first_three(p.of_pairs[2]);
    const Quadratic terms = quadratic_terms(p);
    sums.leverage += sum_of_products(terms, p.of_pairs[0], p.of_pairs[1]);
    sums.patches += 1.0;
    sums.rock += own * own.transpose();
    sums.noise += p.noise_variance * own * own.transpose();
  }
  return sums;
}

// Covariance of the coefficients of uu, uv and vv where the rock is correlated like this.
Eigen::Matrix3d PatchGrid::bend_sandwich(const BendSums& sums, const Roughness& rough) {
  Eigen::Matrix3d shared = Eigen::Matrix3d::Zero();
  for (int lag = 1; lag <= kLags; ++lag) {
    const Eigen::Matrix3d& weighted = sums.pairs.lag[lag].weighted;
    shared += rough.tau2 * rough.at_lag[lag] * (weighted + weighted.transpose());
  }
  // Correlation can only cost.
  for (int k = 0; k < 3; ++k) {
    if (shared(k, k) >= 0.0) continue;
    shared.row(k).setZero();
    shared.col(k).setZero();
  }
  return rough.tau2 * sums.rock + sums.noise + shared;
}

// Of the coefficients of uu, uv and vv, by a sandwich (Conley 1999) of the errors about the quadratic. About the
// plane a bend makes neighbouring patches err alike. That looks like rough rock with few independent patches and would
// hide the bend. Needs Mean::error about the quadratic, and its responses in Mean::of_pairs.
Eigen::Matrix3d PatchGrid::covariance_of_bend(std::uint32_t n, const Matrix6& inverse) const {
  const double own_tau2 = rock_about_quadratic(n);
  const BendSums sums = sum_bend_pairs(n);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double inflation = 1.0;  // of the fit's variance, over that of independent patches
  for (int round = 0; round <= kGiveBackRounds; ++round) {
    Roughness rough;
    rough.tau2 = own_tau2 + (inflation - 1.0) * sums.leverage / sums.patches;
    double taken[kLags + 1] = {};
    for (int lag = 1; lag <= kLags; ++lag) taken[lag] = inflation * sums.taken_by_fit[lag];
    correlate_errors(sums.pairs, taken, &rough);
    covariance = bend_sandwich(sums, rough);
    const double ratio = covariance.trace() / inverse.bottomRightCorner<3, 3>().trace();
    inflation = ratio > 1.0 ? ratio : 1.0;
  }
  // A variance from few independent patches is itself uncertain: factor from chi-square and normal quantiles to those
  // of F and t.
  const double freedom = sums.patches / inflation - kQuadraticTerms;
  return covariance * (1.0 + kFewPatches / (freedom > 2.0 ? freedom : 2.0));
}

void PatchGrid::test_bend(std::uint32_t n, PatchFit* out) {
  Matrix6 m = Matrix6::Zero();
  Quadratic rhs = Quadratic::Zero();
  double plane_chi2 = 0.0;
  for (const Mean& p : means_.first(n)) {
    if (p.layer != 0) continue;
    const Quadratic a = quadratic_terms(p);
    m += p.information * a * a.transpose();
    rhs += p.information * p.error * a;
    plane_chi2 += p.information * p.error * p.error;
  }
  Quadratic pull = Quadratic::Zero();
  for (int k = 3; k < 6; ++k) pull[k] = kPull * m(k, k);
  m.diagonal() += pull;
  const SmallCholesky<kQuadraticTerms> solver(m);
  const Quadratic bend = solver.solve(rhs);
  const double gain = bend.dot(rhs);  // chi-square explained by the quadratic terms
  if (!solver.solved() || !(gain >= 0.0) || !(gain <= 1.01 * plane_chi2)) return;
  Matrix6 inverse;
  for (int k = 0; k < 6; ++k) inverse.col(k) = solver.solve(Quadratic(Quadratic::Unit(k)));
  for (Mean& p : means_.first(n)) {
    if (p.layer != 0) continue;
    const Quadratic terms = quadratic_terms(p), answer = inverse * terms;
    p.error -= bend.dot(terms);
    p.of_pairs[0] = packed(answer.head<3>(), p.error);
    p.of_pairs[1] = packed(answer.tail<3>(), 1.0);
    p.of_pairs[2] = packed(p.information * answer.tail<3>(), 0.0);
  }
  // The part held back by the pull is unknown.
  const Matrix6 held_back = inverse * pull.asDiagonal() * inverse;
  const Eigen::Matrix3d covariance =
      covariance_of_bend(n, inverse) + Eigen::Matrix3d(held_back.bottomRightCorner<3, 3>());
  const Eigen::Vector3d quadratic = bend.tail<3>();
  // Wald's test. A matrix from estimated correlations need not be a covariance; if not, the variances alone are used.
  const SmallCholesky<3> whole(covariance), variances(covariance.diagonal().asDiagonal());
  out->bends = quadratic.dot((whole.solved() ? whole : variances).solve(quadratic)) > kBendChi2;
  if (out->bends) out->bend = bend;
  out->curvature_v = bend[5];
  out->curvature_v_sigma = std::sqrt(covariance(2, 2));
}

}  // namespace pose_wall
