// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: bits are counted.

#include "math/bits.hpp"

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

}  // namespace
}  // namespace pose_wall
