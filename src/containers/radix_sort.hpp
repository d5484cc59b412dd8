// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "containers/span.hpp"

namespace pose_wall {

struct KeyedIndex {
  std::uint64_t key;
  std::uint32_t index;
  std::uint32_t unused;
};

constexpr std::uint32_t kRadixBits = 11;
constexpr std::uint32_t kRadixSize = 1U << kRadixBits;
constexpr std::uint32_t kRadixPasses = 6;  // 66 bits cover the key

// Sorts by key, least digit first. A digit that is the same in all keys costs no pass, so keys of a small scene
// sort in three or four. spare is as long as items; histogram holds kRadixSize counters. Returns the span that holds
// the result: items or spare.
inline Span<KeyedIndex> radix_sort(Span<KeyedIndex> items, Span<KeyedIndex> spare, Span<std::uint32_t> histogram) {
  for (std::uint32_t pass = 0; pass < kRadixPasses; ++pass) {
    const std::uint32_t shift = pass * kRadixBits;
    histogram.fill(0);
    for (const KeyedIndex& item : items) ++histogram[(item.key >> shift) & (kRadixSize - 1)];
    if (items.size() == 0 || histogram[(items[0].key >> shift) & (kRadixSize - 1)] == items.size()) continue;
    std::uint32_t sum = 0;
    for (std::uint32_t& bucket : histogram) {
      const std::uint32_t count = bucket;
      bucket = sum;
      sum += count;
    }
    for (const KeyedIndex& item : items) spare[histogram[(item.key >> shift) & (kRadixSize - 1)]++] = item;
    const Span<KeyedIndex> swap = items;
    items = spare;
    spare = swap;
  }
  return items;
}

}  // namespace pose_wall
