// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: bits are counted, and asked for, and the highest is found.

#include "base/math/bits.hpp"

#include <gtest/gtest.h>

namespace pose_wall {
namespace {

TEST(Bits, AreCounted) {
  EXPECT_EQ(bits_in(0), 0);
  EXPECT_EQ(bits_in(~0ULL), 64);
  for (int k = 0; k < 64; ++k) {
    EXPECT_EQ(bits_in(1ULL << k), 1);
    EXPECT_EQ(bits_in((1ULL << k) - 1), k);
  }
}

TEST(Bits, SoManyOrMore) {
  EXPECT_FALSE(has_bits(0, 1));
  EXPECT_TRUE(has_bits(1ULL << 63, 1));
  for (const std::uint64_t word : {0ULL, 1ULL, 0x8001ULL, 0x70ULL, 0xF0F0ULL, ~0ULL}) {
    for (int least = 1; least <= 64; ++least) EXPECT_EQ(has_bits(word, least), bits_in(word) >= least) << word;
  }
}

TEST(Bits, TheHighest) {
  for (std::uint32_t k = 0; k < 64; ++k) {
    EXPECT_EQ(highest_bit(1ULL << k), k);
    EXPECT_EQ(highest_bit(~0ULL >> k), 63 - k);
  }
}

}  // namespace
}  // namespace pose_wall
