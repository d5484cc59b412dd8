// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// A chosen wall, refined, and what it says of yaw and distances.

#pragma once

#include "config.hpp"
#include "estimation/patch_fit.hpp"
#include "stages/walls_evidence.hpp"
#include "stages/walls_search.hpp"
#include "types.hpp"

namespace pose_wall {

// Where the walls are looked at from: the levelled machine.
struct WallScene {
  const PointSet& band_level;
  const Settings& settings;
  Eigen::Vector3d forward_level;  // horizontal, unit
  Eigen::Vector3d left_level;     // Z x forward
  Eigen::Vector3d sensor_level_m;
  Eigen::Vector3d sample_level_m[2][2];  // [left, right][s_front, s_back]
  double z_min_level_m;                  // the wall band
  double z_max_level_m;
};

struct WallFitScratch {
  Span<std::uint32_t> chosen;
  Span<float> residuals;
  PatchGrid patches;

  void lay_out(Arena& arena, std::uint32_t points_max);
};

// Horizontal direction of a wall, towards the machine's front.
Eigen::Vector3d along_of(const Plane& wall, const Eigen::Vector3d& forward_level);

// Signed angle about +Z from the machine's forward direction to a horizontal unit direction.
double yaw_of(const Eigen::Vector3d& along_level, const Eigen::Vector3d& forward_level);

// Tilt from the vertical, positive where the top leans away from the machine.
double lean_of(const Plane& wall);

// Distance of the plane at a sampling point (d = |n . P + d|).
double distance_at(const Plane& wall, const Eigen::Vector3d& sample_level_m);

// A few rounds of Tukey from a drawn hypothesis, its lean set free. False where nothing holds it.
bool refine_hypothesis(const WallScene& scene, const SideView& view, WallFitScratch* scratch, Plane* plane);

// The full fit. grid: marked with the plane already. side: 0 left, 1 right.
WallResult fit_wall(const WallScene& scene, const Plane& start, int side, const WallGrid& grid,
                    WallFitScratch* scratch);

}  // namespace pose_wall
