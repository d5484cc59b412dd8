// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "estimation/two_layers.hpp"

#include <cmath>
#include <initializer_list>

#include "math/elementary.hpp"

namespace pose_wall {
namespace {

constexpr int kRounds = 30;
constexpr double kGainLeast = 1e-3;  // in log likelihood: less decides nothing
constexpr double kShareMin = 0.06;
constexpr double kShareMax = 0.65;
constexpr double kStepMin_m = 0.03;
constexpr double kUniformShare = 0.05;  // strays

double density(double x, double sigma) {
  const double z = x / sigma;
  return z * z < 80.0 ? exponential(-0.5 * z * z) / (sigma * std::sqrt(2.0 * kPi)) : 0.0;
}

using Histogram = LayerHistogram;
constexpr std::uint32_t kBins = LayerHistogram::kBins;

struct Mixture {
  double centre, sigma, step, share;  // share 0: one layer
  double log_likelihood;
};

// One round of EM; step stays 0 for a single layer.
void improve(const Histogram& h, double sigma_min_m, Mixture* m) {
  double w0 = 0, w1 = 0, x0 = 0, x1 = 0, xx = 0;
  const double uniform = kUniformShare / (2.0 * h.gate_m());
  m->log_likelihood = 0.0;
  for (std::uint32_t b = 0; b < kBins; ++b) {
    if (!(h.count(b) > 0.0)) continue;
    const double x = h.centre(b);
    const double p0 = (1.0 - kUniformShare) * (1.0 - m->share) * density(x - m->centre, m->sigma);
    const double p1 = (1.0 - kUniformShare) * m->share * density(x - m->centre - m->step, m->sigma);
    const double p = p0 + p1 + uniform;
    m->log_likelihood += h.count(b) * natural_log(p);
    const double a = h.count(b) * p0 / p, c = h.count(b) * p1 / p;
    w0 += a;
    w1 += c;
    x0 += a * x;
    x1 += c * x;
    xx += a * x * x + c * x * x;
  }
  if (!(w0 > 1.0)) return;
  const double mean0 = x0 / w0, mean1 = w1 > 1.0 ? x1 / w1 : mean0 + m->step;
  const double variance = (xx - w0 * mean0 * mean0 - w1 * mean1 * mean1) / (w0 + w1);
  m->centre = mean0;
  m->step = m->share > 0.0 ? mean1 - mean0 : 0.0;
  m->share = w1 / (w0 + w1);
  m->sigma = variance > sigma_min_m * sigma_min_m ? std::sqrt(variance) : sigma_min_m;
}

Mixture fit(const Histogram& h, Mixture start, double sigma_min_m) {
  double before = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    improve(h, sigma_min_m, &start);
    if (round > 0 && std::fabs(start.log_likelihood - before) < kGainLeast) break;
    before = start.log_likelihood;
  }
  return start;
}

}  // namespace

void LayerHistogram::add(double distance_m) {
  const double place = (distance_m + gate_m_) * (kBins / (2.0 * gate_m_));
  if (!(place >= 0.0 && place < kBins)) return;
  count_[static_cast<std::uint32_t>(place)] += 1.0;
  total_ += 1.0;
}

void LayerHistogram::add(Span<const float> distances_m) {
  for (const float d : distances_m) add(static_cast<double>(d));
}

double TwoLayers::surface_probability(double residual_m) const {
  const double surface = (1.0 - share) * density(residual_m - centre_m, sigma_m);
  const double nearer = share * density(residual_m - centre_m - step_m, sigma_m);
  return surface + nearer > 0.0 ? surface / (surface + nearer) : 0.0;
}

TwoLayers find_two_layers(const LayerHistogram& h, const LayerDemands& demands) {
  const double sigma_min_m = demands.sigma_min_m;
  TwoLayers out;
  if (!(h.total() > 0.0)) return out;
  const double gate_m = h.gate_m();
  const Mixture one = fit(h, {0.0, gate_m / 4.0, 0.0, 0.0, 0.0}, sigma_min_m);
  Mixture best = one;
  // EM climbs to the nearest top: start with the plane on the surface, between the layers, and on the nearer one.
  for (const double step : {gate_m / 4.0, gate_m / 2.0}) {
    for (const double centre : {0.0, -step / 2.0, -step}) {
      const Mixture two = fit(h, {centre, gate_m / 8.0, step, 0.3, 0.0}, sigma_min_m);
      if (two.step > 0.0 && two.log_likelihood > best.log_likelihood) best = two;
    }
  }
  out.centre_m = best.centre;
  out.sigma_m = best.sigma;
  out.step_m = best.step;
  out.share = best.share;
  out.found = best.share >= kShareMin && best.share <= kShareMax && best.step >= kStepMin_m &&
              best.step >= demands.apart_in_sigmas * best.sigma &&
              best.log_likelihood - one.log_likelihood >= demands.gain_min;
  return out;
}

}  // namespace pose_wall
