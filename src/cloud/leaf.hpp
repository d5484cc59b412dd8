// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// How large the voxels of a cloud are: as small as the config says, or larger where it has more of them than there is
// room for. That is known when the room is full, which is most of a pass over the cloud, or all of it where somebody
// wants it so; so the leaf that the last cloud of a sensor needed is tried first with the next one, and a cloud is read
// four times at most. After a leaf in vain come the next one, the middle of what is left, and the largest. What was
// skipped is tried by the next clouds, one growth each. Where clouds become thinner the leaf comes down in the same
// way: at once as far as the voxels would have room even if they filled space, and from there by one growth a cloud.

#pragma once

#include <cstdint>

#include "cloud/result.hpp"

namespace pose_wall {

// The leaves that are tried for one cloud, one after the other, each by how often it has grown to 1.26 times its size.
class LeafSearch {
 public:
  // In vain with the last leaf, the next one, the middle of what is left, and the largest: bounds what a cloud costs.
  static constexpr std::uint32_t kPassesMost = 4;

  // room: for so many voxels.
  LeafSearch(double least_m, std::uint32_t room, const LeafMemory& last);

  double leaf_m() const;
  // No other is tried after it, whether it fits or not.
  bool is_largest() const { return growths_ == largest_; }
  // After a pass with this leaf: whether another is to be tried. voxels: how many there were, if they all had room.
  bool goes_on(bool fits, std::uint32_t voxels);
  // Once it does not go on.
  LeafMemory memory(bool fits, std::uint32_t voxels) const;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;  // more growths than any leaf has

  bool are_as_many_as_last(std::uint32_t voxels) const;
  std::uint32_t next_larger() const;

  double least_m_;
  std::uint32_t room_;
  LeafMemory last_;
  std::uint32_t growths_ = 0, largest_ = 0;
  std::uint32_t passes_ = 0;
  std::uint32_t in_vain_ = kNone;  // the largest of those that were tried in vain
  std::uint32_t has_fit_ = kNone;  // the smallest of those that were not
};

}  // namespace pose_wall
