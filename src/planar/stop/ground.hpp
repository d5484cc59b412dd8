// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The floor around the machine: a plane near the one that its tracks stand on.

#pragma once

#include <cstdint>

#include "planar/stop/rays.hpp"
#include "planar/stop/settings.hpp"

namespace pose_wall::planar {

// z = height + slope_x x + slope_y y, all in base.
struct Ground {
  double height_m = 0.0, slope_x = 0.0, slope_y = 0.0;
  bool seen = false;
};

// The points that are looked at, about base, z above the tracks.
struct FloorLooks {
  // Errors of the floor's roughness fall below those of its shape.
  static constexpr std::uint32_t kMost = 1024;
  float x[kMost], y[kMost], z[kMost];
  std::uint32_t count;
};

// Least squares with gates that become narrower, from the machine's own plane on, which also counts as a measurement.
// Never outside slope_max_rad, nor further than the band from the tracks' height.
Ground find_ground(const Rays& rays, const Mount& mount, const StopSettings& settings, FloorLooks* looks);

}  // namespace pose_wall::planar
