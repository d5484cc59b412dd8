// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors
//
// How thick dust is around the machine: what tells a thin thing, which returns in frame after frame, from chance.

#pragma once

#include <cstdint>

namespace pose_wall::planar {

constexpr std::uint32_t kPlacesAcross = 160;  // 16 m, in a ring: what falls out at one side comes in at the other

// Where in the ring a row or column of places is.
inline std::uint32_t in_ring(std::int32_t place) {
  constexpr std::uint32_t kOffset = kPlacesAcross * 100000U;  // no machine goes as far: above 0
  return (static_cast<std::uint32_t>(place) + kOffset) % kPlacesAcross;
}

// From the frames before: in blocks of 0.8 m.
class DustRate {
 public:
  void forget() { *this = DustRate(); }
  // A frame begins.
  void next() {
    for (std::uint32_t k = 0; k < kBlocks * kBlocks; ++k) {
      // It rises at once and falls in a second of frames.
      constexpr float kStays = 0.9F;
      const float stays = kStays * rate_[k];
      rate_[k] = stays > count_[k] ? stays : count_[k];
      count_[k] = 0.0F;
    }
  }
  void add(std::int32_t ix, std::int32_t iy) { count_[block_of(ix) + kBlocks * block_of(iy)] += 1.0F; }
  // The chance that a place or one beside it has a return in a frame, by those elsewhere around it. Half of one more
  // than was seen: rare is not never.
  float share_around(std::int32_t ix, std::int32_t iy) const {
    float sum = 0.0F;
    for (std::uint32_t dy = 0; dy < 3; ++dy) {
      for (std::uint32_t dx = 0; dx < 3; ++dx) {
        const std::uint32_t bx = (block_of(ix) + dx + kBlocks - 1) % kBlocks;
        sum += rate_[bx + kBlocks * ((block_of(iy) + dy + kBlocks - 1) % kBlocks)];
      }
    }
    const float others = (sum > 1.0F ? sum - 1.0F : 0.0F) + 0.5F;
    const float share = 9.0F * others / static_cast<float>(9 * kBlockPlaces * kBlockPlaces);
    return share < 1.0F ? share : 1.0F;
  }

 private:
  static constexpr std::uint32_t kBlockPlaces = 8;  // half a cloud of dust, and ten times the smallest thing's area
  static constexpr std::uint32_t kBlocks = kPlacesAcross / kBlockPlaces;  // as places: a ring
  static std::uint32_t block_of(std::int32_t place) { return in_ring(place) / kBlockPlaces; }
  float rate_[kBlocks * kBlocks] = {}, count_[kBlocks * kBlocks] = {};
};

}  // namespace pose_wall::planar
