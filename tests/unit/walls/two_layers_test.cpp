// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a second layer in front of a surface is found where there is one, with the surface behind it; rough rock
// alone has none.

#include "engine/walls/fit/two_layers.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr double kLayersGate_m = 0.25, kSigmaMin_m = 0.005, kGainPerPoint = 0.02;

std::vector<float> residuals(double share, double step, double sigma, double centre, std::uint32_t seed) {
  test::Noise noise(seed);
  std::vector<float> r(4000);
  for (std::size_t i = 0; i < r.size(); ++i) {
    const bool nearer = static_cast<double>(i) < share * 4000.0;
    r[i] = static_cast<float>(centre + (nearer ? step : 0.0) + noise.normal(sigma));
  }
  return r;
}

LayerHistogram histogram_of(const std::vector<float>& r) {
  LayerHistogram h(kLayersGate_m);
  h.add(Span<const float>(r.data(), static_cast<std::uint32_t>(r.size())));
  return h;
}

TwoLayers found_in(const std::vector<float>& r) {
  return find_two_layers(histogram_of(r), {kSigmaMin_m, kGainPerPoint * static_cast<double>(r.size()), 2.5});
}

// 4000 residuals of 2 cm: means to 0.5 mm, shares to 1 %; bins of the histogram below a centimetre.
TEST(TwoLayers, RibsInFrontOfASurfaceAreFound) {
  for (const double share : {0.12, 0.3, 0.5}) {
    for (const double centre : {0.0, -0.04, -0.12}) {  // the plane on the surface, before it, on the nearer layer
      const TwoLayers t = found_in(residuals(share, 0.12, 0.02, centre, 1));
      ASSERT_TRUE(t.found) << share << " " << centre;
      EXPECT_NEAR(t.centre_m, centre, 0.005);
      EXPECT_NEAR(t.step_m, 0.12, 0.01);
      EXPECT_NEAR(t.share, share, 0.05);
      EXPECT_NEAR(t.sigma_m, 0.02, 0.005);
      EXPECT_GT(t.surface_probability(centre), 0.95);
      EXPECT_LT(t.surface_probability(centre + 0.12), 0.05);
    }
  }
}

TEST(TwoLayers, OneRoughSurfaceHasNoSecondLayer) {
  for (const double sigma : {0.005, 0.02, 0.05}) {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
      EXPECT_FALSE(found_in(residuals(0.0, 0.0, sigma, 0.0, seed)).found) << sigma;
    }
  }
}

// Halfway between two layers of the same share it is even; far from both, where neither is likely, nothing is the
// surface's; four at once are as one by one.
TEST(TwoLayers, ProbabilitiesGoFromOneLayerToTheOther) {
  TwoLayers t;
  t.centre_m = 0.01;
  t.sigma_m = 0.02;
  t.step_m = 0.1;
  t.share = 0.5;
  EXPECT_NEAR(t.surface_probability(0.06), 0.5, 1e-3);
  EXPECT_EQ(t.surface_probability(0.01 - 10.0 * 0.02), 0.0);
  double last = 1.0;
  for (double r = -0.1; r < 0.2; r += 0.001) {
    const double here = t.surface_probability(r);
    EXPECT_LE(here, last) << r;
    last = here;
    const auto from = static_cast<float>(r);
    const FourFloats four = t.surface_probability(FourFloats{from + 0.1F, from, from - 0.1F, 0.0F});
    EXPECT_EQ(static_cast<double>(four[1]), here) << r;
  }
}

TEST(TwoLayers, TooFewOrNoResiduals) {
  EXPECT_FALSE(found_in({}).found);
  EXPECT_FALSE(found_in(std::vector<float>(50, 0.0F)).found);
  EXPECT_FALSE(found_in(std::vector<float>(5000, 9.0F)).found);
}

}  // namespace
}  // namespace pose_wall
