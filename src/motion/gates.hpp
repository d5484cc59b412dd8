// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The limits that a claim of the motion hangs on, by their unit. "The sweep" compares other values of each on the same
// simulated frames, see README.

#pragma once

#include <cstdint>

namespace pose_wall::motion {

// ---- deviations: of a number that is standard normal without evidence, or of a squared error over its variance

// A claim: what patches of rock must prefer a place by over all others, and what a motion must show by. On smooth roads
// of four sensors the best of 17 places reached 4.2 (2026-11, simulated). With 7 for the patches the sweep measured 145
// frames and not 348. From 3 to 8 for the motion its levels stay the same.
constexpr double kClaim = 5.0;
// A guess of the place along: a standard normal number passes it once in 4,000. With 5 the sweep measured 273 frames
// and not 348, for a sparse sensor that starts on the move gets no map.
constexpr double kGuess = 3.5;
// By which the patches must prefer the best shift for another one to be excluded.
constexpr double kExcluded = 3.0;
// Beyond which an observation is of another surface and does not count. With 2.5 in the steps 27 of the sweep's poses
// left their level and not 9; with 8 only one did, and as many frames were measured.
constexpr float kOutlier = 4.0F;

// ---- shares

// Of the observations that lie on the map where the scan is expected, in time and after a gap. With less it is
// elsewhere and takes a wide start. From 0.05 to 0.4 and from 0.3 to 0.6 the sweep measured the same frames. Lower, a
// wrong guess is kept; higher, every gap costs a search.
constexpr double kOnMapInTime = 0.2, kOnMapAfterGap = 0.45;
// Likewise at the end of a wide start, less the start's cost. Lower, a scan of another place is taken for one of this;
// higher, a scan that sees a new side begins a new map. From 0.1 to 0.4 the sweep measured the same frames.
constexpr double kOnMapFound = 0.25;
// Of a curve's misfit that its best place lacks. Less is smooth rock, more without evidence is too few patches. On
// clean roads it was 0.03 to 0.10, on others 0.55 to 1.9 (the first trial of relief, 2026-11).
constexpr double kContrastLeast = 0.15;
// Hold along the axis (RoadAxes): below it no plane gives the way. Surfaces that face along are then bumps of the rock,
// which are seen from one side only. They drew steel sets by 30 mm (2026-11, simulated).
constexpr double kHoldOfRoad = 0.05;
constexpr double kHoldOfHall = 0.3;  // its own planes give the way
// Of the best place's misfit after a gap: a place that fits worse is no rival. From 1.2 to 2.5 the sweep measured the
// same frames.
constexpr double kRivalMisfit = 1.5;
// Of the range of top speed and turn: a place there is not the edge of the search. From 1 to 2.5 the sweep measured as
// many frames.
constexpr double kReachMargin = 1.5;

// ---- counts

// Fewer cannot be placed: 60 are to lie on ground and 80 to match. With 50 and with 400 the sweep measured the same
// frames.
constexpr std::uint32_t kObservationsLeast = 150;
// Of ground, that settle roll, pitch and height. With 20 and with 200 the sweep measured the same frames.
constexpr std::uint32_t kGroundLeast = 60;
// Of walls and roof: fewer are of one thing in sight. With 30 and with 200 the sweep measured the same frames: scans
// that fit give more.
constexpr std::uint32_t kMatchedLeast = 80;
constexpr std::uint32_t kCountLeast = 12;  // four for each of a step's three unknowns
// Of kRowsMost, for a curve. With 300 the sweep measured 289 frames and not 348, with 30 the same.
constexpr std::uint32_t kRowsLeast = 100;

// ---- metres and seconds

// Two halves of the rock that differ widen sigma; that far apart, more than two cells, one of them is wrong. From
// 0.05 to 0.3 the sweep measured as many frames.
constexpr double kHalvesMost_m = 0.12;
// More, and the map's rock is somewhere else: twice the reach of a curve. With 2 m 30 of the sweep's poses left their
// level and not 9; with 0.3 m 299 frames were measured and not 348.
constexpr double kSlipMost_m = 0.8;
// Without a frame: longer, and a guess by the last speed is none. A machine that stops from 1 m/s is then 0.35 m off,
// within the reach of one curve.
constexpr double kGap_s = 0.35;

}  // namespace pose_wall::motion
