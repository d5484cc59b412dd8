// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/fit/strip_profile.hpp"

#include <cmath>

#include "base/math/bits.hpp"

namespace pose_wall {
namespace {

constexpr int kRowBits = 16;  // a bit for each height
// At fewer heights a column's mean is the rock's there; swept: half 3 won, twice 2 lost 4 won.
constexpr int kRowsMin = 4;
// Columns to each side for the local level, 0.65 m; swept: half 2 lost 6 won, twice 1 lost 4 won.
constexpr std::int32_t kAround = 6;
// A quantile of fewer columns is no level; swept: half 1 won, twice 2 lost 1 won.
constexpr std::uint32_t kAroundMin = 5;
constexpr double kLevelQuantile = 0.3;     // the rock's, as long as strips take at most 60 % of the columns around
constexpr std::uint32_t kColumnsMin = 24;  // two Gaussians need 1.2 m; swept: half nothing, twice 1 won
// The mean over a column does not scatter less; swept: half 1 moved, twice 5 moved.
constexpr double kSigmaMin_m = 0.004;
// Log likelihood; twice it is chi-square(3)'s 95 % point; swept: half nothing, twice 4 moved.
constexpr double kGainMin = 4.0;
constexpr double kApartInSigmas = 2.0;  // two equal Gaussians further apart have two tops
// Crooked rock, over many columns, must not pass; swept: half 2 moved, twice 1 won.
constexpr double kGainPerColumn = 0.04;
constexpr std::int32_t kStripsMin = 3;  // one or two could be bulges of the rock
constexpr std::int32_t kStripMax = 6;   // columns, 0.3 m: steel sets and props are a decimetre wide
constexpr std::int32_t kFlank = 2;      // columns to each side: the flanks of a strip belong to it
constexpr double kWideShareMax = 0.34;  // one wide thing to three strips; swept: half and twice change nothing

}  // namespace

void StripProfile::lay_out(Arena& arena) {
  columns_ = arena.take<Column>(kColumns);
  verdicts_ = arena.take<StripVerdict>(kColumns);
}

void StripProfile::begin(double u_min_m, double z_min_m, double z_max_m) {
  u_min_ = u_min_m;
  z_min_ = z_min_m;
  rows_per_m_ = kRowBits / (z_max_m - z_min_m);
  columns_.fill(Column{});
  verdicts_.fill(StripVerdict{});
}

void StripProfile::add(FourFloats u_m, FourFloats v_m, FourFloats r_m, FourFloats z_m, FourTruths counts) {
  const FourFloats none{};
  const FourFloats column = (u_m - static_cast<float>(u_min_)) * static_cast<float>(kColumnsPerMetre);
  const FourFloats row = (z_m - static_cast<float>(z_min_)) * static_cast<float>(rows_per_m_);
  const FourTruths inside = counts & (column >= none) & (column < all_four(static_cast<float>(kColumns))) &
                            (row >= none) & (row < all_four(static_cast<float>(kRowBits)));
  const FourInts columns = cut_off(inside ? column : none), rows = cut_off(inside ? row : none);
  for (std::uint32_t k = 0; k < kFour; ++k) {
    if (inside[k] == 0) continue;
    Column& c = columns_[static_cast<std::uint32_t>(columns[k])];
    c.sums += FourFloats{r_m[k], u_m[k], v_m[k], 1.0F};
    c.rows |= 1U << static_cast<unsigned>(rows[k]);
  }
}

// The mean distance of a column's points is the distance of their mean, so no point is read again.
void StripProfile::look_from(const PlaneOver& over) {
  const double foreshortening = over.foreshortening();
  for (Column& c : columns_) {
    if (!c.has_points()) continue;
    const double r = static_cast<double>(c.sums[0]), u = static_cast<double>(c.sums[1]),
                 v = static_cast<double>(c.sums[2]), points = static_cast<double>(c.sums[3]);
    c.mean_m = ((r - over.slope_u * u - over.slope_v * v) / points - over.offset_m) * foreshortening;
  }
}

bool StripProfile::seen(const Column& c) const {
  return has_bits(c.rows, kRowsMin);
}

bool StripProfile::level_around(std::int32_t column, double* level_m) const {
  double means[2 * kAround + 1];
  std::uint32_t n = 0;
  for (std::int32_t k = column - kAround; k <= column + kAround; ++k) {
    if (k < 0 || k >= static_cast<std::int32_t>(kColumns)) continue;
    const Column& c = columns_[static_cast<std::uint32_t>(k)];
    if (!seen(c)) continue;
    // Insertion keeps them sorted; there are at most 13.
    std::uint32_t at = n++;
    for (const double value = c.mean_m;; --at) {
      if (at == 0 || means[at - 1] <= value) {
        means[at] = value;
        break;
      }
      means[at] = means[at - 1];
    }
  }
  if (n < kAroundMin) return false;
  *level_m = means[static_cast<std::uint32_t>(kLevelQuantile * static_cast<double>(n - 1) + 0.5)];
  return true;
}

void StripProfile::find_levels(std::int32_t first, std::int32_t last) {
  for (std::int32_t k = first; k <= last; ++k) {
    Column& c = columns_[static_cast<std::uint32_t>(k)];
    c.has_level = seen(c) && level_around(k, &c.level_m);
  }
}

// Strips are narrow and come in numbers; bulges of the rock are wide.
bool StripProfile::narrow(std::int32_t first, std::int32_t last, double gate_m) const {
  std::int32_t strips = 0, wide = 0, width = 0;
  for (std::int32_t k = first; k <= last + 1; ++k) {
    bool near = false;
    if (k <= last && columns_[static_cast<std::uint32_t>(k)].has_level) {
      const double contrast = contrast_of(columns_[static_cast<std::uint32_t>(k)]);
      near = contrast <= gate_m && layers_.surface_probability(contrast) < 0.5;
    }
    if (near) {
      ++width;
      continue;
    }
    if (width > 0) ++(width <= kStripMax ? strips : wide);
    width = 0;
  }
  return strips >= kStripsMin && static_cast<double>(wide) <= kWideShareMax * static_cast<double>(strips);
}

bool StripProfile::find(const PlaneOver& over, double u_centre_m, double reach_m, double gate_m) {
  layers_ = TwoLayers{};
  look_from(over);
  std::int32_t first = column_of(u_centre_m - reach_m), last = column_of(u_centre_m + reach_m);
  if (first < 0) first = 0;
  if (last < 0) last = static_cast<std::int32_t>(kColumns) - 1;
  find_levels(first, last);
  LayerHistogram contrast(gate_m);
  for (std::int32_t k = first; k <= last; ++k) {
    const Column& c = columns_[static_cast<std::uint32_t>(k)];
    if (c.has_level) contrast.add(contrast_of(c));
  }
  if (contrast.total() < kColumnsMin) return false;
  const double gain = kGainPerColumn * contrast.total();
  layers_ = find_two_layers(contrast, {kSigmaMin_m, gain > kGainMin ? gain : kGainMin, kApartInSigmas});
  layers_.found = layers_.found && narrow(first, last, gate_m);
  if (!layers_.found) return false;
  for (std::int32_t k = first; k <= last; ++k) {
    Column& c = columns_[static_cast<std::uint32_t>(k)];
    if (!c.has_level) continue;
    c.probability = static_cast<float>(layers_.surface_probability(contrast_of(c)));
    c.judged = true;
  }
  look_at_flanks(first, last);
  return true;
}

double StripProfile::judge(const PlaneOver& over, double u_centre_m, double reach_m) {
  look_from(over);
  std::int32_t first = column_of(u_centre_m - reach_m), last = column_of(u_centre_m + reach_m);
  if (first < 0) first = 0;
  if (last < 0) last = static_cast<std::int32_t>(kColumns) - 1;
  // Scatter of the rock's columns about the plane, without the local level.
  double w = 0.0, squares = 0.0;
  float points_before = 0.0F, points_now = 0.0F;
  for (const Column& c : columns_) {
    if (!c.judged || !c.has_points()) continue;
    points_before += c.sums[3];
    w += static_cast<double>(c.probability);
    squares += static_cast<double>(c.probability) * c.mean_m * c.mean_m;
  }
  TwoLayers plain = layers_;
  plain.centre_m = 0.0;
  plain.share = 0.5;
  plain.sigma_m = w > 0.0 ? std::sqrt(squares / w) : layers_.sigma_m;
  if (!(plain.sigma_m >= layers_.sigma_m)) plain.sigma_m = layers_.sigma_m;
  for (std::int32_t k = first; k <= last; ++k) {
    Column& c = columns_[static_cast<std::uint32_t>(k)];
    if (c.judged || !c.has_points()) continue;
    points_now += c.sums[3];
    // The plane may drift out here. The level around corrects that, unless it may be the strips' own.
    double level = 0.0;
    const bool local = level_around(k, &level) && std::fabs(level) < 0.5 * layers_.step_m;
    c.probability =
        static_cast<float>(local ? layers_.surface_probability(c.mean_m - level) : plain.surface_probability(c.mean_m));
    c.judged = true;
  }
  look_at_flanks(first, last);
  return static_cast<double>(points_now / (points_before + points_now));
}

// The flanks of a strip lie between it and the wall, and belong to the strip. Columns further out are still unknown.
void StripProfile::look_at_flanks(std::int32_t first, std::int32_t last) {
  static_assert(kFlank == 2, "two columns before and two behind");
  const auto lesser = [](float a, float b) { return a < b ? a : b; };
  float second_before = 1.0F, before = 1.0F, here = 1.0F, behind = 1.0F;
  for (std::int32_t ahead = first - kFlank; ahead <= last + kFlank; ++ahead) {
    float second_behind = 1.0F;
    if (ahead >= 0 && ahead < static_cast<std::int32_t>(kColumns)) {
      const Column& c = columns_[static_cast<std::uint32_t>(ahead)];
      if (c.judged && c.has_points()) second_behind = c.probability;
    }
    if (ahead >= first + kFlank) {
      const auto at = static_cast<std::uint32_t>(ahead - kFlank);
      const Column& c = columns_[at];
      const float flanks = lesser(lesser(second_before, before), lesser(behind, second_behind));
      verdicts_[at] = {lesser(lesser(c.probability, here), flanks), c.is_strip() ? -1 : 0};
    }
    second_before = before;
    before = here;
    here = behind;
    behind = second_behind;
  }
}

}  // namespace pose_wall
