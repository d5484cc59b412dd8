// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Ribs, cables and mesh in front of a surface: a second layer of residuals, always on the sensor's side.

#pragma once

#include <cstdint>

#include "base/containers/span.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {

// Distances from a surface within +-gate_m, in 80 bins. Positive: towards the sensor.
class LayerHistogram {
 public:
  static constexpr std::uint32_t kBins = 80;  // 5 mm each of a gate of 0.2 m to both sides; whole fours

  explicit LayerHistogram(double gate_m) : gate_m_(gate_m) {}
  void add(double distance_m);
  void add(Span<const float> distances_m);

  double gate_m() const { return gate_m_; }
  double total() const { return total_; }
  // Of four successive bins.
  FourFloats four_counts(std::uint32_t bin) const { return load_four(&count_[bin]); }
  FourFloats four_centres(std::uint32_t bin) const {
    const FourFloats middles = FourFloats{0.5F, 1.5F, 2.5F, 3.5F} + static_cast<float>(bin);
    return (middles * (2.0F / kBins) - 1.0F) * static_cast<float>(gate_m_);
  }

 private:
  static_assert(kBins % kFour == 0, "whole fours");
  double gate_m_;
  double total_ = 0.0;
  float count_[kBins] = {};
};

// If found, two Gaussians of one width: the surface around `centre_m`, and a layer `step_m` nearer to the sensor.
struct TwoLayers {
  bool found = false;
  double centre_m = 0.0;  // of the surface, relative to the plane
  double sigma_m = 0.0;
  double step_m = 0.0;
  double share = 0.0;  // share of the nearer layer in the counts

  // Probability that a distance belongs to the surface, for four at once or for one.
  FourFloats surface_probability(FourFloats distances_m) const;
  double surface_probability(double distance_m) const {
    return static_cast<double>(surface_probability(all_four(static_cast<float>(distance_m)))[0]);
  }
};

// Expectation maximisation on the histogram. found only if the two layers are clearly apart, both hold a fair share,
// and the second explains the counts better by the demanded gain. One rough surface has no second layer.
struct LayerDemands {
  double sigma_min_m;
  double gain_min;  // in log likelihood
  double apart_in_sigmas;
};
TwoLayers find_two_layers(const LayerHistogram& histogram, const LayerDemands& demands);

}  // namespace pose_wall
