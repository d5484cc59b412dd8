// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/labels.hpp"

#include "estimation/near_plane.hpp"
#include "math/four_floats.hpp"
#include "pose_wall.h"

namespace pose_wall {

void label_points(const PointSet& cloud_base, const FloorResult& floor, const LevelResult& level,
                  const WallResult (&walls)[2], const Settings& settings, Span<std::uint8_t> labels) {
  const auto slab = [&](const PlaneFit& wall) {
    if (wall.refused || floor.fit.refused) return Slab::empty();
    return Slab(Plane{level.R_level_base.transpose() * wall.plane.n, wall.plane.d}, settings.wall_ransac_thresh);
  };
  const Slab left = slab(walls[0].fit), right = slab(walls[1].fit);
  const FourDistances heights(floor.fit.plane);
  const auto floor_reach_m = floor.fit.refused ? -1.0F : static_cast<float>(settings.ground_ransac_thresh);
  const auto z_min = static_cast<float>(settings.wall_z_min), z_max = static_cast<float>(settings.wall_z_max);
  for_each_four_points(cloud_base, [&](std::uint32_t i, FourFloats x, FourFloats y, FourFloats z, FourTruths) {
    const FourFloats height = heights.of(x, y, z);
    const FourTruths in_band = (height >= z_min) & (height <= z_max);
    FourInts four =
        in_band & left.holds(x, y, z) ? all_four_ints(POSE_WALL_LABEL_LEFT) : all_four_ints(POSE_WALL_LABEL_OTHER);
    four = in_band & right.holds(x, y, z) ? all_four_ints(POSE_WALL_LABEL_RIGHT) : four;
    four = magnitude_of(height) <= floor_reach_m ? all_four_ints(POSE_WALL_LABEL_FLOOR) : four;
    for (std::uint32_t lane = 0; lane < kFour; ++lane) labels[i + lane] = static_cast<std::uint8_t>(four[lane]);
  });
}

}  // namespace pose_wall
