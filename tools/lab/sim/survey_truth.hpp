// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What a surveyor with a dense scan would report of a real road: planes of what is really there, within stated regions.
//
// Regions and formula are those of include/DEFINITIONS.md. A wall that is none by them has no truth, nor has yaw
// without any wall.
#pragma once

#include "io/csv/truth_csv.hpp"
#include "lab/sim/rock_surface.hpp"
#include "lab/sim/setup.hpp"

namespace pose_wall::tools::sim {

// Half lengths of the regions about base; heights are above the floor. Of the floor the sensor tells how far along.
inline constexpr double kFloorAcross_m = 1.125, kWallAlong_m = 2.5, kWallLow_m = 0.25, kWallHigh_m = 2.5;

// How far a probe looks for rock: wider than any roadway.
inline constexpr double kProbe_m = 30.0;

// Values alone: without pose and stamp.
TruthRow survey_truth(const RockSurface& rock, const Placement& base, const Machine& machine,
                      const Sensor& sensor = {});

}  // namespace pose_wall::tools::sim
