// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#pragma once

#include <cstdint>

#include "base/containers/span.hpp"

namespace pose_wall {

// With an origin of the voxels' grid that suits it, three passes for a cloud's keys, where 11 bits took five
// (2026-11-22); the counters take 16 KiB.
constexpr std::uint32_t kRadixBits = 12;
constexpr std::uint32_t kRadixSize = 1U << kRadixBits;  // a counter for each digit

// Indices of the keys in ascending order, equal keys in theirs, least digit first. Only bits that differ between keys
// cost passes. A digit begins at the lowest such bit that is not sorted yet, so keys of several short fields take one
// pass a field. order and spare are as long as keys, histogram holds kRadixSize counters. Returns the one with the
// result: order or spare.
inline Span<std::uint32_t> radix_order(Span<const std::uint64_t> keys, Span<std::uint32_t> order,
                                       Span<std::uint32_t> spare, Span<std::uint32_t> histogram) {
  std::uint64_t differing = 0;
  for (const std::uint64_t key : keys) differing |= key ^ keys[0];
  for (std::uint32_t i = 0; i < keys.size(); ++i) order[i] = i;
  for (std::uint32_t shift = 0; differing >> shift != 0; shift += kRadixBits) {
    while (((differing >> shift) & 1U) == 0) ++shift;
    const auto digit = [&](std::uint32_t i) { return static_cast<std::uint32_t>(keys[i] >> shift) & (kRadixSize - 1); };
    histogram.fill(0);
    // Of eight instructions a key and ten three are the loops' own.
#pragma GCC unroll 4
    for (std::uint32_t i = 0; i < keys.size(); ++i) ++histogram[digit(i)];
    std::uint32_t sum = 0;
    for (std::uint32_t& bucket : histogram) {
      const std::uint32_t count = bucket;
      bucket = sum;
      sum += count;
    }
#pragma GCC unroll 4
    for (const std::uint32_t i : order) spare[histogram[digit(i)]++] = i;
    const Span<std::uint32_t> swap = order;
    order = spare;
    spare = swap;
    if (shift + kRadixBits >= 64) break;
  }
  return order;
}

}  // namespace pose_wall
