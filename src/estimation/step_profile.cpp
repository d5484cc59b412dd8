// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "estimation/step_profile.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kNear = 2;    // slices: so well is the place known, and where a voxel's points lie in it
constexpr std::uint32_t kRunMin = 6;  // slices
constexpr std::uint32_t kPointsMin = 10;
constexpr std::uint32_t kOffPerOn = 8;  // at an edge, a voxel may hold points of both

}  // namespace

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

// Slices without a point neither end a step nor make one longer at its ends.
double StepProfile::step(Way way) const {
  constexpr std::uint32_t kPlace = kCount / 2;
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

}  // namespace pose_wall
