// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/cloud/voxel_columns.hpp"

#include <cmath>

namespace pose_wall {

VoxelColumns::VoxelColumns(VoxelGrid* grid, double reach_m)
    : grid_(*grid), begin_(grid->find_columns()), count_(begin_.size() - 1) {
  const auto ceiled = [reach_m](double edge_m) { return static_cast<std::uint32_t>(std::ceil(reach_m / edge_m)); };
  const std::uint32_t reach = ceiled(grid->leaf_m() * VoxelKey::kColumnCells);
  reach_ = reach < kReachMost ? reach : kReachMost;
  z_reach_ = ceiled(grid->leaf_m());
}

std::uint32_t VoxelColumns::first_from(std::uint32_t low, std::uint32_t high, std::uint64_t key) const {
  while (low < high) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (grid_.key_in_order(middle) < key) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

}  // namespace pose_wall
