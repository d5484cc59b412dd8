// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "lab/campaign/rate_bound.hpp"

#include <cmath>

namespace pose_wall::tools::campaign {
namespace {

constexpr double kDoubt = 0.05;

// Chance of at most `events` in `trials` at this rate, 0 < rate < 1.
double at_most(std::size_t events, std::size_t trials, double rate) {
  const auto n = static_cast<double>(trials);
  double sum = 0.0;
  for (std::size_t k = 0; k <= events; ++k) {
    const auto i = static_cast<double>(k);
    const double ways = std::lgamma(n + 1.0) - std::lgamma(i + 1.0) - std::lgamma(n - i + 1.0);
    sum += std::exp(ways + i * std::log(rate) + (n - i) * std::log1p(-rate));
  }
  return sum;
}

}  // namespace

double rate_bound_95(std::size_t events, std::size_t trials) {
  if (events >= trials) return 1.0;
  if (events == 0) return -std::expm1(std::log(kDoubt) / static_cast<double>(trials));
  double low = static_cast<double>(events) / static_cast<double>(trials);
  double high = 1.0;
  for (int halvings = 0; halvings < 60; ++halvings) {
    const double middle = 0.5 * (low + high);
    (at_most(events, trials, middle) > kDoubt ? low : high) = middle;
  }
  return high;
}

}  // namespace pose_wall::tools::campaign
