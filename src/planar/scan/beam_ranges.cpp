// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "planar/scan/beam_ranges.hpp"

#include <cmath>

#include "base/math/elementary.hpp"
#include "base/math/finite.hpp"

namespace pose_wall::planar {
namespace {

constexpr double kDepth_m = 0.2;       // of a surface: relief of rock, and what leans within the band
constexpr double kDepthSigmas = 6.0;   // of a surface, where noise is more than its relief
constexpr double kSteepest = 11.4;     // tan 85 degrees: a surface that a sensor sees more slantingly is none
constexpr double kJoinSigmas = 4.0;    // by which two nearest ranges of one surface may differ
constexpr std::uint32_t kPooled = 32;  // beams to each side that share one scatter: some 2 to 6 degrees
constexpr double kSureSigmas = 2.0;    // a scatter this far above that of noise shows relief

// Quantile of the standard normal distribution for p in (0, 0.5], within 4.5e-4 (Abramowitz and Stegun 26.2.23).
double lower_quantile(double p) {
  const double t = std::sqrt(-2.0 * natural_log(p));
  return (2.515517 + t * (0.802853 + t * 0.010328)) / (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308))) - t;
}

class Finder {
 public:
  Finder(const ScanSettings& settings, const OrderStatistics& statistics, Evidence* evidence, BeamRanges* ranges)
      : s_(settings),
        statistics_(statistics),
        e_(*evidence),
        r_(*ranges),
        step_(static_cast<float>(settings.angle_step_rad)) {
    const double depth_m = kDepthSigmas * s_.sigma_m;
    depth_m_ = static_cast<float>(depth_m > kDepth_m ? depth_m : kDepth_m);
  }

  void run() {
    begin();
    list_seen();
    join();
    for (std::uint32_t i = 0; i < seen_; ++i) r_.gathered[r_.seen[i].beam] = empty();
    gather([](std::uint32_t) { return true; });
    if (mark_alone() && s_.alone_is_apart) look_behind();
    pool_scatter();
    for (std::uint32_t i = 0; i < seen_; ++i) settle(i);
    for (std::uint32_t i = 0; i < seen_; ++i) fill_behind(i);
  }

 private:
  static Gathered empty() { return {all_four(kNothing_m), 0.0F, 0.0F, kNothing_m, 0}; }

  void begin() {
    const auto nan = static_cast<float>(not_a_number());
    r_.range_m.fill(nan);
    r_.sigma_m.fill(nan);
    r_.alone_m.fill(nan);
    r_.behind_m.fill(nan);
    r_.bias_m.fill(0.0F);
    r_.returns.fill(0);
  }

  void list_seen() {
    seen_ = 0;
    for (std::uint32_t beam = 0; beam < s_.beams; ++beam) {
      if (e_.nearest_m[beam] < kNothing_m) r_.seen[seen_++] = {static_cast<std::uint16_t>(beam), 0, 0};
    }
  }

  std::uint32_t next_of(std::uint32_t i) const { return i + 1 < seen_ ? i + 1 : 0; }
  // Beams from a seen one to the next; over the end of the list only where the scan goes round.
  std::uint32_t steps_to_next(std::uint32_t i) const {
    const std::uint32_t here = r_.seen[i].beam;
    if (i + 1 < seen_) return r_.seen[i + 1].beam - here;
    return s_.goes_round && seen_ > 1 ? r_.seen[0].beam + s_.beams - here : s_.beams;
  }

  // Which neighbours can be one surface, and its slopes.
  void join() {
    const auto apart_m = static_cast<float>(kJoinSigmas * s_.sigma_m);
    for (std::uint32_t i = 0; i < seen_; ++i) {
      const std::uint32_t steps = steps_to_next(i);
      const float a = e_.nearest_m[r_.seen[i].beam], b = e_.nearest_m[r_.seen[next_of(i)].beam];
      const float near = a < b ? a : b, far = a < b ? b : a;
      const float most_m = apart_m + static_cast<float>(kSteepest) * near * step_ * static_cast<float>(steps);
      r_.seen[i].joined = steps <= s_.fill_beams && far - near <= most_m ? 1 : 0;
    }
    for (std::uint32_t i = 0; i < seen_; ++i) {
      const std::uint32_t before = i > 0 ? i - 1 : seen_ - 1;
      const bool has_before = r_.seen[before].joined != 0, has_next = r_.seen[i].joined != 0;
      const std::uint32_t from = has_before ? before : i, to = has_next ? next_of(i) : i;
      const std::uint32_t steps = (has_before ? steps_to_next(before) : 0) + (has_next ? steps_to_next(i) : 0);
      const float rise_m = e_.nearest_m[r_.seen[to].beam] - e_.nearest_m[r_.seen[from].beam];
      r_.slope_m[r_.seen[i].beam] = steps > 0 ? rise_m / static_cast<float>(steps) : 0.0F;
    }
  }

