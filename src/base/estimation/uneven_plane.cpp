// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/uneven_plane.hpp"

#include <Eigen/LU>
#include <cmath>

#include "base/math/elementary.hpp"

namespace pose_wall {
namespace {

static_assert(SurfacePatches::kMost <= PanelCholesky::kRowsMost, "a row for each patch");
constexpr std::uint32_t kRightSides = 2;  // panels of them: 1, u, v, residual; bias
constexpr std::uint32_t kPatchesMin = 8;  // five more than the terms of a plane; judgement, 2026-11-21
// From a patch (0.5 m) to the waves that a first radius (3 m) shows; longer ones are the surface's own slope. Twice as
// long each time, as their likelihoods are averaged. Judgement, 2026-11-21.
constexpr double kLengths_m[] = {0.4, 0.8, 1.6, 3.2};
// Share of the unevenness that neighbouring patches do not share: little, or nearly half. The smaller one keeps the
// covariance positive definite in floats. Judgement, 2026-11-21.
constexpr double kOwnShares[] = {0.05, 0.4};
// An exactly flat surface has nothing left to scale by: a thousandth of the expected errors is kept.
constexpr double kScaleLeast = 1e-6;
constexpr int kModelsMax = 1 + 4 * 2;  // no waves, or a length and a share
// Factors of a determinant whose logarithm is taken at once: each lies between 1e-6 and 1e6, their product within a
// double's 1e-308 to 1e308.
constexpr std::uint32_t kLogEvery = 16;

// Variance of the patches about their plane beyond their noise: a first guess for the ratio of the two. Patches count
// by their information (DerSimonian and Laird 1986), or one that is hardly seen would drown the rest.
double unevenness(Span<const SurfacePatch> patches) {
  double squares = 0.0, information = 0.0;
  for (const SurfacePatch& p : patches) {
    squares += p.residual * p.residual / p.noise_variance;
    information += 1.0 / p.noise_variance;
  }
  const double excess = squares - static_cast<double>(patches.size());
  return excess > 0.0 ? excess / information : 0.0;
}

double slopes_variance(const Eigen::Matrix3d& covariance) {
  return covariance(1, 1) + covariance(2, 2);
}

}  // namespace

struct UnevenPlane::Model {
  Eigen::Vector3d correction, bias_response;
  Eigen::Matrix3d covariance;
  double log_likelihood;
  double weight;
};

struct UnevenPlane::Models {
  Model of[kModelsMax];
  int count = 0;

  // By likelihood, together 1.
  void weigh();
  UnevenFit average(double freedom) const;
};

void UnevenPlane::Models::weigh() {
  double best = of[0].log_likelihood, sum = 0.0;
  for (int k = 1; k < count; ++k) best = of[k].log_likelihood > best ? of[k].log_likelihood : best;
  for (int k = 0; k < count; ++k) {
    const double below = of[k].log_likelihood - best;
    of[k].weight = below > -50.0 ? exponential(below) : 0.0;
    sum += of[k].weight;
  }
  for (int k = 0; k < count; ++k) of[k].weight /= sum;
}

UnevenFit UnevenPlane::Models::average(double freedom) const {
  UnevenFit out;
  for (int k = 0; k < count; ++k) {
    out.correction += of[k].weight * of[k].correction;
    out.bias_response += of[k].weight * of[k].bias_response;
    out.covariance += of[k].weight * of[k].covariance;
  }
  const double mean = slopes_variance(out.covariance);
  double spread = 0.0;
  for (int k = 0; k < count; ++k) {
    const Eigen::Vector3d apart = of[k].correction - out.correction;
    out.covariance += of[k].weight * apart * apart.transpose();
    const double off = slopes_variance(of[k].covariance) / mean - 1.0;
    spread += of[k].weight * off * off;
  }
  // A variance from so many independent pieces is known to a relative variance of 2 / freedom.
  out.dof = 2.0 / (2.0 / freedom + spread);
  out.solved = true;
  return out;
}

void UnevenPlane::lay_out(Arena& arena) {
  correlation_ = arena.take<float>(PanelCholesky::panels_of(SurfacePatches::kMost) * PanelCholesky::kPanel);
  factor_.lay_out(arena);
  right_sides_ = arena.take<float>(kRightSides * PanelCholesky::kPanel);
  matern_ = arena.take<float>(kMaternSteps + 1);
  matern_filled_ = false;
}

void UnevenPlane::fill_matern() {
  for (std::uint32_t k = 0; k <= kMaternSteps; ++k) {
    const double r = k * (1.0 / kMaternPerUnit);
    matern_[k] = static_cast<float>((1.0 + r) * exponential(-r));
  }
  matern_filled_ = true;
}

// (1 + r) exp(-r), to 3e-5.
FourFloats UnevenPlane::matern(FourFloats r) const {
  const FourFloats place = r * static_cast<float>(kMaternPerUnit), none{};
  const FourTruths near = place < all_four(kMaternSteps);
  const FourInts step = cut_off(near ? place : none);
  FourFloats below, above;
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    const float* const at = &matern_[static_cast<std::uint32_t>(step[lane])];
    below[lane] = at[0];
    above[lane] = at[1];
  }
  const FourFloats part = place - __builtin_convertvector(step, FourFloats);
  return near ? below + part * (above - below) : none;
}

