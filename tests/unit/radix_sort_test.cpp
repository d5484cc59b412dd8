// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the sort agrees with the standard library's, is stable and leaves no key out.

#include "containers/radix_sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace pose_wall {
namespace {

std::vector<KeyedIndex> sorted(std::vector<KeyedIndex> items) {
  std::vector<KeyedIndex> spare(items.size());
  std::vector<std::uint32_t> histogram(kRadixSize, 99);
  const auto n = static_cast<std::uint32_t>(items.size());
  const Span<KeyedIndex> out = radix_sort(Span<KeyedIndex>(items.data(), n), Span<KeyedIndex>(spare.data(), n),
                                          Span<std::uint32_t>(histogram.data(), kRadixSize));
  return {out.begin(), out.end()};
}

void check(std::vector<std::uint64_t> keys) {
  std::vector<KeyedIndex> items;
  for (std::uint32_t i = 0; i < keys.size(); ++i) items.push_back({keys[i], i, 0});
  const std::vector<KeyedIndex> got = sorted(items);
  std::stable_sort(items.begin(), items.end(), [](const auto& a, const auto& b) { return a.key < b.key; });
  ASSERT_EQ(got.size(), items.size());
  for (std::size_t i = 0; i < got.size(); ++i) {
    ASSERT_EQ(got[i].key, items[i].key);
    ASSERT_EQ(got[i].index, items[i].index) << "equal keys changed places";
  }
}

TEST(RadixSort, AgreesWithTheStandardLibrary) {
  std::mt19937_64 random(1);
  for (const std::uint64_t mask : {~0ULL, 0xFFULL, 0xFF00000000000000ULL, 0x7FFFFFFFFFFFFFFFULL, 0x7FF800ULL}) {
    std::vector<std::uint64_t> keys(5000);
    for (std::uint64_t& key : keys) key = random() & mask;
    check(keys);
  }
}

TEST(RadixSort, EdgeCases) {
  check({});
  check({5});
  check({7, 7, 7, 7});
  check({3, 2, 1});
  check({~0ULL, 0});
  check({1ULL << 63, (1ULL << 63) - 1});
}

}  // namespace
}  // namespace pose_wall
