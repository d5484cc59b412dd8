// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/walls/sample/step_profile.hpp"

#include <cmath>

#include "base/math/bits.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kNear = 2;    // slices, about a leaf (8 cm): a voxel's points may lie anywhere in it
constexpr std::uint32_t kRunMin = 6;  // slices, 0.3 m: a post is shorter (README, At a sampling point)
// At an edge, a voxel may hold points of both; swept: half 4 moved, twice 2 moved.
constexpr std::uint32_t kOffPerOn = 8;

// 64 steps of 0.05, from 58 degrees below the horizontal to as much above it.
std::uint64_t elevation_bit(double elevation) {
  const double bit = 20.0 * elevation + 32.0;
  return bit >= 0.0 && bit < 64.0 ? std::uint64_t{1} << static_cast<std::uint32_t>(bit) : 0U;
}

}  // namespace

void StepProfile::add(double beside_m, double residual_m, double elevation) {
  const double place = (beside_m + kHalf_m) * (1.0 / kSlice_m);
  if (!(place >= 0.0 && place < kCount)) return;
  const auto slice = static_cast<std::uint32_t>(place), part = slice / kSlicesPerPart;
  Slice& at = slices_[slice];
  const std::uint64_t bit = elevation_bit(elevation);
  elevations_ |= bit;
  const double off_m = std::fabs(residual_m);
  if (!(off_m >= step_m_)) {
    ++at.on;
    return;
  }
  at.off[residual_m > 0.0 ? kStepsOut : kStepsBack].add(off_m);
  const double depth = residual_m * (1.0 / kDepth_m);
  if (depth >= kHides && depth < kDepths) {
    Before& before = before_[static_cast<std::uint32_t>(depth)][part];
    before.elevations |= bit;
    ++before.count;
  }
}

bool StepProfile::lies_on(std::uint32_t slice, Way way) const {
  return slices_[slice].on * kOffPerOn > slices_[slice].off[way].count;
}

bool StepProfile::is_seen(std::uint32_t slice) const {
  constexpr std::uint32_t kSeen = 2;  // one may be a stray
  return slices_[slice].on >= kSeen;
}

double StepProfile::hole_m() const {
  std::uint32_t first = kCount / 2, last = kCount / 2;
  while (first > 0 && !is_seen(first - 1)) --first;
  while (last < kCount && !is_seen(last)) ++last;
  return first == 0 || last == kCount ? 2.0 * kHalf_m : (last - first) * kSlice_m;
}

// Slices without a point neither end a step nor lengthen it.
double StepProfile::step(Way way) const {
  constexpr std::uint32_t kPlace = kCount / 2;  // the slice of the sampling point
  for (std::uint32_t k = 0; k < kCount; ++k) {
    if (lies_on(k, way)) continue;
    std::uint32_t first = kCount, last = 0;
    Off total;
    for (; k < kCount && !lies_on(k, way); ++k) {
      const Off& off = slices_[k].off[way];
      if (off.count == 0) continue;
      if (first == kCount) first = k;
      last = k;
      total.count += off.count;
      total.sum_m += off.sum_m;
    }
    const bool at_place = first < kPlace + kNear && last + 1 + kNear > kPlace;
    if (total.count >= kPointsMin && at_place && last + 1 - first >= kRunMin) return total.sum_m / total.count;
  }
  return 0.0;
}

double StepProfile::before_m() const {
  const double step_m = step(kStepsOut);
  return step_m == 0.0 ? hides_m() : step_m;
}

double StepProfile::behind_m() const {
  return step(kStepsBack);
}

// Counts points in two steps of depth. Dust takes all elevations too, but it is neither a surface nor as dense.
bool StepProfile::hides_plane(std::uint32_t depth, std::uint32_t part) const {
  constexpr std::uint32_t kOnPerBefore = 2;  // half as dense as the plane (README): dust is thinner
  const Before &far = before_[depth][part], &near = before_[depth + 1][part];
  std::uint32_t on = 0;
  for (std::uint32_t k = 0; k < kSlicesPerPart; ++k) on += slices_[part * kSlicesPerPart + k].on;
  const int seen = bits_in(elevations_);
  return has_bits(far.elevations | near.elevations, seen - seen / 4) && kOnPerBefore * (far.count + near.count) >= on;
}

// Largest distance before the plane of a thing that hides it around the place.
double StepProfile::hides_m() const {
  // 0.6 m: posts are shorter; 48, not 165 of 1080 recorded values were valid and wrong (2026-11-24).
  constexpr std::uint32_t kPartsMin = 3;
  for (std::uint32_t depth = kDepths; depth-- > kHides;) {
    std::uint32_t first = kParts / 2, last = kParts / 2;
    while (first > 0 && hides_plane(depth, first - 1)) --first;
    while (last < kParts && hides_plane(depth, last)) ++last;
    if (last - first >= kPartsMin) return (depth + 2) * kDepth_m;
  }
  return 0.0;
}

}  // namespace pose_wall
