// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Voxels one by one, where the engine takes them by fours.

#pragma once

#include <array>

#include "engine/cloud/voxel_grid.hpp"
#include "engine/cloud/voxel_key.hpp"

namespace pose_wall::test {

inline bool add_point(VoxelGrid* grid, double x_m, double y_m, double z_m, std::uint32_t weight = kWeightOne) {
  const auto four = [](double value) { return all_four(static_cast<float>(value)); };
  std::uint64_t keys[kFour];
  VoxelGrid::Sums sums[kFour];
  grid->split(four(x_m), four(y_m), four(z_m), FourWords{weight, weight, weight, weight}, keys, sums);
  return VoxelGrid::Filling(grid).add(keys[0], sums[0]);
}

inline std::uint64_t key_of(std::int32_t x, std::int32_t y, std::int32_t z) {
  std::uint64_t keys[kFour];
  VoxelKey::of_four({all_four_ints(x), all_four_ints(y), all_four_ints(z)}, keys);
  return keys[0];
}

inline std::array<std::int32_t, 3> cell_of(std::uint64_t key) {
  const std::uint64_t keys[kFour] = {key, key, key, key};
  const VoxelKey::FourCells cells = VoxelKey::cells_of(keys);
  return {cells.x[0], cells.y[0], cells.z[0]};
}

}  // namespace pose_wall::test
