// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the weights are Tukey's, by hand; the flat top is flat up to its width, falls without a step, and is the same
// on both sides. Does not prove what they do to a fit; see irls_test and the efficiency tests.

#include "base/estimation/tukey.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace pose_wall {
namespace {

TEST(Tukey, ByHand) {
  const double cutoff = 4.685 * 0.02;
  EXPECT_DOUBLE_EQ(tukey_weight(0.0, 0.02), 1.0);
  EXPECT_NEAR(tukey_weight(0.5 * cutoff, 0.02), 0.5625, 1e-12);  // (1 - 1/4)^2
  EXPECT_NEAR(tukey_weight(-0.5 * cutoff, 0.02), 0.5625, 1e-12);
  EXPECT_EQ(tukey_weight(1.001 * cutoff, 0.02), 0.0);
  EXPECT_EQ(tukey_weight(-1e9, 0.02), 0.0);
}

TEST(FlatTop, IsFlatWithinAndTukeysBeyond) {
  for (const double sign : {-1.0, 1.0}) {
    for (const double inside : {0.0, 0.01, 0.0299}) EXPECT_EQ(flat_top_weight(sign * inside, 0.03, 0.02), 1.0);
    EXPECT_NEAR(flat_top_weight(sign * (0.03 + 0.5 * 4.685 * 0.02), 0.03, 0.02), 0.5625, 1e-12);
    EXPECT_EQ(flat_top_weight(sign * (0.031 + 4.685 * 0.02), 0.03, 0.02), 0.0);
  }
  EXPECT_EQ(flat_top_weight(0.02, 0.0, 0.02), tukey_weight(0.02, 0.02)) << "without a top";
}

TEST(FlatTop, FallsWithoutAStep) {
  double before = 1.0;
  for (double r = 0.0; r < 0.2; r += 1e-4) {
    const double weight = flat_top_weight(r, 0.03, 0.02);
    EXPECT_LE(weight, before);
    // Tukey's steepest descent is 1.54 per cutoff (at 1 / sqrt 3 of it).
    EXPECT_LE(before - weight, 1.55 * 1e-4 / (4.685 * 0.02)) << r;
    before = weight;
  }
  EXPECT_EQ(before, 0.0);
}

TEST(FlatTop, WhatIsNoNumberHasNoPull) {
  EXPECT_EQ(flat_top_weight(INFINITY, 0.03, 0.02), 0.0);
  EXPECT_EQ(flat_top_weight(-INFINITY, 0.03, 0.02), 0.0);
}

TEST(FourWeights, AreTheWeightsOfEach) {
  constexpr double kScale_m = 0.02, kFlat_m = 0.015;
  const auto per_cutoff = static_cast<float>(1.0 / (kTukeyCutoff * kScale_m));
  for (float r = -0.2F; r < 0.2F; r += 0.004F) {
    const FourFloats four{r, r + 0.001F, -r, 10.0F * r};
    const FourFloats plain = tukey_weights(four, per_cutoff);
    const FourFloats flat = flat_top_weights(four, static_cast<float>(kFlat_m), per_cutoff);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      const auto residual = static_cast<double>(four[lane]);
      EXPECT_NEAR(static_cast<double>(plain[lane]), tukey_weight(residual, kScale_m), 1e-5) << residual;
      EXPECT_NEAR(static_cast<double>(flat[lane]), flat_top_weight(residual, kFlat_m, kScale_m), 1e-5) << residual;
    }
  }
}

}  // namespace
}  // namespace pose_wall
