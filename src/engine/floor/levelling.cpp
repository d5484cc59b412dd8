// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/floor/levelling.hpp"

#include "base/math/rotation.hpp"
#include "base/simd/four_turns.hpp"

namespace pose_wall {

Levelling levelling_by(const Plane& floor_base, const Axes& axes) {
  const RollPitch angles = roll_pitch_of_up(floor_base.n);
  Levelling levelling;
  levelling.R_level_base = level_rotation(floor_base.n);
  levelling.roll_rad = angles.roll_rad;
  levelling.pitch_rad = angles.pitch_rad;
  levelling.forward_up = (levelling.R_level_base * axes.forward_base).z();
  levelling.floor_z_level_m = -floor_base.d;  // R_level turns the normal to +Z
  return levelling;
}

namespace {

// An even part of the points outside the band.
class Beyond {
 public:
  Beyond(std::uint32_t points, PointSet* to) : to_(to), share_(points / (kBalance * kBeyondMax) + 1) { to->count = 0; }

  void add(float x, float y, float z) {
    if (until_next_ > 0) {
      --until_next_;
      return;
    }
    to_->add(x, y, z, static_cast<float>(share_));
    until_next_ = kBalance * share_ - 1;
  }

 private:
  // The band's cells are about 1.6 times as long, of some three times the area: one point of three keeps the balance.
  static constexpr std::uint32_t kBalance = 3;
  PointSet* to_;
  std::uint32_t share_, until_next_ = 0;
};

// Of four points, those in the band go into its cells. There is room: never more cells than points, and both grids have
// the same capacity.
void add_to_band(const VoxelGrid& grid, const FourPlaces& p, FourFloats weights, FourTruths in_band,
                 VoxelGrid::Filling* band) {
  std::uint64_t keys[kFour];
  VoxelGrid::Sums sums[kFour];
  const FourFloats none{}, sixteenths = weights * static_cast<float>(kWeightOne) + 0.5F;
  const FourInts whole = cut_off(in_band ? sixteenths : none);
  grid.split(in_band ? p.x : none, in_band ? p.y : none, in_band ? p.z : none, reinterpret_cast<FourWords>(whole), keys,
             sums);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) {
    if (in_band[lane] != 0) band->add(keys[lane], sums[lane]);
  }
}

// Points in the band go into the grid, an even part of the others into beyond_level.
void part_by_height(const PointSet& cloud_base, const Levelling& levelling, const Settings& settings, VoxelGrid* grid,
                    PointSet* beyond_level) {
  const auto z_min = static_cast<float>(levelling.floor_z_level_m + settings.wall_z_min);
  const auto z_max = static_cast<float>(levelling.floor_z_level_m + settings.wall_z_max);
  grid->begin(settings.wall_voxel_leaf, reach_of(settings));
  VoxelGrid::Filling band(grid);
  Beyond beyond(cloud_base.count, beyond_level);
  const FourTurns to_level(levelling.R_level_base);
  for_each_four_points(cloud_base, [&](std::uint32_t i, FourFloats x, FourFloats y, FourFloats z, FourTruths counts) {
    const FourPlaces p = to_level.turned(x, y, z);
    const FourTruths in_band = counts & (p.z >= z_min) & (p.z <= z_max), outside = counts & ~in_band;
    if (any_of(in_band)) add_to_band(*grid, p, load_four(&cloud_base.weight[i]), in_band, &band);
    if (!any_of(outside)) return;
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      if (outside[lane] != 0) beyond.add(p.x[lane], p.y[lane], p.z[lane]);
    }
  });
}

}  // namespace

void cut_wall_band(const PointSet& cloud_base, const Levelling& levelling, const Settings& settings, VoxelGrid* grid,
                   BoundedPoints* band_level, BoundedPoints* beyond_level) {
  part_by_height(cloud_base, levelling, settings, grid, beyond_level);
  // The cloud's order no longer depends on that of the points.
  grid->extract_as_they_came(band_level);
  band_level->bound();
  beyond_level->bound();
}

}  // namespace pose_wall
