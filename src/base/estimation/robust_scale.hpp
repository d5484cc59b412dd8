// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cmath>
#include <cstdint>

#include "base/containers/span.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {

// Standard deviation of the bulk of the residuals within +-gate: 1.4826 times the median of |r|, read off a histogram
// (1/256 of the gate; no sorting).
class ScaleHistogram {
 public:
  explicit ScaleHistogram(double gate_m) : gate_m_(gate_m), bins_per_m_(static_cast<float>(kBins / gate_m)) {}

  void add(float residual_m) {
    const float place = std::fabs(residual_m) * bins_per_m_;
    if (!(place < static_cast<float>(kBins))) return;
    ++bins_[static_cast<std::uint32_t>(place)];
    ++inside_[0];
  }

  // Of four residuals, those that count.
  void add(FourFloats residuals_m, FourTruths counts) {
    const FourFloats place = magnitude_of(residuals_m) * bins_per_m_;
    const FourTruths inside = counts & (place < static_cast<float>(kBins));
    const FourInts bin =
        inside ? cut_off(inside ? place : FourFloats{}) : all_four_ints(static_cast<std::int32_t>(kBins));
    for (std::uint32_t lane = 0; lane < kFour; ++lane) ++bins_[static_cast<std::uint32_t>(bin[lane])];
    inside_ -= inside;
  }

  // The gate where nothing lies inside.
  double scale_m() const {
    constexpr double kMadToSigma = 1.4826;  // one over the normal's upper quartile, 0.6745
    const std::uint32_t inside = sum_of_lanes(inside_);
    if (inside == 0) return gate_m_;
    std::uint32_t below = 0, b = 0;
    while (2 * (below + bins_[b]) < inside) below += bins_[b++];
    const double half = 0.5 * static_cast<double>(inside);
    const double within_bin = (half - static_cast<double>(below)) / static_cast<double>(bins_[b]);
    return kMadToSigma * (static_cast<double>(b) + within_bin) * gate_m_ / kBins;
  }

 private:
  static constexpr std::uint32_t kBins = 256;  // of a gate of 25 cm or less: below a millimetre each
  double gate_m_;
  float bins_per_m_;
  FourInts inside_{};                   // how many, in four parts
  std::uint32_t bins_[kBins + 1] = {};  // and one for all that lie outside or do not count
};

inline double robust_scale(Span<const float> residuals, double gate_m) {
  ScaleHistogram histogram(gate_m);
  for (const float r : residuals) histogram.add(r);
  return histogram.scale_m();
}

}  // namespace pose_wall
