// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/machine_prior.hpp"

#include <cmath>

namespace pose_wall::motion {
namespace {

// Shaking of a machine that reports that it stands.
constexpr double kStandingSigma_m = 0.001, kStandingSigma_rad = 0.0005;
constexpr double kMost = 50.0;            // m and rad a frame: beyond all machines
constexpr double kNoVariance_m2 = 1e-12;  // keeps two ways without any variance from being divided by nothing

}  // namespace

MachinePrior ask_machine(const pose_wall_inputs* inputs, double dt_s) {
  MachinePrior prior;
  if (inputs == nullptr) return prior;
  if ((inputs->given & POSE_WALL_INPUT_STANDING) != 0) {
    prior.way_sigma_m = kStandingSigma_m;
    prior.turn_sigma_rad = kStandingSigma_rad;
    return prior;
  }
  if ((inputs->given & POSE_WALL_INPUT_SPEED) != 0) {
    prior.way_m = inputs->speed_m_s * dt_s;
    prior.way_sigma_m = inputs->speed_sigma_m_s * dt_s;
    prior.sound = std::fabs(prior.way_m) < kMost && prior.way_sigma_m > 0.0 && prior.way_sigma_m < kMost;
  }
  if ((inputs->given & POSE_WALL_INPUT_TURN_RATE) != 0) {
    prior.turn_rad = inputs->turn_rate_rad_s * dt_s;
    prior.turn_sigma_rad = inputs->turn_rate_sigma_rad_s * dt_s;
    prior.sound =
        prior.sound && std::fabs(prior.turn_rad) < kMost && prior.turn_sigma_rad > 0.0 && prior.turn_sigma_rad < kMost;
  }
  if (prior.sound) return prior;
  prior = MachinePrior{};
  prior.sound = false;
  return prior;
}

WeighedWay weigh_in(const MachinePrior& prior, double towards, double way_m, double variance_m2, double factor) {
  const double own_m2 = prior.way_sigma_m * prior.way_sigma_m;
  const double difference_m = prior.way_m * towards - way_m;
  if (!(difference_m * difference_m <= factor * factor * (own_m2 + variance_m2))) return {0.0, variance_m2, false};
  const double share = variance_m2 / (variance_m2 + own_m2 + kNoVariance_m2);
  return {share * difference_m, variance_m2 * (1.0 - share), true};
}

}  // namespace pose_wall::motion
