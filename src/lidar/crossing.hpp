// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// Where the ray from the sensor to a return meets a plane, of one ray or of four at a time.

#pragma once

namespace pose_wall {

// The share of the way from the sensor, `inside_m` before the plane, to a return behind it (signed distance r_m < 0).
template <typename Inside, typename Distance>
Distance way_to_plane(const Inside& inside_m, const Distance& r_m) {
  return inside_m / (inside_m - r_m);
}

// A coordinate at this share of the way.
template <typename Sensor, typename Return, typename Way>
Return on_the_way(const Sensor& sensor, const Return& there, const Way& way) {
  return sensor + (there - sensor) * way;
}

}  // namespace pose_wall
