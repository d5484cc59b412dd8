// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// How large the voxels of a cloud are: as small as the config says, or larger where it has more of them than there is
// room for. That is known when the room is full, which is most of a pass over the cloud; so the leaf that the last
// cloud of a sensor needed is tried first with the next one.

#pragma once

#include <cstdint>

#include "types.hpp"

namespace pose_wall {

// Leaves by how often they have grown, each time to 1.26 times the size.
class VoxelLeaf {
 public:
  explicit VoxelLeaf(double least_m) : least_m_(least_m) {}

  double leaf_m(std::uint32_t growths) const;
  bool is_largest(std::uint32_t growths) const;

 private:
  double least_m_;
};

// The leaves that are tried for one cloud, one after the other.
class LeafSearch {
 public:
  LeafSearch(double least_m, std::uint32_t room, const LeafMemory& last)
      : leaf_(least_m), room_(room), last_(last), growths_(last.begin_with) {}

  double leaf_m() const { return leaf_.leaf_m(growths_); }
  bool has_grown() const { return growths_ > 0; }
  // After a pass with this leaf: whether another is to be tried. voxels: how many there were, if they all had room.
  bool goes_on(bool fits, std::uint32_t voxels);
  // Once it does not go on.
  LeafMemory memory(bool fits, std::uint32_t voxels) const;

 private:
  VoxelLeaf leaf_;
  std::uint32_t room_;
  LeafMemory last_;
  std::uint32_t growths_;
  bool in_vain_ = false;  // a smaller one was tried
};

}  // namespace pose_wall
