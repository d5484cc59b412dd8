// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Rough rock: a Gaussian random field with correlation exp(-r^2 / L^2), by random waves; the simulator's rock has the
// same.

#pragma once

#include <cmath>

#include "support/stage_fixtures.hpp"

namespace pose_wall::test {

class Rock {
 public:
  Rock(double sigma_m, double length_m, Noise* noise) : amplitude_(sigma_m * std::sqrt(2.0 / kWaves)) {
    for (Wave& w : waves_)
      w = {noise->normal(M_SQRT2 / length_m), noise->normal(M_SQRT2 / length_m), noise->uniform(0, 6.2832)};
  }
  double at(double u, double v) const {
    double sum = 0.0;
    for (const Wave& w : waves_) sum += std::cos(w.ku * u + w.kv * v + w.phase);
    return amplitude_ * sum;
  }

 private:
  static constexpr int kWaves = 60;
  struct Wave {
    double ku, kv, phase;
  };
  Wave waves_[kWaves];
  double amplitude_;
};

}  // namespace pose_wall::test
