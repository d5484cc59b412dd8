// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: finiteness is judged by the bits, and our NaN is one.

#include "base/math/finite.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace pose_wall {
namespace {

TEST(Finite, TellsNumbersFromWhatIsNone) {
  using Limits = std::numeric_limits<double>;
  for (const double x : {0.0, -0.0, 1.0, -1e300, Limits::max(), Limits::lowest(), Limits::denorm_min()}) {
    EXPECT_TRUE(is_finite(x)) << x;
  }
  for (const double x : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(), Limits::signaling_NaN()}) {
    EXPECT_FALSE(is_finite(x)) << x;
  }
}

TEST(Finite, NotANumberIsNone) {
  EXPECT_TRUE(std::isnan(not_a_number()));
  EXPECT_FALSE(is_finite(not_a_number()));
}

}  // namespace
}  // namespace pose_wall
