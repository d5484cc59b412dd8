// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/level.hpp"

#include "math/rotation.hpp"

namespace pose_wall {

LevelResult level_by(const Plane& floor_base, const Axes& axes) {
  const RollPitch angles = roll_pitch_of_up(floor_base.n);
  LevelResult level;
  level.R_level_base = level_rotation(floor_base.n);
  level.roll_rad = angles.roll_rad;
  level.pitch_rad = angles.pitch_rad;
  level.forward_up = (level.R_level_base * axes.forward_base).z();
  level.floor_z_level_m = -floor_base.d;  // R_level takes the normal to +Z
  return level;
}

void cut_wall_band(const PointSet& cloud_base, const LevelResult& level, const Settings& settings, VoxelGrid* grid,
                   PointSet* band_level, PointSet* beyond_level) {
  const double z_min = level.floor_z_level_m + settings.wall_z_min;
  const double z_max = level.floor_z_level_m + settings.wall_z_max;
  // The band is averaged over cells of twice the size, some three times the area: one of three keeps the balance.
  constexpr std::uint32_t kBalance = 3;
  const std::uint32_t share = cloud_base.count / (kBalance * kBeyondMax) + 1, every = kBalance * share;
  std::uint32_t outside = 0;
  beyond_level->count = 0;
  grid->begin(settings.wall_voxel_leaf, reach_of(settings));
  for (std::uint32_t i = 0; i < cloud_base.count; ++i) {
    const Eigen::Vector3d p = level.R_level_base * cloud_base.at(i);
    if (!(p.z() >= z_min && p.z() <= z_max)) {
      if (outside++ % every == 0) beyond_level->set(beyond_level->count++, p, static_cast<float>(share));
      continue;
    }
    // There is room: never more cells than points, and both grids have the same capacity.
    grid->add(static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()),
              static_cast<std::uint32_t>(cloud_base.weight[i] * kWeightOne + 0.5F));
  }
  grid->extract(band_level);
}

}  // namespace pose_wall
