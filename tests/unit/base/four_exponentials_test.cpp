// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: four exponentials at once are within the bound of the C library's, over their whole range.

#include "base/simd/four_exponentials.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pose_wall {
namespace {

TEST(FourExponentials, AreWithinTheirBound) {
  constexpr double kOfItself = 3e-7;
  for (double x = -80.0; x < 0.0; x += 0.00137) {
    const FourFloats at = FourFloats{0.0F, 0.0003F, 0.0006F, 0.0009F} + static_cast<float>(x);
    const FourFloats own = four_exponentials(at < FourFloats{} ? at : FourFloats{});
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      const double expected = std::exp(static_cast<double>(at[lane] < 0.0F ? at[lane] : 0.0F));
      ASSERT_NEAR(static_cast<double>(own[lane]), expected, kOfItself * expected) << at[lane];
    }
  }
}

TEST(FourExponentials, OfZeroIsOne) {
  for (const float zero : {0.0F, -0.0F}) EXPECT_EQ(four_exponentials(all_four(zero))[0], 1.0F);
}

}  // namespace
}  // namespace pose_wall
