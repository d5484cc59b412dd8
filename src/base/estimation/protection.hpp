// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The factor before the standard deviation in a protection level. It follows from the risk that the user states.

#pragma once

#include <cmath>

#include "base/math/elementary.hpp"

namespace pose_wall {

// Share of a normal distribution beyond so many standard deviations, on both sides: an upper bound (Sampford 1953), 2 %
// above at 1, 0.3 % at 2 and 0.01 % at 5.
inline double share_beyond(double sigmas) {
  constexpr double kRootOf2ByPi = 0.79788456080286536;  // of the normal density
  constexpr double kNothingBeyond = 37.0;               // 1e-299 is left, and exponential() ends soon
  if (!(sigmas < kNothingBeyond)) return 0.0;
  const double square = sigmas * sigmas;
  return 4.0 * kRootOf2ByPi * exponential(-0.5 * square) / (3.0 * sigmas + std::sqrt(square + 8.0));
}

// Normal quantile: beyond so many standard deviations, on both sides, lies the risk. For risks from 1e-12 to 0.5,
// within 1e-3, and never too small.
inline double sigmas_at_risk(double risk) {
  constexpr int kHalvings = 56;  // 8 / 2^56 is less than a double resolves at 1
  double low = 0.0, high = 8.0;  // 1.2e-15 is left beyond
  for (int step = 0; step < kHalvings; ++step) {
    const double middle = 0.5 * (low + high);
    (share_beyond(middle) > risk ? low : high) = middle;
  }
  return high;
}

// How many standard deviations the protection level spans when the standard deviation itself comes from only so many
// independent patches: the normal quantile k stretched to Student's t (Fisher and Cornish 1960, first term).
inline double protection_factor(double k, double dof) {
  return k * (1.0 + (k * k + 1.0) / (4.0 * dof));
}

}  // namespace pose_wall
