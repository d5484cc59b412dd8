// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/cloud/leaf.hpp"

namespace pose_wall {
namespace {

constexpr double kGrowth = 1.26;  // about the cube root of 2: cells that fill space become half as many
// A point is closed by points within 0.75 m above it, in two layers at least. Voxels too large for that show the layers
// of their own lattice instead, wherever points fill the air, and these look like floors and walls. With half a metre,
// 131,000 points spread evenly over 40 x 40 x 5 m gave roll and pitch, degraded, at 0.1 degrees.
constexpr double kMost_m = 0.26;
// With so many fewer voxels than at the last vain try, a smaller leaf is tried again; a try costs one more pass over
// the cloud, waiting keeps the leaf one growth too large.
constexpr double kFewer = 0.95;  // swept: half and twice change nothing

// The leaf after so many growths, capped at the largest.
double grown(double least_m, std::uint32_t growths) {
  double leaf_m = least_m;
  for (std::uint32_t k = 0; k < growths && leaf_m < kMost_m; ++k) {
    leaf_m = leaf_m * kGrowth < kMost_m ? leaf_m * kGrowth : kMost_m;
  }
  return leaf_m;
}

}  // namespace

LeafSearch::LeafSearch(double least_m, std::uint32_t room, const LeafMemory& last)
    : least_m_(least_m), room_(room), last_(last) {
  while (grown(least_m, largest_) < kMost_m) ++largest_;
  // A memory may come from anywhere, so the number of growths is capped.
  growths_ = last.begin_with < largest_ ? last.begin_with : largest_;
  last_.begin_with = growths_;
}

double LeafSearch::leaf_m() const {
  return grown(least_m_, growths_);
}

bool LeafSearch::are_as_many_as_last(std::uint32_t voxels) const {
  return growths_ == last_.begin_with && static_cast<double>(voxels) >= kFewer * static_cast<double>(last_.voxels);
}

std::uint32_t LeafSearch::next_larger() const {
  if (has_fit_ != kNone) return has_fit_;
  if (passes_ == 1) return growths_ + 1;
  return passes_ == 2 ? (growths_ + 1 + largest_) / 2 : largest_;
}

bool LeafSearch::goes_on(bool fits, std::uint32_t voxels) {
  ++passes_;
  if (!fits) {
    if (is_largest()) return false;
    in_vain_ = growths_;
    growths_ = next_larger();
    return true;
  }
  has_fit_ = growths_;
  // A smaller one may be tried in vain, and then this one needs another pass.
  if (in_vain_ != kNone || passes_ + 2 > kPassesMost || are_as_many_as_last(voxels)) return false;
  // One growth less makes about twice as many voxels where points fill space, and fewer on surfaces.
  for (std::uint64_t most = 2ULL * voxels; growths_ > 0 && most <= room_; most *= 2) --growths_;
  return growths_ < has_fit_;
}

LeafMemory LeafSearch::memory(bool fits, std::uint32_t voxels) const {
  if (!fits || growths_ == 0) return {growths_, LeafMemory::kAnyFewer};
  if (growths_ == in_vain_ + 1) return {growths_, voxels};
  if (in_vain_ != kNone || !are_as_many_as_last(voxels)) return {growths_ - 1, LeafMemory::kAnyFewer};
  return {growths_, last_.voxels};
}

}  // namespace pose_wall
