// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "estimation/mlesac.hpp"

#include <cmath>

#include "estimation/near_plane.hpp"
#include "math/elementary.hpp"
#include "math/four_floats.hpp"
#include "math/larger.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kBins = 32;
constexpr double kSpanInSigmas = 4.0;  // residuals beyond are outliers without further ado
constexpr int kEmRounds = 8;
constexpr std::uint32_t kLook = 128;  // points between two looks whether a hypothesis has lost already
constexpr double kSureInSigmas = 3.0;

struct Histogram {
  std::uint32_t bins[kBins] = {};
  std::uint32_t beyond = 0;
};

Histogram histogram_of_residuals(const PointSet& points, Span<const std::uint32_t> indices, const Plane& plane,
                                 double sigma_m) {
  Histogram h;
  const float nx = static_cast<float>(plane.n.x()), ny = static_cast<float>(plane.n.y());
  const float nz = static_cast<float>(plane.n.z()), d = static_cast<float>(plane.d);
  const float bins_per_m = static_cast<float>(kBins / (kSpanInSigmas * sigma_m));
  for (const std::uint32_t i : indices) {
    const float r = nx * points.x[i] + ny * points.y[i] + nz * points.z[i] + d;
    const float place = std::fabs(r) * bins_per_m;
    if (place < static_cast<float>(kBins)) {
      ++h.bins[static_cast<std::uint32_t>(place)];
    } else {
      ++h.beyond;
    }
  }
  return h;
}

// Whether a mean of this many costs between 0 and 1 leaves hope for less than too_much. Costs of the same mean scatter
// most where they are all 0 or 1; of what would just do, so much: where all so far are 1, that they scatter is yet to
// be seen.
bool has_lost(double mean, std::uint32_t count, double too_much) {
  const double above = mean - too_much;
  if (!(above >= 0.0)) return false;
  const double variance = larger(mean * (1.0 - mean), too_much * (1.0 - too_much));
  return above * above * count >= kSureInSigmas * kSureInSigmas * variance;
}

}  // namespace

double truncated_cost(const PointSet& points, const Plane& plane, double threshold_m, double too_much) {
  const FourDistances distances(plane);
  const float limit = static_cast<float>(threshold_m * threshold_m);
  FourFloats sums{};
  const std::uint32_t n = points.count, whole = n - n % kFour;
  const double each_m2 = static_cast<double>(limit);
  for (std::uint32_t i = 0; i < whole;) {
    const std::uint32_t until = i + kLook < whole ? i + kLook : whole;
    for (; i < until; i += kFour) {
      const FourFloats r = distances.of(points, i);
      sums += smaller_of(r * r, all_four(limit));
    }
    if (has_lost(sum_of_lanes(sums) / (each_m2 * i), i, too_much)) return too_much;
  }
  if (whole < n) {
    const FourFloats r = distances.of(points, whole), costs = smaller_of(r * r, all_four(limit));
    for (std::uint32_t lane = 0; lane < n - whole; ++lane) sums[0] += costs[lane];
  }
  const double cost = n > 0 ? sum_of_lanes(sums) / (each_m2 * n) : 1.0;
  return cost < too_much ? cost : too_much;
}

MlesacScore mlesac_score(const PointSet& points, Span<const std::uint32_t> indices, const Plane& plane, double sigma_m,
                         double outlier_span_m) {
  if (indices.size() == 0) return {0.0, 0.0};
  const Histogram h = histogram_of_residuals(points, indices, plane, sigma_m);
  const double n = static_cast<double>(indices.size());
  // Density of |r| at each bin's centre relative to the uniform density.
  double ratio[kBins];
  for (std::uint32_t b = 0; b < kBins; ++b) {
    const double z = (static_cast<double>(b) + 0.5) * (kSpanInSigmas / kBins);
    const double gaussian = exponential(-0.5 * z * z) / (std::sqrt(0.5 * kPi) * sigma_m);
    ratio[b] = gaussian * outlier_span_m;
  }
  double share = 0.5;
  for (int round = 0; round < kEmRounds; ++round) {
    double inside = 0.0;
    for (std::uint32_t b = 0; b < kBins; ++b) {
      const double p = share * ratio[b];
      inside += static_cast<double>(h.bins[b]) * p / (p + (1.0 - share));
    }
    share = inside / n;
    if (!(share > 1e-4)) share = 1e-4;
    if (!(share < 0.9999)) share = 0.9999;
  }
  double log_likelihood = static_cast<double>(h.beyond) * natural_log(1.0 - share);
  for (std::uint32_t b = 0; b < kBins; ++b) {
    if (h.bins[b] != 0) {
      log_likelihood += static_cast<double>(h.bins[b]) * natural_log(share * ratio[b] + (1.0 - share));
    }
  }
  return {-log_likelihood / n, share};
}

}  // namespace pose_wall
