// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The result of the floor's stage.

#pragma once

#include "base/estimation/protection.hpp"
#include "base/estimation/tangent_frame.hpp"
#include "base/estimation/uneven_plane.hpp"
#include "base/math/finite.hpp"
#include "engine/config.hpp"
#include "engine/types.hpp"

namespace pose_wall {

// What is known of the error of one angle.
struct AngleErrors {
  double sigma_rad = 0.0;
  double dof = 1.0;  // the variance is known as well as from so many independent pieces
  // Systematic part of the protection level: range bias, unevenness, rival floors, walls that lean.
  ProtectionParts bound_rad;
  // By which other rock beside the machine moves it: standard deviation. None without a region's plane.
  double waves_rad = 0.0;

  double level_rad(const Settings& s) const {
    return protection_factor(s.protection_sigmas, dof) * sigma_rad + bound_rad.sum();
  }
};

struct FloorResult {
  PlaneFit fit;
  AngleErrors roll, pitch;
  // Of the endless plane's fit: covariance and bias of height and slopes in a frame on it.
  TangentFrame frame;
  UnevenFit uneven;
  double area_m2 = 0.0;
  double roi_radius_m = 0.0;
  std::uint32_t open_points = 0;  // open points within the radius

  // The truth may be another floor, whose roll and pitch lie so far off.
  void reach_to_rival(double roll_rad, double pitch_rad) {
    roll.bound_rad[POSE_WALL_PART_RIVAL] += roll_rad;
    pitch.bound_rad[POSE_WALL_PART_RIVAL] += pitch_rad;
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
  return {f.roll.level_rad(s), f.pitch.level_rad(s)};
}

}  // namespace pose_wall
