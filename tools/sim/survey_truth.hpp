// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a surveyor with a dense scan would report of a real road: planes of what is really there, within stated regions.
//
// Floor: the plane, by area, of what lies below base within kFloorAlong_m along the road and kFloorAcross_m across it.
// Wall: the plane, by area, of what lies to that side within kWallAlong_m along the road, kWallLow_m to kWallHigh_m
// above the floor. An MM-estimate (Yohai 1987): openings and things weigh little, by Tukey's function of their
// distance from the plane that half of the rock is nearest to. What ends 3 m behind the nearest rock is an opening. A
// wall of which less than half is near its plane has no truth, nor has yaw without any wall.
#pragma once

#include "sim/rock_surface.hpp"
#include "sim/setup.hpp"
#include "truth/truth_csv.hpp"

namespace pose_wall::tools::sim {

// Half lengths of the regions about base; heights are above the floor. As long as the trials on a real gallery, in
// which 2.5 m met fewer openings than 5 m, and as wide as a machine and half a metre on either side. 2026-11.
inline constexpr double kFloorAlong_m = 3.0, kFloorAcross_m = 1.1, kWallAlong_m = 2.5, kWallLow_m = 0.25,
                        kWallHigh_m = 2.5;

// How far a probe looks for rock: wider than any roadway.
inline constexpr double kProbe_m = 30.0;

// Values alone: without pose and stamp.
TruthRow survey_truth(const RockSurface& rock, const Placement& base, const Machine& machine);

}  // namespace pose_wall::tools::sim
