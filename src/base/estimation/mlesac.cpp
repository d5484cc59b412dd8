// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/mlesac.hpp"

#include <cmath>

#include "base/estimation/near_plane.hpp"
#include "base/math/elementary.hpp"
#include "base/math/finite.hpp"
#include "base/simd/four_floats.hpp"

namespace pose_wall {
namespace {

constexpr double kSpanInSigmas = 4.0;  // residuals beyond are outliers without further ado: 6 in 100,000 by chance
constexpr std::uint32_t kBins = 32;    // an eighth of a standard deviation each
// The share of outliers only decides whether a plane explains more than none.
constexpr int kEmRounds = 8;  // swept: half and twice change nothing
// Points between two checks whether a hypothesis has lost already; whole fours; 64 until 2026-11-22.
constexpr std::uint32_t kLook = 128;  // swept: half and twice change nothing
// A look gives up a hypothesis wrongly once in 700 times at most.
constexpr double kSureInSigmas = 3.0;  // swept: half and twice change nothing

struct Histogram {
  std::uint32_t bins[kBins + 2] = {};  // the last two: beyond, and of no point
  std::uint32_t beyond() const { return bins[kBins]; }
};

Histogram histogram_of_residuals(const PointSet& points, const Plane& plane, double sigma_m) {
  Histogram h;
  const FourDistances distances(plane);
  const FourFloats bins_per_m = all_four(static_cast<float>(kBins / (kSpanInSigmas * sigma_m))),
                   beyond = all_four(kBins);
  for_each_four_points(points, [&](std::uint32_t, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    const FourFloats place = magnitude_of(distances.of(x, y, z)) * bins_per_m;
    const FourInts bin = counts ? cut_off(place < beyond ? place : beyond) : all_four_ints(kBins + 1);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) ++h.bins[static_cast<std::uint32_t>(bin[lane])];
  });
  return h;
}

// True if a mean of so many costs between 0 and 1 leaves no hope for less than too_much. Costs of one mean scatter most
// if they are all 0 or 1. The variance is at least that of a cost that would just do, since equal costs so far do not
// show their scatter.
bool has_lost(double mean, std::uint32_t count, double too_much) {
  const double above = mean - too_much;
  if (!(above >= 0.0)) return false;
  const double variance = larger(mean * (1.0 - mean), too_much * (1.0 - too_much));
  return above * above * count >= kSureInSigmas * kSureInSigmas * variance;
}

// Of the points from begin to end. The distance from an upright plane does not depend on a point's height.
template <bool kUpright>
FourFloats sum_of_costs(const PointSet& points, const FourDistances& distances, std::uint32_t begin, std::uint32_t end,
                        FourFloats limit_m2) {
  const float *x = &points.x[begin], *y = &points.y[begin], *z = &points.z[begin];
  const auto costs_at = [&](std::uint32_t further) {
    const FourFloats x_m = load_four(x + further), y_m = load_four(y + further);
    const FourFloats r = kUpright ? distances.of_upright(x_m, y_m) : distances.of(x_m, y_m, load_four(z + further));
    return smaller_of(r * r, limit_m2);
  };
  FourFloats even{}, odd{};
  for (; begin + 2 * kFour <= end; begin += 2 * kFour, x += 2 * kFour, y += 2 * kFour, z += 2 * kFour) {
    even += costs_at(0);
    odd += costs_at(kFour);
  }
  for (; begin < end; begin += kFour, x += kFour, y += kFour, z += kFour) {
    even += first_of_four(end - begin) ? costs_at(0) : FourFloats{};
  }
  return even + odd;
}

}  // namespace

double truncated_cost(const PointSet& points, const Plane& plane, double threshold_m, double too_much) {
  const FourDistances distances(plane);
  const FourFloats limit_m2 = all_four(static_cast<float>(threshold_m * threshold_m));
  const double most_m2 = static_cast<double>(limit_m2[0]);
  const bool upright = plane.n.z() == 0.0;  // exactly, as for a drawn wall
  double sum_m2 = 0.0;
  for (std::uint32_t i = 0; i < points.count;) {
    const std::uint32_t end = i + kLook < points.count ? i + kLook : points.count;
    sum_m2 += sum_of_lanes((upright ? sum_of_costs<true> : sum_of_costs<false>)(points, distances, i, end, limit_m2));
    i = end;
    if (has_lost(sum_m2 / (most_m2 * i), i, too_much)) return too_much;
  }
  const double cost = points.count > 0 ? sum_m2 / (most_m2 * points.count) : 1.0;
  return cost < too_much ? cost : too_much;
}

MlesacScore mlesac_score(const PointSet& points, const Plane& plane, double sigma_m, double outlier_span_m) {
  if (points.count == 0) return {0.0, 0.0};
  const Histogram h = histogram_of_residuals(points, plane, sigma_m);
  const double n = points.count;
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
  double log_likelihood = static_cast<double>(h.beyond()) * natural_log(1.0 - share);
  for (std::uint32_t b = 0; b < kBins; ++b) {
    if (h.bins[b] != 0) {
      log_likelihood += static_cast<double>(h.bins[b]) * natural_log(share * ratio[b] + (1.0 - share));
    }
  }
  return {-log_likelihood / n, share};
}

}  // namespace pose_wall
