// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: points become patch means with the variance of a mean, never more patches than there is room for, and points
// outside do no harm.

#include "base/estimation/surface_patches.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

TEST(SurfacePatches, MeansAndTheirVariances) {
  test::Placed<SurfacePatches> patches;
  test::Noise noise(1);
  patches->begin(1.0, 0.5);
  constexpr double kSigma_m = 0.02;
  constexpr int kPoints = 4000;
  for (int i = 0; i < kPoints; ++i) {
    patches->add(
        test::patch_point(noise.uniform(-1, 0.999), noise.uniform(-1, 0.999), 0.1 + noise.normal(kSigma_m), 1.0, -0.5));
  }
  const Span<const SurfacePatch> found = patches->collect();
  ASSERT_EQ(found.size(), 16U);
  for (const SurfacePatch& p : found) {
    EXPECT_NEAR(p.residual, 0.1, 5.0 * kSigma_m / std::sqrt(kPoints / 16.0));
    EXPECT_NEAR(p.noise_variance, kSigma_m * kSigma_m / (kPoints / 16.0), 0.4 * kSigma_m * kSigma_m / (kPoints / 16.0));
    EXPECT_NEAR(p.bias, -0.5, 1e-12);
    EXPECT_LT(std::fabs(p.u), 1.0);
    EXPECT_LT(std::fabs(p.v), 1.0);
  }
}

TEST(SurfacePatches, NeverMoreThanThereIsRoomFor) {
  for (const double reach : {3.0, 8.0, 19.0, 40.0}) {
    test::Placed<SurfacePatches> patches;
    patches->begin(reach, 0.5);
    double points = 0.0;
    for (double u = -reach; u < reach; u += 0.2) {
      for (double v = -reach; v < reach; v += 0.2, ++points) patches->add(test::patch_point(u, v, 0.01, 1.0, 0.0));
    }
    const Span<const SurfacePatch> found = patches->collect();
    EXPECT_LE(found.size(), SurfacePatches::kMost);
    EXPECT_GT(found.size(), SurfacePatches::kMost / 5);
    double information = 0.0;
    for (const SurfacePatch& p : found) information += 1.0 / p.noise_variance;
    EXPECT_NEAR(information, points / 1e-6, 0.02 * points / 1e-6) << "no point is lost; noise has a floor of 1 mm";
  }
}

TEST(SurfacePatches, WhatLiesOutsideIsLeftOut) {
  test::Placed<SurfacePatches> patches;
  patches->begin(2.0, 0.5);
  for (const double far : {-2.01, 2.6, 1e9, std::nan(""), HUGE_VAL}) {
    patches->add(test::patch_point(far, 0.0, 0.0, 1.0, 0.0));
    patches->add(test::patch_point(0.0, far, 0.0, 1.0, 0.0));
  }
  EXPECT_EQ(patches->collect().size(), 0U);
  patches->add(test::patch_point(0.0, 0.0, 0.0, 0.0, 0.0));
  EXPECT_EQ(patches->collect().size(), 0U) << "without weight";
}

TEST(SurfacePatches, NothingIsLeftOfAWiderGridBefore) {
  test::Placed<SurfacePatches> patches;
  patches->begin(19.0, 0.5);
  for (double u = -18.9; u < 19.0; u += 0.5) {
    for (double v = -18.9; v < 19.0; v += 0.5) patches->add(test::patch_point(u, v, 0.01, 1.0, 0.0));
  }
  for (const double reach_m : {3.0, 19.0}) {
    patches->begin(reach_m, 0.5);
    EXPECT_EQ(patches->collect().size(), 0U) << reach_m;
  }
}

}  // namespace
}  // namespace pose_wall
