// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: our elementary functions agree with the C library's over the ranges that the header promises.
// Does not prove: that they are the same bits on another machine; the arm64 preset runs this file there.

#include "base/math/elementary.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace pose_wall {
namespace {

// Error budget: the header says about 1e-15. Series of ten to twenty terms lose a few units in the last place
// (2.2e-16), and the argument reduction by two parts of pi/2 about one more per turn.
constexpr double kRelative = 2e-15;

TEST(Elementary, SineAndCosineFollowTheCLibraryOverManyTurns) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-50.0, 50.0);
  for (int i = 0; i < 200000; ++i) {
    const double x = angle(random);
    ASSERT_NEAR(sine(x), std::sin(x), 1e-14) << x;
    ASSERT_NEAR(cosine(x), std::cos(x), 1e-14) << x;
    ASSERT_NEAR(sine(x) * sine(x) + cosine(x) * cosine(x), 1.0, 4e-15) << x;
  }
}

TEST(Elementary, SineKeepsItsRelativeAccuracyDownToTheSmallestAngles) {
  for (double x = 0.78; x > 1e-300; x *= 0.37) {
    ASSERT_NEAR(sine(x) / std::sin(x), 1.0, kRelative) << x;
    ASSERT_EQ(sine(-x), -sine(x));
    ASSERT_EQ(cosine(-x), cosine(x));
  }
  EXPECT_EQ(sine(0.0), 0.0);
  EXPECT_EQ(cosine(0.0), 1.0);
}

TEST(Elementary, ArcTangentFollowsTheCLibraryInAllQuadrantsAndScales) {
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> exponent(-140.0, 140.0);
  for (int i = 0; i < 200000; ++i) {
    const double y = std::pow(10.0, exponent(random)) * (i % 2 == 0 ? 1.0 : -1.0);
    // Near each other in size half of the time: elsewhere the answer is a multiple of pi/2.
    const double ratio = i % 4 < 2 ? exponent(random) * 0.01 : exponent(random);
    const double x = std::fabs(y) * std::pow(10.0, std::min(140.0, ratio)) * (i % 8 < 4 ? 1.0 : -1.0);
    const double expected = std::atan2(y, x);
    ASSERT_NEAR(arc_tangent2(y, x), expected, kRelative * std::fabs(expected) + 1e-300) << y << " " << x;
  }
}

TEST(Elementary, ArcTangentOnTheAxes) {
  EXPECT_EQ(arc_tangent2(0.0, 0.0), 0.0);
  EXPECT_EQ(arc_tangent2(0.0, 3.0), 0.0);
  EXPECT_DOUBLE_EQ(arc_tangent2(0.0, -3.0), kPi);
  EXPECT_DOUBLE_EQ(arc_tangent2(2.0, 0.0), kPi / 2);
  EXPECT_DOUBLE_EQ(arc_tangent2(-2.0, 0.0), -kPi / 2);
  EXPECT_DOUBLE_EQ(arc_tangent2(1.0, 1.0), kPi / 4);
  EXPECT_DOUBLE_EQ(arc_tangent2(-1.0, -1.0), -3 * kPi / 4);
}

TEST(Elementary, LogarithmFollowsTheCLibrary) {
  for (double x = 1e-307; x < 1e307; x *= 1.37) {
    ASSERT_NEAR(natural_log(x), std::log(x), kRelative * std::fabs(std::log(x)) + 1e-16) << x;
  }
  // Where the logarithm is small, only an absolute bound can hold.
  for (double x = 0.99; x < 1.01; x += 1e-5) ASSERT_NEAR(natural_log(x), std::log(x), 1e-16) << x;
  EXPECT_EQ(natural_log(1.0), 0.0);
}

TEST(Elementary, ExponentialFollowsTheCLibrary) {
  for (double x = -700.0; x <= 700.0; x += 0.173) {
    // The reduced argument carries x's own rounding, so the relative error may grow with |x|.
    ASSERT_NEAR(exponential(x) / std::exp(x), 1.0, kRelative + 2e-16 * std::fabs(x)) << x;
  }
  EXPECT_EQ(exponential(0.0), 1.0);
}

TEST(Elementary, DegreesToRadians) {
  EXPECT_DOUBLE_EQ(radians(180.0), kPi);
  EXPECT_DOUBLE_EQ(radians(-90.0), -kPi / 2);
}

}  // namespace
}  // namespace pose_wall
