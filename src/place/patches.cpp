// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "place/patches.hpp"

#include <cmath>

namespace pose_wall::planar {

void PatchedPoints::lay_out(Arena& arena, std::uint32_t points_most) {
  patch = arena.take<std::uint8_t>(points_most);
  in_patch = arena.take<std::uint32_t>(kPatchesMost);
}

void PatchedPoints::sort(Span<const ScanPoint> from, double noise_m) {
  std::int32_t columns[kPatchesMost], rows[kPatchesMost];
  points = from;
  sigma_m = noise_m;
  patches = 0;
  for (std::uint32_t k = 0; k < points.size(); ++k) {
    const auto column = static_cast<std::int32_t>(std::floor(static_cast<double>(points[k].x_m)));
    const auto row = static_cast<std::int32_t>(std::floor(static_cast<double>(points[k].y_m)));
    std::uint32_t at = 0;
    while (at < patches && (columns[at] != column || rows[at] != row)) ++at;
    patch[k] = static_cast<std::uint8_t>(at);
    if (at == kPatchesMost) continue;
    if (at == patches) {
      columns[at] = column;
      rows[at] = row;
      in_patch[at] = 0;
      ++patches;
    }
    ++in_patch[at];
  }
}

PatchVerdict verdict_of(const PatchedPoints& view, const PatchSums& sums, PatchCosts* costs) {
  constexpr double kFits = 2.5;  // right places have 0.5 to 1.5, other rock 4 to 7
  PatchVerdict out;
  std::uint32_t fit = 0;
  for (std::uint32_t at = 0; at < view.patches; ++at) {
    const double cost = static_cast<double>(sums.cost[at]) / view.in_patch[at];
    costs->cost[at] = static_cast<std::uint8_t>(cost * (255.0 / kCostMost) + 0.5);
    if (!view.is_judged(at)) continue;
    ++out.judged;
    out.cost += cost;
    if (2 * sums.seen[at] < view.in_patch[at]) continue;
    ++out.seen;
    if (cost < kFits) ++fit;
  }
  out.fits = out.seen > 0 ? static_cast<double>(fit) / out.seen : 0.0;
  return out;
}

double worse_by(const PatchedPoints& view, const PatchCosts& best, const PatchCosts& other) {
  std::int64_t sum = 0, squares = 0;
  for (std::uint32_t at = 0; at < view.patches; ++at) {
    if (!view.is_judged(at)) continue;
    const std::int64_t gain = static_cast<std::int64_t>(other.cost[at]) - best.cost[at];
    sum += gain;
    squares += gain * gain;
  }
  return squares > 0 ? static_cast<double>(sum) / std::sqrt(static_cast<double>(squares)) : 0.0;
}

}  // namespace pose_wall::planar
