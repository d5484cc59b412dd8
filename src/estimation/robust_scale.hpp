// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cmath>
#include <cstdint>

#include "containers/span.hpp"

namespace pose_wall {

// Standard deviation of the bulk of the residuals within +-gate: 1.4826 times the median of |r|, read off a histogram
// (1/256 of the gate; no sorting). gate_m where nothing lies inside.
inline double robust_scale(Span<const float> residuals, double gate_m) {
  constexpr std::uint32_t kBins = 256;
  constexpr double kMadToSigma = 1.4826;
  std::uint32_t bins[kBins] = {};
  std::uint32_t inside = 0;
  const float bins_per_m = static_cast<float>(kBins / gate_m);
  for (const float r : residuals) {
    const float place = std::fabs(r) * bins_per_m;
    if (!(place < static_cast<float>(kBins))) continue;
    ++bins[static_cast<std::uint32_t>(place)];
    ++inside;
  }
  if (inside == 0) return gate_m;
  const double half = 0.5 * static_cast<double>(inside);
  double below = 0.0;
  std::uint32_t b = 0;
  while (below + static_cast<double>(bins[b]) < half) below += static_cast<double>(bins[b++]);
  const double within_bin = (half - below) / static_cast<double>(bins[b]);
  return kMadToSigma * (static_cast<double>(b) + within_bin) * gate_m / kBins;
}

}  // namespace pose_wall
