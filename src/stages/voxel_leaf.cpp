// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "stages/voxel_leaf.hpp"

namespace pose_wall {
namespace {

constexpr double kGrowth = 1.26;  // about the cube root of 2
// What stands on a floor is told by what lies above it within 0.75 m, in two layers at least. Voxels too large for that
// show the layers of their own lattice instead, wherever points fill the air, and these look like floors and walls.
constexpr double kMost_m = 0.26;
// So many fewer voxels than when a smaller leaf was tried in vain, and it is tried again.
constexpr double kFewer = 0.95;

}  // namespace

double VoxelLeaf::leaf_m(std::uint32_t growths) const {
  double leaf_m = least_m_;
  for (std::uint32_t k = 0; k < growths && leaf_m < kMost_m; ++k) {
    leaf_m = leaf_m * kGrowth < kMost_m ? leaf_m * kGrowth : kMost_m;
  }
  return leaf_m;
}

bool VoxelLeaf::is_largest(std::uint32_t growths) const {
  return !(leaf_m(growths) < kMost_m);
}

bool LeafSearch::goes_on(bool fits, std::uint32_t voxels) {
  if (!fits) {
    if (leaf_.is_largest(growths_)) return false;
    in_vain_ = true;
    ++growths_;
    return true;
  }
  if (in_vain_) return false;
  // One growth less makes them twice as many where they fill space, and fewer on surfaces: so many less surely fit.
  const std::uint32_t before = growths_;
  for (std::uint64_t most = 2ULL * voxels; growths_ > 0 && most <= room_; most *= 2) --growths_;
  return growths_ < before;
}

LeafMemory LeafSearch::memory(bool fits, std::uint32_t voxels) const {
  constexpr std::uint32_t kAnyFewer = 0xFFFFFFFFU;
  if (!fits || growths_ == 0) return {growths_, kAnyFewer};
  if (in_vain_) return {growths_, voxels};
  if (growths_ < last_.begin_with || voxels < kFewer * last_.voxels) return {growths_ - 1, kAnyFewer};
  return {growths_, last_.voxels};
}

}  // namespace pose_wall
