// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "base/containers/span.hpp"
#include "engine/cloud/voxel_grid.hpp"

namespace pose_wall {

// The columns of a grid's voxels, to find neighbours: the voxels within a distance of one lie in the columns around its
// own, and there between two heights.
class VoxelColumns {
 public:
  // Valid for a grid after extract() until its next begin(). reach_m: at most kReachMost columns.
  VoxelColumns(VoxelGrid* grid, double reach_m);

  // The config allows 2 m (outlier_radius) over columns of 4 x 0.01 m (voxel_leaf): 50.
  static constexpr std::uint32_t kReachMost = 64;

  // visit(begin, end) for runs of the list. Together they hold all voxels within the reach of the i-th, itself among
  // them, and others not much further away. Its own column's run comes first, those furthest along x last. It goes on
  // until visit returns false. i must not be less than in the last call.
  template <typename Visit>
  void for_each_run(std::uint32_t i, const Visit& visit) {
    while (begin_[own_ + 1] <= i) ++own_;
    const std::uint64_t own = column(own_);
    const std::uint32_t x = VoxelKey::x_of_column(own), y = VoxelKey::y_of_column(own);
    const std::uint32_t z = VoxelKey::z_of(grid_.key_in_order(i)), z_from = z > z_reach_ ? z - z_reach_ : 0;
    for (std::uint32_t step = 0; step <= 2 * reach_; ++step) {
      const std::uint32_t away = (step + 1) / 2;
      const bool before = step % 2 != 0;
      if (before && x < away) continue;
      const std::uint32_t x_there = before ? x - away : x + away;
      std::uint32_t& c = cursor_[before ? kReachMost - away : kReachMost + away];
      while (c < count_ && column(c) < VoxelKey::column_at(x_there, y > reach_ ? y - reach_ : 0)) ++c;
      std::uint32_t end = c;
      while (end < count_ && column(end) <= VoxelKey::column_at(x_there, y + reach_)) ++end;
      if (!visit_columns(c, end, z_from, z + z_reach_, visit)) return;
    }
  }

  // How many columns had to be searched for their heights so far.
  std::uint64_t searched() const { return searched_; }

 private:
  std::uint64_t column(std::uint32_t c) const { return VoxelKey::column_of(grid_.key_in_order(begin_[c])); }
  // The first whose key is not less.
  std::uint32_t first_from(std::uint32_t low, std::uint32_t high, std::uint64_t key) const;

  // Small ones that follow each other as one run, whatever their height.
  template <typename Visit>
  bool visit_columns(std::uint32_t from, std::uint32_t to, std::uint32_t z_from, std::uint32_t z_to,
                     const Visit& visit) {
    // Few enough to look at all of them, rather than search for two heights.
    constexpr std::uint32_t kFew = 16;  // swept: half and twice change nothing
    for (std::uint32_t c = from; c < to;) {
      std::uint32_t begin = begin_[c], end = begin_[c + 1];
      const std::uint64_t own = column(c++);
      if (end - begin > kFew) {
        ++searched_;
        begin = first_from(begin, end, VoxelKey::least_of(own, z_from));
        end = first_from(begin, end, VoxelKey::least_of(own, z_to + 1));
      } else {
        for (; c < to && begin_[c + 1] - begin_[c] <= kFew; ++c) end = begin_[c + 1];
      }
      if (!visit(begin, end)) return false;
    }
    return true;
  }

  const VoxelGrid& grid_;
  Span<const std::uint32_t> begin_;  // of each column in the list, and the end of the last
  std::uint32_t count_ = 0;
  std::uint32_t reach_ = 0, z_reach_ = 0;  // columns; cells
  std::uint32_t own_ = 0;
  std::uint64_t searched_ = 0;
  std::uint32_t cursor_[2 * kReachMost + 1] = {};  // by place along x from the own column's: the next looks begin there
};

}  // namespace pose_wall
