// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What stands, hangs and lies in a road: steel sets, pipes, belt, vehicle, people, heaps, bench, water.

#pragma once

#include <array>

#include "judge/road.hpp"

namespace pose_wall::judge {

// Where along its length a road changes.
struct RoadLine {
  double end_m = 30.0;  // straight as far as that: face or bend
  double ramp_x_m = 1e3, ramp_slope = 0.0;
  double gap_side = 0.0;  // 1: the crosscut opens to the left
  std::array<double, 2> gap_m = {-45.0, -1.0};
};

// The foot of a wall at z = 0.
Vector3d on_wall_m(const Plane& plane, double x_m);

// Adds what the road's features name, and notes what room it takes beside the machine.
void furnish(Road* road, const RoadLine& line, Draw* draw);

}  // namespace pose_wall::judge
