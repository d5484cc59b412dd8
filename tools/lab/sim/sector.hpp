// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A part of the circle, counter-clockwise from one azimuth to another; none where both are the same, all where they are
// a whole turn apart.
#pragma once

#include <cmath>

namespace pose_wall::tools::sim {

inline bool in_sector(double azimuth_deg, double from_deg, double to_deg) {
  const auto turn = [from_deg](double angle_deg) { return std::fmod(angle_deg - from_deg + 720.0, 360.0); };
  if (to_deg - from_deg >= 360.0) return true;
  return from_deg != to_deg && turn(azimuth_deg) <= turn(to_deg);
}

}  // namespace pose_wall::tools::sim
