// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Models of how a surface waves, weighed by likelihood, and what an estimator's errors are under their mixture.
//
// Length and share of the waves are not chosen but averaged over (Handcock and Stein 1993). A model that one surface
// can hardly exclude may be excluded by another of the same rock: by the opposite wall. The same rock is an assumption
// that may be wrong, so it has a probability, and the surface's own likelihood can outvote it.

#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace pose_wall {

// No waves, or each of four lengths with each of two shares (uneven_plane).
constexpr std::uint32_t kWaveModels = 9;

// Log likelihoods of the models by one surface, each up to a constant that all share.
struct WaveEvidence {
  bool exists = false;
  bool solved[kWaveModels] = {};
  float log_likelihood[kWaveModels] = {};
  float patch_m = 0.0F;  // side of its patches: of other ones a model means another thing
};

// Weights of the models by a surface's own evidence and by that of another surface, which exists or not, and counts
// if its patches are as large. Together 1.
// False if no model is solved.
bool weigh_models(const WaveEvidence& own, const WaveEvidence& elsewhere, double (*weights)[kWaveModels]);

// Variance of a number, and from how many independent pieces it is known as well.
struct Spread {
  double variance = 0.0;
  double dof = 1.0;
};

// Of a mixture of models by the variance under each: the degrees of freedom are those with which Student's t has the
// mixture's tail at so many standard deviations, where a level is read. freedom: of the variance under one model.
Spread spread_of_mixture(const double (&weights)[kWaveModels], const double (&variances)[kWaveModels], double freedom,
                         double sigmas);

// The sum of two independent errors (Welch 1947; Satterthwaite 1946).
Spread sum_of(const Spread& a, const Spread& b);

// Errors of offset and slopes of an estimator that is linear in a surface's patches, under each model.
struct LinearErrors {
  WaveEvidence evidence;
  float covariance[kWaveModels][6] = {};  // 00, 10, 11, 20, 21, 22
  double weights[kWaveModels] = {};
  double freedom = 0.0;

  bool solved() const { return evidence.exists; }
  void set(std::uint32_t model, double log_likelihood, const Eigen::Matrix3d& covariance);
  // Once more with the evidence of other rock.
  void weigh(const WaveEvidence& elsewhere);
  // Of at.dot(errors of offset, slope along u, slope along v). sigmas: as in spread_of_mixture().
  Spread spread_of(const Eigen::Vector3d& at, double sigmas) const;
  Eigen::Matrix3d mean_covariance() const;
};

}  // namespace pose_wall
