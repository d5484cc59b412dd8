// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the sort agrees with the standard library's, is stable and leaves no key out.

#include "base/containers/radix_sort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace pose_wall {
namespace {

void check(const std::vector<std::uint64_t>& keys) {
  const auto n = static_cast<std::uint32_t>(keys.size());
  std::vector<std::uint32_t> order(n, 99), spare(n, 99), histogram(kRadixSize, 99), expected(n);
  const Span<std::uint32_t> got =
      radix_order(Span<const std::uint64_t>(keys.data(), n), Span<std::uint32_t>(order.data(), n),
                  Span<std::uint32_t>(spare.data(), n), Span<std::uint32_t>(histogram.data(), kRadixSize));
  std::iota(expected.begin(), expected.end(), 0U);
  std::stable_sort(expected.begin(), expected.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
  ASSERT_EQ(std::vector<std::uint32_t>(got.begin(), got.end()), expected);
}

TEST(RadixSort, AgreesWithTheStandardLibrary) {
  std::mt19937_64 random(1);
  for (const std::uint64_t mask :
       {~0ULL, 0xFFULL, 0xFF00000000000000ULL, 0x7FFFFFFFFFFFFFFFULL, 0x7FF800ULL, 0xFFC00000FFC003ULL}) {
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
