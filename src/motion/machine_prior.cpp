// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "motion/machine_prior.hpp"

#include <cmath>

namespace pose_wall::motion {
namespace {

// Shaking of a machine that reports that it stands.
constexpr double kStandingSigma_m = 0.001, kStandingSigma_rad = 0.0005;
constexpr double kMost = 50.0;  // m and rad a frame: beyond all machines

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

bool weigh_in(const MachinePrior& prior, double towards, double way_m, double factor, Alignment* a) {
  const double variance = prior.way_sigma_m * prior.way_sigma_m, of_rock = a->covariance(0, 0);
  const double difference_m = prior.way_m * towards - way_m;
  if (!(difference_m * difference_m <= factor * factor * (variance + of_rock))) return false;
  const double share = of_rock / (of_rock + variance + 1e-12);
  a->pose.t += share * difference_m * a->axes.along;
  a->covariance(0, 0) *= 1.0 - share;
  return true;
}

}  // namespace pose_wall::motion
