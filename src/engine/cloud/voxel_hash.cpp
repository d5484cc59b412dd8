// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "engine/cloud/voxel_hash.hpp"

#include "base/math/bits.hpp"

namespace pose_wall {
namespace {

// The link on a side of a branching: a key's index, or another branching's index and its bit. The index takes 20 bits
// (kCapacityMost) and the number of a bit of 64 six. The highest bit separates the two:
constexpr std::uint32_t kBranching = 1U << 31;
constexpr std::uint32_t kBitShift = 20, kBitMask = 63;

std::uint32_t index_of(std::uint32_t link) {
  return link & (VoxelHash::kCapacityMost - 1);
}

bool is_branching(std::uint32_t link) {
  return (link & kBranching) != 0;
}

std::uint32_t bit_of(std::uint32_t link) {
  return link >> kBitShift & kBitMask;
}

std::uint32_t side_of(std::uint64_t key, std::uint32_t bit) {
  return static_cast<std::uint32_t>(key >> bit) & 1U;
}

}  // namespace

// A crit-bit tree (after Morrison's PATRICIA, 1968): from the root on each branching tests a lower bit.
std::uint32_t VoxelHash::find_or_branch(std::uint64_t key, std::uint32_t count) {
  if (root_ == kFree) {
    if (count == capacity_) return kFull;
    return root_ = count;
  }
  links_ += kProbesMost;
  std::uint32_t link = root_;
  for (; is_branching(link); ++links_) link = sides_[side_of(key, bit_of(link))][index_of(link)];
  const std::uint64_t differing = keys_[link] ^ key;
  if (differing == 0) return link;
  if (count == capacity_) return kFull;
  const std::uint32_t bit = highest_bit(differing);
  std::uint32_t* place = &root_;
  for (; is_branching(*place) && bit_of(*place) > bit; ++links_) {
    place = &sides_[side_of(key, bit_of(*place))][index_of(*place)];
  }
  const std::uint32_t own = side_of(key, bit);
  sides_[own][count] = count;
  sides_[1 - own][count] = *place;
  *place = kBranching | bit << kBitShift | count;
  return count;
}

}  // namespace pose_wall
