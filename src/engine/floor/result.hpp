// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The result of the floor's stage.

#pragma once

#include "base/estimation/protection.hpp"
#include "base/math/finite.hpp"
#include "engine/config.hpp"
#include "engine/types.hpp"

namespace pose_wall {

struct FloorResult {
  PlaneFit fit;
  double roll_sigma_rad = 0.0;
  double pitch_sigma_rad = 0.0;
  // By which other rock beside the machine moves the two: standard deviations. None without a region's plane.
  double roll_waves_rad = 0.0;
  double pitch_waves_rad = 0.0;
  // Systematic part of the protection level: range bias, unevenness, rival floors, walls that lean.
  ProtectionParts roll_bound_rad;
  ProtectionParts pitch_bound_rad;
  double dof = 1.0;  // the variance is known as well as from so many independent pieces
  double area_m2 = 0.0;
  double roi_radius_m = 0.0;
  std::uint32_t open_points = 0;  // open points within the radius

  // The truth may be another floor, whose roll and pitch lie so far off.
  void reach_to_rival(double roll_rad, double pitch_rad) {
    roll_bound_rad[POSE_WALL_PART_RIVAL] += roll_rad;
    pitch_bound_rad[POSE_WALL_PART_RIVAL] += pitch_rad;
  }
};

// Protection levels of the two angles. A refused floor has none.
struct Protections {
  double roll_rad, pitch_rad;
  double worse() const { return larger(roll_rad, pitch_rad); }
};

inline Protections protections_of(const FloorResult& f, const Settings& s) {
  constexpr double kNone_rad = 1e9;  // no protection at all: larger than any
  if (f.fit.refused) return {kNone_rad, kNone_rad};
  const double k = protection_factor(s.protection_sigmas, f.dof);
  return {k * f.roll_sigma_rad + f.roll_bound_rad.sum(), k * f.pitch_sigma_rad + f.pitch_bound_rad.sum()};
}

}  // namespace pose_wall
