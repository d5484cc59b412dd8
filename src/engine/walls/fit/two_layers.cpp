// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/fit/two_layers.hpp"

#include <cmath>
#include <initializer_list>

#include "base/math/elementary.hpp"
#include "base/simd/four_exponentials.hpp"

namespace pose_wall {
namespace {

// Caps EM, which ends where it gains less than kGainLeast; swept: half 5 moved, twice 1 moved.
constexpr int kRounds = 30;
constexpr int kTrialRounds = 5;      // a short run (Biernacki et al. 2003); 1.4 M instructions less (bench/README.md)
constexpr double kGainLeast = 1e-3;  // in log likelihood; a thousandth decides nothing where 4 are demanded
constexpr double kShareMin = 0.06;   // a smaller layer looks like strays; swept: half 2 moved, twice 4 lost 1 won
// The nearer layer may be the larger one, but not nearly all; swept: half 1 lost, twice 8 lost 1 won.
constexpr double kShareMax = 0.65;
constexpr double kStepMin_m = 0.03;  // callers demand more; swept: half 1 lost, twice 1 won
// Strays at any distance; keeps the logarithm finite; swept: half 28 moved, twice 3 won.
constexpr double kUniformShare = 0.05;

using Histogram = LayerHistogram;
constexpr std::uint32_t kBins = LayerHistogram::kBins;  // the histogram's number of bins

struct Mixture {
  double centre, sigma, step, share;  // share 0: one layer
};

// exp(-z^2 / 2). Not inlined, since it is called from many places.
[[gnu::noinline]] FourFloats bell(FourFloats z) {
  const FourFloats none{}, x = -0.5F * (z * z);
  const FourTruths is_near = x > -40.0F;
  return is_near ? four_exponentials(is_near ? x : none) : none;
}

// Expected densities of a mixture at four distances: of the surface, of the nearer layer, and of strays.
class Densities {
 public:
  Densities(const Mixture& m, double gate_m)
      : centre_(static_cast<float>(m.centre)),
        nearer_(static_cast<float>(m.centre + m.step)),
        per_sigma_(static_cast<float>(1.0 / m.sigma)) {
    const double top = (1.0 - kUniformShare) / (std::sqrt(2.0 * kPi) * m.sigma);
    top_of_surface_ = static_cast<float>((1.0 - m.share) * top);
    top_of_nearer_ = static_cast<float>(m.share * top);
    strays_ = static_cast<float>(kUniformShare / (2.0 * gate_m));
  }

  FourFloats surface(FourFloats x) const { return top_of_surface_ * bell((x - centre_) * per_sigma_); }
  FourFloats nearer(FourFloats x) const { return top_of_nearer_ * bell((x - nearer_) * per_sigma_); }
  float strays() const { return strays_; }

 private:
  float centre_, nearer_, per_sigma_;
  float top_of_surface_, top_of_nearer_, strays_;
};

double log_likelihood(const Histogram& h, const Mixture& m) {
  const Densities expected(m, h.gate_m());
  double sum = 0.0;
  for (std::uint32_t b = 0; b < kBins; b += kFour) {
    const FourFloats x = h.four_centres(b), counts = h.four_counts(b);
    if (!any_of(counts > FourFloats{})) continue;
    const FourFloats density = expected.surface(x) + expected.nearer(x) + expected.strays();
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (!(counts[lane] > 0.0F)) continue;
      sum += static_cast<double>(counts[lane]) * natural_log(static_cast<double>(density[lane]));
    }
  }
  return sum;
}

// Of one layer: its weight, and the sums of the offsets from its old mean.
struct LayerSums {
  FourFloats weight{}, off{}, squares{};

  void add(FourFloats weights, FourFloats offs) {
    const FourFloats weighted = weights * offs;
    weight += weights;
    off += weighted;
    squares += weighted * offs;
  }
};

// One round of EM; step stays 0 for a single layer. Returns roughly the gain in log likelihood, from the moves of
// means, width and share relative to what the counts resolve.
double improve(const Histogram& h, double sigma_min_m, Mixture* m) {
  const Mixture before = *m;
  const Densities expected(before, h.gate_m());
  const auto centre = static_cast<float>(before.centre), nearer = static_cast<float>(before.centre + before.step);
  LayerSums of_surface, of_nearer;
  for (std::uint32_t b = 0; b < kBins; b += kFour) {
    const FourFloats counts = h.four_counts(b);
    if (!any_of(counts > FourFloats{})) continue;
    const FourFloats x = h.four_centres(b), p0 = expected.surface(x), p1 = expected.nearer(x);
    const FourFloats per_density = counts / (p0 + p1 + expected.strays());
    of_surface.add(p0 * per_density, x - centre);
    of_nearer.add(p1 * per_density, x - nearer);
  }
  const double w0 = sum_of_lanes(of_surface.weight), w1 = sum_of_lanes(of_nearer.weight);
  if (!(w0 > 1.0)) return 0.0;
  const double moved0 = sum_of_lanes(of_surface.off) / w0;
  const double moved1 = w1 > 1.0 ? sum_of_lanes(of_nearer.off) / w1 : moved0;
  const double squares = sum_of_lanes(of_surface.squares) + sum_of_lanes(of_nearer.squares);
  const double variance = (squares - w0 * moved0 * moved0 - w1 * moved1 * moved1) / (w0 + w1);
  m->centre = before.centre + moved0;
  m->step = m->share > 0.0 ? before.step + moved1 - moved0 : 0.0;
  m->share = w1 / (w0 + w1);
  m->sigma = variance > sigma_min_m * sigma_min_m ? std::sqrt(variance) : sigma_min_m;
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

// EM climbs to the nearest top. So it starts with the plane on the surface, between the layers, and on the nearer one.
// Each start runs a few rounds, and the best one goes on (short runs; Biernacki, Celeux and Govaert 2003).
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
  count_[static_cast<std::uint32_t>(place)] += 1.0F;
  total_ += 1.0;
}

void LayerHistogram::add(Span<const float> distances_m) {
  for (const float d : distances_m) add(static_cast<double>(d));
}

FourFloats TwoLayers::surface_probability(FourFloats residuals_m) const {
  const Mixture mixture{centre_m, sigma_m, step_m, share};
  const Densities expected(mixture, 1.0);  // strays do not matter here
  const FourFloats surface = expected.surface(residuals_m), both = surface + expected.nearer(residuals_m), none{};
  return both > none ? surface / both : none;
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
