// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "base/math/golden_ratio.hpp"

#include "base/containers/span.hpp"

namespace pose_wall {

// Takes an even share of items offered one by one. Every n-th item would be from one of two alternating layers, for any
// even n. The multiples of the golden ratio fill the circle about evenly, and so do those of every n-th, for short n.
class EvenShare {
 public:
  // Takes `most` of `all`, on average over many items.
  EvenShare(std::uint32_t most, std::uint32_t all) : limit_(kWhole) {
    if (all > most) limit_ = (kWhole * most + all - 1) / all;
  }

  bool takes() {
    turn_ += kGoldenTurn32;
    return turn_ < limit_;
  }

 private:
  static constexpr std::uint64_t kWhole = 1ULL << 32;  // a turn is a word of 32 bits
  std::uint64_t limit_;
  std::uint32_t turn_ = 0;
};

// visit(k) for an even share of the numbers below `all`, at most `most` of them.
template <typename Visit>
void for_even_share(std::uint32_t all, std::uint32_t most, const Visit& visit) {
  EvenShare share(most, all);
  std::uint32_t visited = 0;
  for (std::uint32_t k = 0; k < all && visited < most; ++k) {
    if (!share.takes()) continue;
    visit(k);
    ++visited;
  }
}

// Keeps an even share of the items in place, at most `most` of them.
template <typename T>
Span<T> thinned(Span<T> items, std::uint32_t most) {
  if (items.size() <= most) return items;
  std::uint32_t count = 0;
  for_even_share(items.size(), most, [&](std::uint32_t k) { items[count++] = items[k]; });
  return items.first(count);
}

}  // namespace pose_wall