// In panels like the factor's: the lower triangle, and the rest of a panel's last columns.
void UnevenPlane::fill_correlation(Span<const SurfacePatch> patches, double length_m) {
  const auto per_length = static_cast<float>(std::sqrt(3.0) / length_m);
  for (std::uint32_t first = 0; first < patches.size(); first += kFour) {
    FourFloats u{}, v{};
    for (std::uint32_t lane = 0; lane < kFour && first + lane < patches.size(); ++lane) {
      u[lane] = static_cast<float>(patches[first + lane].u);
      v[lane] = static_cast<float>(patches[first + lane].v);
    }
    float* const row = &correlation_[first / kFour * PanelCholesky::kPanel];
    for (std::uint32_t j = 0; j < first + kFour && j < patches.size(); ++j) {
      const FourFloats du = u - static_cast<float>(patches[j].u), dv = v - static_cast<float>(patches[j].v);
      store_four(matern(root_of(du * du + dv * dv) * per_length), row + kFour * j);
    }
  }
}

// Of the patches' covariance. Floats do: each patch has a part of its own in it, a twentieth at least.
bool UnevenPlane::factor(Span<const SurfacePatch> patches, double own_share, double tau2) {
  const auto shared = static_cast<float>((1.0 - own_share) * tau2);
  for (std::uint32_t first = 0; first < patches.size(); first += kFour) {
    float* const panel = factor_.panel(first / kFour);
    const float* const correlation = &correlation_[first / kFour * PanelCholesky::kPanel];
    const FourTruths is_patch = first_of_four(patches.size() - first);
    for (std::uint32_t j = 0; j < first + kFour; ++j) {
      const FourFloats none{}, covariance = j < patches.size() ? shared * load_four(correlation + kFour * j) : none;
      store_four(is_patch ? covariance : none, panel + kFour * j);
    }
    for (std::uint32_t k = 0; k < kFour; ++k) {
      const std::uint32_t i = first + k;
      panel[kFour * i + k] = i < patches.size() ? static_cast<float>(tau2 + patches[i].noise_variance) : 1.0F;
    }
  }
  return factor_.factor(patches.size());
}