  template <typename Takes>
  void gather(const Takes& takes) {
    for (std::uint32_t i = 0; i < e_.return_count; ++i) {
      const BandReturn one = e_.returns[i];
      if (!takes(one.beam)) continue;
      const float nearest_m = e_.nearest_m[one.beam];
      const float slope_m = r_.slope_m[one.beam], steep_m = slope_m < 0.0F ? -slope_m : slope_m;
      const float beyond_m = one.range_m - slope_m * kAsides * static_cast<float>(one.aside) - nearest_m;
      Gathered& g = r_.gathered[one.beam];
      if (beyond_m > depth_m_ + steep_m) {
        if (one.range_m < g.behind_m) g.behind_m = one.range_m;
        continue;
      }
      if (one.range_m < nearest_m) continue;  // passed by
      ++g.count;
      g.sum_m += beyond_m;
      g.sum_m2 += beyond_m * beyond_m;
      g.least_m = with(beyond_m, g.least_m);
    }
  }

  // Into its place among the four least: each is the smaller of itself and of the larger of the newcomer and the one
  // before it. Without branches, which would follow the noise.
  static FourFloats with(float newcomer, FourFloats least) {
    const FourFloats four = all_four(newcomer);
    const FourFloats before = picked<4, 0, 1, 2>(least, four);
    return smaller_of(least, larger_of(before, four));
  }

  bool mark_alone() {
    bool any = false;
    for (std::uint32_t i = 0; i < seen_; ++i) {
      SeenBeam& one = r_.seen[i];
      const bool has_company = one.joined != 0 || r_.seen[i > 0 ? i - 1 : seen_ - 1].joined != 0;
      if (has_company || r_.gathered[one.beam].count > 1) continue;
      one.alone = 1;
      r_.alone_m[one.beam] = e_.nearest_m[one.beam];
      any = true;
    }
    return any;
  }

  // The surfaces behind returns that are alone, with all that is behind them.
  void look_behind() {
    for (std::uint32_t i = 0; i < seen_; ++i) {
      const std::uint32_t beam = r_.seen[i].beam;
      const float behind_m = r_.gathered[beam].behind_m;
      r_.seen[i].alone = r_.seen[i].alone != 0 && behind_m < kNothing_m ? 1 : 0;
      if (r_.seen[i].alone == 0) continue;
      e_.nearest_m[beam] = behind_m;
      r_.gathered[beam] = empty();
      r_.returns[beam] = 1;  // a mark until it is settled
    }
    join();
    gather([this](std::uint32_t beam) { return r_.returns[beam] != 0; });
  }

