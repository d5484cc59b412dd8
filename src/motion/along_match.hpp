// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The way along the road, by the relief of the rock and by planes that face along: the fit of the scan to the map at
// each shift, and the significance of that curve. The other five directions are fitted anew at every shift, so that a
// bend or a slope of a smooth road is no evidence.

#pragma once

#include "motion/registration.hpp"

namespace pose_wall::motion {

// Of one curve, to each side: half of a usual pitch of steel sets, so that the next one is out of it.
constexpr double kReachMost_m = 0.4;
constexpr double kCurveStep_m = kReachMost_m / 16;  // half of a cell along: heights between two cells are interpolated
constexpr std::uint32_t kShiftsMost = 33;           // in these steps, and the middle
constexpr std::uint32_t kFineShifts = 7;            // of the last centimetres: a parabola has three numbers
constexpr std::uint32_t kRowsMost = 2048;           // observations of the curve
constexpr int kRest = 6;  // turns about along, across and up, moves across and up, and the common range error

struct Curve {
  double best_m = 0.0;    // shift of the scan along the road that fits best, to a part of a step
  double bottom = 0.0;    // mean squared misfit there, in variances
  double contrast = 0.0;  // (median - bottom) / bottom
  double patches = 0.0;   // how clearly the patches of rock agree that it fits better there than elsewhere
  // Which other shifts the patches do not exclude: up to so far about the best, and apart from these.
  double around_m = 0.0, apart_m = 0.0;
  double second_m = 0.0, second_gain = 0.0;
  bool open = false;  // as far as was searched nothing is excluded, on one side at least
  bool told = false;  // a curve could be drawn
};

// True if the curve gives a place: the patches agree, and exclude the ends of the search.
bool is_evidence(const Curve& curve);

struct CurveScratch {
  void lay_out(Arena& arena);
  Span<float> misfit;            // [shift][row], in deviations; NaN where the map knows nothing
  Span<float> jacobian;          // [kRest][row]
  Span<std::uint16_t> tile;      // [row]
  Span<std::uint16_t> patch;     // [row]: of the tiles that rows lie on, in their order
  Span<std::uint16_t> patch_of;  // [tile], where rows lie on it
  Span<std::uint8_t> faces;      // [patch]: 1 if it faces along
  Span<float> gain;              // [patch]
};

// The rows at a shift so small that the curve is a parabola: the place of its bottom, and its standard deviation by
// patches of rock, which err together.
struct FinePlace {
  double best_m = 0.0, sigma_m = 0.0;
  double halves_m = 0.0;  // by how much two halves of the patches differ
  bool told = false;
};
FinePlace refine_along(const Scan& scan, const Alignment& alignment, CurveScratch* scratch);

// Shifts from -reach_m to reach_m in equal steps about the alignment, by at most so many observations.
Curve match_along(const Scan& scan, const Alignment& alignment, double reach_m, std::uint32_t shifts,
                  CurveScratch* scratch, std::uint32_t rows_most = kRowsMost);

}  // namespace pose_wall::motion