// Whitens both sides by a model of the errors: independent, and of variance 1. Returns the logarithm of the
// covariance's determinant.
double UnevenPlane::whiten(Span<const SurfacePatch> patches, bool correlated, double tau2) {
  float* const first = right_sides_.data();
  float* const second = first + PanelCholesky::kPanel;
  const std::uint32_t rows = kFour * PanelCholesky::panels_of(patches.size());
  for (std::uint32_t i = 0; i < rows; ++i) {
    const bool is_patch = i < patches.size();
    const SurfacePatch p = is_patch ? patches[i] : SurfacePatch{};
    store_four(FourFloats{is_patch ? 1.0F : 0.0F, static_cast<float>(p.u), static_cast<float>(p.v),
                          static_cast<float>(p.residual)},
               first + kFour * i);
    store_four(FourFloats{static_cast<float>(p.bias)}, second + kFour * i);
  }
  if (correlated) {
    factor_.solve(patches.size(), first);
    factor_.solve(patches.size(), second);
  }
  double log_determinant = 0.0, product = 1.0;
  for (std::uint32_t i = 0; i < patches.size(); ++i) {
    const float pivot =
        correlated ? factor_.inverse_pivot(i) : 1.0F / std::sqrt(static_cast<float>(tau2 + patches[i].noise_variance));
    if (!correlated) {
      store_four(load_four(first + kFour * i) * pivot, first + kFour * i);
      second[kFour * i] *= pivot;
    }
    product *= static_cast<double>(pivot);
    if (i % kLogEvery != kLogEvery - 1 && i + 1 != patches.size()) continue;
    log_determinant -= 2.0 * natural_log(product);
    product = 1.0;
  }
  return log_determinant;
}

bool UnevenPlane::solve(std::uint32_t patches, double log_determinant, Model* model) const {
  Eigen::Matrix3d g = Eigen::Matrix3d::Zero();
  Eigen::Vector3d of_residual = Eigen::Vector3d::Zero(), of_bias = Eigen::Vector3d::Zero();
  double squares = 0.0;
  for (std::uint32_t i = 0; i < patches; ++i) {
    const FourFloats y = load_four(&right_sides_[kFour * i]);
    const auto residual = static_cast<double>(y[3]);
    const auto bias = static_cast<double>(right_sides_[PanelCholesky::kPanel + kFour * i]);
    const Eigen::Vector3d a(static_cast<double>(y[0]), static_cast<double>(y[1]), static_cast<double>(y[2]));
    g += a * a.transpose();
    of_residual += a * residual;
    of_bias += a * bias;
    squares += residual * residual;
  }
  const double determinant = g.determinant();
  if (!(determinant > 1e-9 * g(0, 0) * g(1, 1) * g(2, 2))) return false;
  const Eigen::Matrix3d inverse = g.inverse();
  model->correction = inverse * of_residual;
  model->bias_response = inverse * of_bias;
  const double left = squares - model->correction.dot(of_residual);
  const double freedom = static_cast<double>(patches) - 3.0;
  const double least = kScaleLeast * freedom;
  if (!(left > -least)) return false;
  const double scaled = left > least ? left : least;
  model->covariance = inverse * (scaled / freedom);
  model->log_likelihood = -0.5 * (log_determinant + natural_log(determinant) + freedom * natural_log(scaled));
  return true;
}

void UnevenPlane::consider(Span<const SurfacePatch> patches, double own_share, double tau2, Models* models) {
  const bool correlated = own_share < 1.0;
  if (correlated && !factor(patches, own_share, tau2)) return;
  const double log_determinant = whiten(patches, correlated, tau2);
  if (solve(patches.size(), log_determinant, &models->of[models->count])) ++models->count;
}

UnevenFit UnevenPlane::fit(Span<const SurfacePatch> patches) {
  if (patches.size() < kPatchesMin) return {};
  const double tau2 = unevenness(patches);
  Models models;
  consider(patches, 1.0, tau2, &models);
  if (tau2 > 0.0) {
    if (!matern_filled_) fill_matern();
    for (const double length_m : kLengths_m) {
      fill_correlation(patches, length_m);
      for (const double share : kOwnShares) consider(patches, share, tau2, &models);
    }
  }
  if (models.count == 0) return {};
  models.weigh();
  return models.average(static_cast<double>(patches.size()) - 3.0);
}

}  // namespace pose_wall
