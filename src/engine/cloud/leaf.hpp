// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// The size of a cloud's voxels: that of the config, or larger if there is no room for so many. The lack of room shows
// when the room is full, after most of a pass over the cloud, or after all of it if the caller goes on to the end. So
// the leaf that the last cloud needed is tried first, and a cloud is read four times at most. After a vain leaf come
// the next one, the middle of the rest, and the largest. The next clouds try the skipped ones, one growth each. As
// clouds become thinner the leaf comes down the same way: at once as far as there would be room even if the voxels
// filled space, and then by one growth a cloud.

#pragma once

#include <cstdint>

#include "engine/cloud/result.hpp"

namespace pose_wall {

// The leaves tried for one cloud, one after the other, as numbers of growths by 1.26.
class LeafSearch {
 public:
  // The last leaf in vain, the next one, the middle of the rest, and the largest: bounds the cost of a cloud.
  static constexpr std::uint32_t kPassesMost = 4;

  // room: number of voxels that fit.
  LeafSearch(double least_m, std::uint32_t room, const LeafMemory& last);

  double leaf_m() const;
  // No other is tried after the largest, whether it fits or not.
  bool is_largest() const { return growths_ == largest_; }
  // Call after a pass with this leaf. Returns true if another is to be tried. voxels: their number, if they all had
  // room.
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
