// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/localise/verdict.hpp"

#include <algorithm>
#include <cmath>

#include "base/math/elementary.hpp"
#include "place/slide.hpp"
#include "planar/gates.hpp"

namespace pose_wall::planar {
namespace {

// Rounds of a new fit where the place is shifted. 10,000 restarts were judged without one (README.md); with it smooth
// roads would need 3 standard errors instead of 4.
constexpr std::uint32_t kAsFitted = 0;

bool is_same(const CandidatePlace& candidate, const Pose2& pose) {
  // Fits along a road that slides are one place, drawn out. With half and with twice of each the sweep's restarts were
  // the same.
  constexpr double kChain_m = 0.7, kYaw_rad = 0.2;
  const double apart_m = (candidate.pose.place() - pose.place()).norm();
  return apart_m < candidate.spread_m + kChain_m && std::abs(wrapped(candidate.pose.yaw_rad - pose.yaw_rad)) < kYaw_rad;
}

void add(const Hypothesis& hypothesis, double worse, SearchVerdict* out) {
  for (std::uint32_t k = 0; k < out->count; ++k) {
    CandidatePlace& known = out->candidates[k];
    if (!is_same(known, hypothesis.pose)) continue;
    known.spread_m = std::max(known.spread_m, (known.pose.place() - hypothesis.pose.place()).norm());
    return;
  }
  ++out->all;
  if (out->count == kCandidatesMost) return;
  const double weight = exponential(-0.5 * (worse > 0.0 ? worse * worse : 0.0));
  out->candidates[out->count++] = {hypothesis.pose, weight, worse, hypothesis.verdict.fits, 0.0};
}

bool has_relief(const Surroundings& around, const Evidence& best) {
  std::uint32_t judged = 0;
  for (std::uint32_t at = 0; at < around.patches; ++at) judged += around.is_judged(at) ? 1U : 0U;
  return passes<gate::RELIEF_PATCHES>(best.relief) &&
         passes_of<gate::RELIEF>(static_cast<double>(best.relief), static_cast<double>(judged));
}

// none: it is the one place.
Why doubt_of(const SearchVerdict& verdict, const PlaceSearch& search) {
  const Evidence& best = verdict.best;
  if (verdict.all != 1) return Why::several;
  if (!search.is_whole()) return Why::crowded;
  if (!passes<gate::PATCHES>(best.patches)) return Why::few;
  if (!passes<gate::FITS>(best.fits)) return Why::misfit;
  if (!passes<gate::SEEN>(best.seen)) return Why::unseen;
  if (!passes<gate::THROUGH>(best.through)) return Why::through;
  const bool holds = passes<gate::HOLDS>(best.slide_m) && passes<gate::HOLDS>(verdict.candidates[0].spread_m);
  return holds ? Why::none : Why::slides;
}

}  // namespace

void judge(const PlaceMap& map, const Surroundings& around, const PlaceSearch& search, bool map_is_whole,
           Span<PatchWall> walls, SearchVerdict* out) {
  *out = SearchVerdict();
  out->why = Why::no_fit;
  const Span<const Hypothesis> all = search.hypotheses();
  if (all.size() == 0) return;
  const Hypothesis& best = all[0];
  out->best.fits = best.verdict.fits;
  out->best.explained = best.explained;
  out->best.seen = best.verdict.judged > 0 ? static_cast<double>(best.verdict.seen) / best.verdict.judged : 0.0;
  out->best.rms_m = best.rms_m;
  out->best.patches = best.verdict.seen;
  out->best.through = seen_through(map, around, best.pose);
  const FitRule rule{around.sigma_m};
  const Fit fit = fit_of(fit_sums(map, around.points, best.pose, rule), best.pose);
  out->best.slide_m = slide_of(map, around, fit, limit_of<gate::EXCLUDED>(), kAsFitted).reach_m;
  out->best.relief = relief_patches(map, around, best.pose, walls);
  constexpr double kNoRival = 99.0;  // standard errors: beyond every limit
  out->best.rival = kNoRival;
  for (std::uint32_t k = 0; k < all.size(); ++k) {
    const double worse = k == 0 ? 0.0 : worse_by(around, best.costs, all[k].costs);
    if (k > 0 && out->count > 0 && !is_same(out->candidates[0], all[k].pose)) {
      out->best.rival = std::min(out->best.rival, worse);
    }
    if (!passes<gate::EXCLUDED>(worse) && all[k].verdict.fits >= (k == 0 ? 0.0 : 0.5 * best.verdict.fits))
      add(all[k], worse, out);
  }
  double sum = 0.0;
  for (std::uint32_t k = 0; k < out->count; ++k) sum += out->candidates[k].weight;
  for (std::uint32_t k = 0; k < out->count; ++k) out->candidates[k].weight /= sum;
  if (!passes<gate::PLAUSIBLE>(best.verdict.fits)) {
    out->finding = Finding::unknown;
    return;
  }
  out->why = doubt_of(*out, search);
  if (out->why == Why::none && !map_is_whole && !has_relief(around, out->best)) out->why = Why::smooth;
  out->finding = out->why == Why::none ? Finding::unique : Finding::ambiguous;
}

}  // namespace pose_wall::planar
