// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/wave_models.hpp"

#include <cmath>
#include <limits>

#include "base/estimation/protection.hpp"
#include "base/math/elementary.hpp"
#include "base/math/finite.hpp"

namespace pose_wall {
namespace {

constexpr int kTailSteps = 24;  // halvings: a bound to a millionth
// Both walls of a road are one rock, cut by one machine; lining or a fault on one side is the exception.
constexpr double kSameRock = 0.9;    // swept: half 86 moved, twice 22 lost 3 won
constexpr double kFaintest = -50.0;  // e to this is no likelihood

// Likelihoods relative to the best one. Returns their sum, over counted models.
double relative(const WaveEvidence& of, const bool (&counted)[kWaveModels], double (*likelihoods)[kWaveModels]) {
  double best = -std::numeric_limits<double>::infinity(), sum = 0.0;
  for (std::uint32_t k = 0; k < kWaveModels; ++k) {
    if (counted[k]) best = larger(best, static_cast<double>(of.log_likelihood[k]));
  }
  for (std::uint32_t k = 0; k < kWaveModels; ++k) {
    const double below = static_cast<double>(of.log_likelihood[k]) - best;
    (*likelihoods)[k] = counted[k] && below > kFaintest ? exponential(below) : 0.0;
    sum += (*likelihoods)[k];
  }
  return sum;
}

// The six numbers of a symmetric matrix, in the order of LinearErrors::covariance.
constexpr int kRow[6] = {0, 1, 1, 2, 2, 2}, kColumn[6] = {0, 0, 1, 0, 1, 2};

}  // namespace

bool weigh_models(const WaveEvidence& own, const WaveEvidence& elsewhere, double (*weights)[kWaveModels]) {
  if (!own.exists) return false;
  double sum = relative(own, own.solved, weights);
  const bool is_alike = elsewhere.exists && elsewhere.patch_m == own.patch_m;
  bool shared[kWaveModels];
  double models = 0.0;
  for (std::uint32_t k = 0; k < kWaveModels; ++k) {
    shared[k] = is_alike && own.solved[k] && elsewhere.solved[k];
    models += shared[k] ? 1.0 : 0.0;
  }
  if (models > 1.0) {
    double others[kWaveModels];
    const double sum_of_others = relative(elsewhere, shared, &others);
    sum = 0.0;
    for (std::uint32_t k = 0; k < kWaveModels; ++k) {
      if (shared[k]) (*weights)[k] *= (1.0 - kSameRock) + kSameRock * models * others[k] / sum_of_others;
      sum += (*weights)[k];
    }
  }
  for (double& weight : *weights) weight /= sum;
  return true;
}

Spread spread_of_mixture(const double (&weights)[kWaveModels], const double (&variances)[kWaveModels], double freedom,
                         double sigmas) {
  Spread out;
  for (std::uint32_t k = 0; k < kWaveModels; ++k) out.variance += weights[k] * variances[k];
  double sigma[kWaveModels] = {}, low = 1e9, high = 0.0;
  const double of_scale = protection_factor(sigmas, freedom) / sigmas;
  for (std::uint32_t k = 0; k < kWaveModels; ++k) {
    if (!(weights[k] > 0.0)) continue;
    sigma[k] = of_scale * std::sqrt(variances[k] / out.variance);
    low = sigma[k] < low ? sigma[k] : low;
    high = sigma[k] > high ? sigma[k] : high;
  }
  low *= sigmas;
  high *= sigmas;
  const double risk = share_beyond(sigmas);
  for (int step = 0; step < kTailSteps; ++step) {
    const double middle = 0.5 * (low + high);
    double share = 0.0;
    for (std::uint32_t k = 0; k < kWaveModels; ++k) {
      if (weights[k] > 0.0) share += weights[k] * share_beyond(middle / sigma[k]);
    }
    (share > risk ? low : high) = middle;
  }
  // The inverse of protection_factor(), no better than freedom allows.
  const double more = high / sigmas - 1.0, least = (sigmas * sigmas + 1.0) / (4.0 * freedom);
  out.dof = (sigmas * sigmas + 1.0) / (4.0 * (more > least ? more : least));
  return out;
}

Spread sum_of(const Spread& a, const Spread& b) {
  const double variance = a.variance + b.variance;
  const double per_dof = a.variance * a.variance / a.dof + b.variance * b.variance / b.dof;
  return {variance, per_dof == 0.0 ? a.dof : variance * variance / per_dof};
}

void LinearErrors::set(std::uint32_t model, double log_likelihood, const Eigen::Matrix3d& of_model) {
  evidence.exists = evidence.solved[model] = true;
  evidence.log_likelihood[model] = static_cast<float>(log_likelihood);
  for (int i = 0; i < 6; ++i) covariance[model][i] = static_cast<float>(of_model(kRow[i], kColumn[i]));
}

void LinearErrors::weigh(const WaveEvidence& elsewhere) {
  weigh_models(evidence, elsewhere, &weights);
}

Spread LinearErrors::spread_of(const Eigen::Vector3d& at, double sigmas) const {
  double variances[kWaveModels] = {};
  for (std::uint32_t k = 0; k < kWaveModels; ++k) {
    for (int i = 0; i < 6; ++i) {
      const double twice = kRow[i] == kColumn[i] ? 1.0 : 2.0;
      variances[k] += twice * static_cast<double>(covariance[k][i]) * at[kRow[i]] * at[kColumn[i]];
    }
  }
  return spread_of_mixture(weights, variances, freedom, sigmas);
}

Eigen::Matrix3d LinearErrors::mean_covariance() const {
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  for (std::uint32_t k = 0; k < kWaveModels; ++k) {
    for (int i = 0; i < 6; ++i) {
      const double part = weights[k] * static_cast<double>(covariance[k][i]);
      out(kRow[i], kColumn[i]) += part;
      if (kRow[i] != kColumn[i]) out(kColumn[i], kRow[i]) += part;
    }
  }
  return out;
}

}  // namespace pose_wall