  void pool_scatter() {
    double squares_m2 = 0.0;
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < seen_; ++i) {
      const Gathered& g = r_.gathered[r_.seen[i].beam];
      if (g.count > 1) {
        const double sum_m = static_cast<double>(g.sum_m);
        const double about_mean_m2 = static_cast<double>(g.sum_m2) - sum_m * sum_m / g.count;
        squares_m2 += about_mean_m2 > 0.0 ? about_mean_m2 : 0.0;
        count += g.count - 1;
      }
      r_.scatter_m2[i] = squares_m2;
      r_.scatter_count[i] = count;
    }
  }

  // Standard deviation of the returns about their surface, of a seen beam and those beside it; and its noise alone.
  struct Scatter {
    double whole_m, relief_m;
  };
  Scatter scatter_of(std::uint32_t i) const {
    const std::uint32_t last = i + kPooled < seen_ ? i + kPooled : seen_ - 1;
    const double before_m2 = i > kPooled ? r_.scatter_m2[i - kPooled - 1] : 0.0;
    const std::uint32_t before = i > kPooled ? r_.scatter_count[i - kPooled - 1] : 0;
    const std::uint32_t count = r_.scatter_count[last] - before;
    if (count == 0) return {s_.sigma_m, 0.0};
    const double noise_m2 = s_.sigma_m * s_.sigma_m, whole_m2 = (r_.scatter_m2[last] - before_m2) / count;
    const bool shows_relief = whole_m2 > noise_m2 * (1.0 + kSureSigmas * std::sqrt(2.0 / count));
    return {std::sqrt(whole_m2 > 0.0 ? whole_m2 : 0.0), shows_relief ? std::sqrt(whole_m2 - noise_m2) : 0.0};
  }

  void settle(std::uint32_t i) {
    const std::uint32_t beam = r_.seen[i].beam;
    const Gathered& g = r_.gathered[beam];
    const Scatter scatter = scatter_of(i);
    const std::uint32_t count = g.count > 0 ? g.count : 1;  // 0: beyond the returns that are kept
    // What the noise adds to the scatter of the rock, it takes from the k-th smallest.
    const double noise_m = std::sqrt(scatter.relief_m * scatter.relief_m + s_.sigma_m * s_.sigma_m) - scatter.relief_m;
    const double bias_m = -statistics_.expected(count) * noise_m;
    const float kth_m = g.count > 0 ? g.least_m[OrderStatistics::rank_of(count) - 1] : 0.0F;
    const float range_m = e_.nearest_m[beam] + kth_m + static_cast<float>(bias_m);
    r_.bias_m[beam] = static_cast<float>(bias_m);
    r_.sigma_m[beam] = static_cast<float>(scatter.whole_m);
    r_.returns[beam] = static_cast<std::uint16_t>(count < 65535U ? count : 65535U);
    r_.range_m[beam] = range_m;
    if (g.behind_m < kNothing_m) r_.behind_m[beam] = g.behind_m;
  }

  // A straight surface between two joined beams: its inverse range is straight, too, over such small angles.
  void fill_behind(std::uint32_t i) {
    if (r_.seen[i].joined == 0) return;
    const std::uint32_t here = r_.seen[i].beam, there = r_.seen[next_of(i)].beam, steps = steps_to_next(i);
    const float a = 1.0F / r_.range_m[here], b = 1.0F / r_.range_m[there];
    for (std::uint32_t k = 1; k < steps; ++k) {
      const std::uint32_t beam = here + k < s_.beams ? here + k : here + k - s_.beams;
      r_.range_m[beam] = 1.0F / (a + (b - a) * (static_cast<float>(k) / static_cast<float>(steps)));
      r_.sigma_m[beam] = r_.sigma_m[here];
    }
  }

  const ScanSettings& s_;
  const OrderStatistics& statistics_;
  Evidence& e_;
  BeamRanges& r_;
  float step_, depth_m_;
  std::uint32_t seen_ = 0;
};

}  // namespace

OrderStatistics::OrderStatistics() {
  mean[0] = 0.0;
  for (std::uint32_t n = 1; n <= kReturnsKnown; ++n) {
    const double p = (rank_of(n) - 0.375) / (n + 0.25);  // Blom, Statistical Estimates, 1958
    mean[n] = n > 1 ? lower_quantile(p) : 0.0;
  }
}

void BeamRanges::lay_out(Arena& arena, std::uint32_t beams) {
  range_m = arena.take<float>(beams);
  bias_m = arena.take<float>(beams);
  sigma_m = arena.take<float>(beams);
  alone_m = arena.take<float>(beams);
  behind_m = arena.take<float>(beams);
  returns = arena.take<std::uint16_t>(beams);
  gathered = arena.take<Gathered>(beams);
  slope_m = arena.take<float>(beams);
  seen = arena.take<SeenBeam>(beams);
  scatter_m2 = arena.take<double>(beams);
  scatter_count = arena.take<std::uint32_t>(beams);
}

void find_ranges(const ScanSettings& settings, const OrderStatistics& statistics, Evidence* evidence,
                 BeamRanges* ranges) {
  Finder(settings, statistics, evidence, ranges).run();
}

}  // namespace pose_wall::planar
