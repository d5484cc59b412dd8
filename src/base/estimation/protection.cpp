// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "base/estimation/protection.hpp"

namespace pose_wall {

double sigmas_at_risk(double risk) {
  constexpr int kHalvings = 56;  // 8 / 2^56 is less than a double resolves at 1
  double low = 0.0, high = 8.0;  // 1.2e-15 is left beyond
  for (int step = 0; step < kHalvings; ++step) {
    const double middle = 0.5 * (low + high);
    (share_beyond(middle) > risk ? low : high) = middle;
  }
  return high;
}

}  // namespace pose_wall
