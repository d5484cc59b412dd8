// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// How a scan's times go with its azimuths: the turn of the sensor, and what the points are off it.

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "io/frames/frame.hpp"

namespace pose_wall::tools {

// A return with its time, in the sensor's frame.
struct TimedReturn {
  double azimuth_rad = 0.0, elevation_rad = 0.0, across_m = 0.0;  // across: from the sensor's axis
  double time_s = 0.0;                                            // from the scan's first point on
  std::uint32_t ring = 0;
};

struct Turn {
  double off_moment = 1.0;  // share of directions that are not of their moment: 0 looks one way, 1 all round
  double off_turn = 1.0;    // share of returns more than a twentieth of a turn off the line
  double rate_rad_s = 0.0;
  double phase_rad = 0.0;  // azimuth at time 0
};

// spread_s: from the first to the last point, above 0.
Turn turn_of(const std::vector<TimedReturn>& returns, double spread_s);

// Standard deviation of the elevations of a ring's returns, rad: small where the sensor's axis is the cloud's.
double lean_rad(const std::vector<TimedReturn>& returns);

// The speed by which points have been moved in proportion to their times, where that explains what they are off the
// turn. Nothing where they were not, or where it does not show.
std::optional<double> moved_m_s(const std::vector<TimedReturn>& returns, const Turn& turn, double spread_s);

}  // namespace pose_wall::tools
