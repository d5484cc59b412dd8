// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "estimation/two_layers.hpp"

#include <cmath>
#include <initializer_list>

#include "math/elementary.hpp"

namespace pose_wall {
namespace {

constexpr int kRounds = 30;
constexpr int kTrialRounds = 5;
constexpr double kGainLeast = 1e-3;  // in log likelihood: less decides nothing
constexpr double kShareMin = 0.06;
constexpr double kShareMax = 0.65;
constexpr double kStepMin_m = 0.03;
constexpr double kUniformShare = 0.05;  // strays

using Histogram = LayerHistogram;
constexpr std::uint32_t kBins = LayerHistogram::kBins;

struct Mixture {
  double centre, sigma, step, share;  // share 0: one layer
};

// What a mixture expects at a distance: of the surface, of the nearer layer, and of strays.
class Densities {
 public:
  Densities(const Mixture& m, double gate_m)
      : m_(m),
        per_sigma_(1.0 / m.sigma),
        top_((1.0 - kUniformShare) / std::sqrt(2.0 * kPi) * per_sigma_),
        strays_(kUniformShare / (2.0 * gate_m)) {}

  double surface(double x) const { return (1.0 - m_.share) * top_ * bell(x - m_.centre); }
  double nearer(double x) const { return m_.share > 0.0 ? m_.share * top_ * bell(x - m_.centre - m_.step) : 0.0; }
  double strays() const { return strays_; }

 private:
  double bell(double off) const {
    const double z2 = off * per_sigma_ * off * per_sigma_;
    return z2 < 80.0 ? exponential(-0.5 * z2) : 0.0;
  }

  const Mixture& m_;
  double per_sigma_, top_, strays_;
};

double log_likelihood(const Histogram& h, const Mixture& m) {
  const Densities expected(m, h.gate_m());
  double sum = 0.0;
  for (std::uint32_t b = 0; b < kBins; ++b) {
    const double x = h.centre(b);
    if (h.count(b) > 0.0) {
      sum += h.count(b) * natural_log(expected.surface(x) + expected.nearer(x) + expected.strays());
    }
  }
  return sum;
}

// One round of EM; step stays 0 for a single layer. Returns about what it gained in log likelihood: by as much as
// means, width and share have moved, in terms of what the counts tell of each.
double improve(const Histogram& h, double sigma_min_m, Mixture* m) {
  double w0 = 0, w1 = 0, x0 = 0, x1 = 0, xx = 0;
  const Mixture before = *m;
  const Densities expected(before, h.gate_m());
  for (std::uint32_t b = 0; b < kBins; ++b) {
    if (!(h.count(b) > 0.0)) continue;
    const double x = h.centre(b), p0 = expected.surface(x), p1 = expected.nearer(x);
    const double per_density = h.count(b) / (p0 + p1 + expected.strays()), a = p0 * per_density, c = p1 * per_density;
    w0 += a;
    w1 += c;
    x0 += a * x;
    x1 += c * x;
    xx += (a + c) * x * x;
  }
  if (!(w0 > 1.0)) return 0.0;
  const double mean0 = x0 / w0, mean1 = w1 > 1.0 ? x1 / w1 : mean0 + m->step;
  const double variance = (xx - w0 * mean0 * mean0 - w1 * mean1 * mean1) / (w0 + w1);
  m->centre = mean0;
  m->step = m->share > 0.0 ? mean1 - mean0 : 0.0;
  m->share = w1 / (w0 + w1);
  m->sigma = variance > sigma_min_m * sigma_min_m ? std::sqrt(variance) : sigma_min_m;
  const double moved0 = m->centre - before.centre, moved1 = moved0 + m->step - before.step;
  const double wider = m->sigma - before.sigma, more = m->share - before.share;
  const double by_share = m->share > 0.0 ? 0.5 * (w0 + w1) * more * more / (m->share * (1.0 - m->share)) : 0.0;
  return by_share +
         (0.5 * (w0 * moved0 * moved0 + w1 * moved1 * moved1) + (w0 + w1) * wider * wider) / (m->sigma * m->sigma);
}

Mixture improved(const Histogram& h, double sigma_min_m, int rounds, Mixture m) {
  for (int round = 0; round < rounds; ++round) {
    if (improve(h, sigma_min_m, &m) < kGainLeast) break;
  }
  return m;
}

// EM climbs to the nearest top: it starts with the plane on the surface, between the layers, and on the nearer one, a
// few rounds each, and goes on from the best (short runs; Biernacki, Celeux and Govaert 2003).
Mixture mixture_of_two(const Histogram& h, double sigma_min_m) {
  const double gate_m = h.gate_m();
  Mixture best{};
  double most = 0.0;
  for (const double step : {gate_m / 4.0, gate_m / 2.0}) {
    for (const double centre : {0.0, -step / 2.0, -step}) {
      const Mixture trial = improved(h, sigma_min_m, kTrialRounds, {centre, gate_m / 8.0, step, 0.3});
      if (!(trial.step > 0.0 && trial.share > 0.0)) continue;
      const double likely = log_likelihood(h, trial);
      if (best.share > 0.0 && !(likely > most)) continue;
      best = trial;
      most = likely;
    }
  }
  return best.share > 0.0 ? improved(h, sigma_min_m, kRounds, best) : best;
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
  const Mixture mixture{centre_m, sigma_m, step_m, share};
  const Densities expected(mixture, 1.0);  // of strays nothing is asked
  const double surface = expected.surface(residual_m), nearer = expected.nearer(residual_m);
  return surface + nearer > 0.0 ? surface / (surface + nearer) : 0.0;
}

TwoLayers find_two_layers(const LayerHistogram& h, const LayerDemands& demands) {
  TwoLayers out;
  if (!(h.total() > 0.0)) return out;
  const Mixture one = improved(h, demands.sigma_min_m, kRounds, {0.0, h.gate_m() / 4.0, 0.0, 0.0});
  const Mixture two = mixture_of_two(h, demands.sigma_min_m);
  out.centre_m = two.centre;
  out.sigma_m = two.sigma;
  out.step_m = two.step;
  out.share = two.share;
  out.found = two.share >= kShareMin && two.share <= kShareMax && two.step >= kStepMin_m &&
              two.step >= demands.apart_in_sigmas * two.sigma &&
              log_likelihood(h, two) - log_likelihood(h, one) >= demands.gain_min;
  return out;
}

}  // namespace pose_wall
