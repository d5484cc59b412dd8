// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: over many surfaces that are flat, rough by patches, or wave over one to two metres, the plane's errors are
// what its standard deviations say; on a flat one they are those of least squares; a range bias turns the plane as
// told.

#include "base/estimation/uneven_plane.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr double kNoise_m = 0.001;

// Patches of half a metre over 5 m by 4 m.
std::vector<SurfacePatch> flat(test::Noise* noise) {
  std::vector<SurfacePatch> patches;
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 8; ++j) {
      patches.push_back({0.5 * i - 2.25, 0.5 * j - 1.75, noise->normal(kNoise_m), 0.0, kNoise_m * kNoise_m});
    }
  }
  return patches;
}

// Smooth and random: hills of one width at random places.
void add_waves(double height_m, double width_m, test::Noise* noise, std::vector<SurfacePatch>* patches) {
  constexpr int kHills = 400;
  constexpr double kReach_m = 10.0;
  const double per_hill = height_m * 2.0 * kReach_m / (width_m * std::sqrt(3.14159 * kHills));
  for (int k = 0; k < kHills; ++k) {
    const double u = noise->uniform(-kReach_m, kReach_m), v = noise->uniform(-kReach_m, kReach_m);
    const double height = noise->normal(per_hill);
    for (SurfacePatch& p : *patches) {
      const double r2 = (p.u - u) * (p.u - u) + (p.v - v) * (p.v - v);
      p.residual += height * std::exp(-r2 / (2.0 * width_m * width_m));
    }
  }
}

UnevenFit fit(const std::vector<SurfacePatch>& patches) {
  test::Placed<UnevenPlane> plane;
  return plane->fit(Span<const SurfacePatch>(patches.data(), static_cast<std::uint32_t>(patches.size())), 5.0);
}

template <typename Rough>
double mean_z2(int runs, const Rough& rough) {
  double sum = 0.0;
  for (int run = 0; run < runs; ++run) {
    test::Noise noise(static_cast<std::uint32_t>(run) + 1);
    std::vector<SurfacePatch> patches = flat(&noise);
    rough(&noise, &patches);
    const UnevenFit f = fit(patches);
    EXPECT_TRUE(f.solved);
    for (int k = 1; k < 3; ++k) sum += f.correction[k] * f.correction[k] / f.covariance(k, k);
  }
  return sum / (2.0 * runs);
}

// 200 runs of two slopes: a standard error of 0.07 about 1. Of rough patches nobody knows that no wave is among them,
// so their levels are cautious; waves near the length of the surface itself are guessed less well.
TEST(UnevenPlane, ErrorsAreWhatTheStandardDeviationsSay) {
  const double z2_flat = mean_z2(200, [](test::Noise*, std::vector<SurfacePatch>*) {});
  EXPECT_GT(z2_flat, 0.7);
  EXPECT_LT(z2_flat, 1.3);
  const double z2_rough = mean_z2(200, [](test::Noise* noise, std::vector<SurfacePatch>* patches) {
    for (SurfacePatch& p : *patches) p.residual += noise->normal(0.02);
  });
  EXPECT_GT(z2_rough, 0.25);
  EXPECT_LT(z2_rough, 1.3);
  for (const double width_m : {0.3, 0.6}) {
    const double z2 = mean_z2(
        100, [&](test::Noise* noise, std::vector<SurfacePatch>* patches) { add_waves(0.04, width_m, noise, patches); });
    EXPECT_GT(z2, 0.4) << width_m;
    EXPECT_LT(z2, 3.0) << width_m;
  }
}

TEST(UnevenPlane, OnAFlatSurfaceItIsLeastSquares) {
  test::Noise noise(5);
  std::vector<SurfacePatch> patches = flat(&noise);
  double suu = 0.0;
  for (SurfacePatch& p : patches) {
    p.residual += 0.01 + 0.02 * p.u - 0.03 * p.v;
    p.bias = 1.0 + 0.1 * p.u;
    suu += p.u * p.u;
  }
  const UnevenFit f = fit(patches);
  ASSERT_TRUE(f.solved);
  EXPECT_NEAR(f.correction[0], 0.01, 0.001);
  EXPECT_NEAR(f.correction[1], 0.02, 0.0005);
  EXPECT_NEAR(f.correction[2], -0.03, 0.0005);
  EXPECT_NEAR(f.bias_response[0], 1.0, 1e-6);
  EXPECT_NEAR(f.bias_response[1], 0.1, 1e-6);
  EXPECT_GT(std::sqrt(f.covariance(1, 1)), 0.7 * kNoise_m / std::sqrt(suu));
  EXPECT_LT(std::sqrt(f.covariance(1, 1)), 2.5 * kNoise_m / std::sqrt(suu));
}

// Patches are worked on four at a time, and the last ones need not be four. Their order decides which neighbours
// predict a patch, which is worth a small part of the error.
TEST(UnevenPlane, AnyCountInAnyOrder) {
  for (std::size_t count = 9; count <= 29; ++count) {
    test::Noise noise(6);
    std::vector<SurfacePatch> patches = flat(&noise);
    test::Noise place(7);
    for (SurfacePatch& p : patches) {
      p.u += place.uniform(-0.2, 0.2);
      p.residual += noise.normal(0.02);
    }
    std::vector<SurfacePatch> some;
    for (std::size_t k = 0; k < count; ++k) some.push_back(patches[7 * k % patches.size()]);
    const UnevenFit forward = fit(some);
    std::reverse(some.begin(), some.end());
    const UnevenFit backward = fit(some);
    ASSERT_TRUE(forward.solved && backward.solved) << count;
    for (int k = 0; k < 3; ++k) {
      const double sigma = std::sqrt(forward.covariance(k, k));
      EXPECT_NEAR(forward.correction[k], backward.correction[k], 0.1 * sigma) << count;
      EXPECT_NEAR(std::sqrt(backward.covariance(k, k)), sigma, 0.1 * sigma) << count;
    }
  }
}

TEST(UnevenPlane, WhatDoesNotHoldAPlaneIsNotSolved) {
  test::Noise noise(1);
  std::vector<SurfacePatch> patches = flat(&noise);
  patches.resize(7);
  EXPECT_FALSE(fit(patches).solved) << "too few";
  EXPECT_FALSE(fit({}).solved);
  patches = flat(&noise);
  for (SurfacePatch& p : patches) p.v = 2.0 * p.u;
  EXPECT_FALSE(fit(patches).solved) << "on a line";
  patches = flat(&noise);
  patches[3].residual = std::nan("");
  EXPECT_FALSE(fit(patches).solved);
}

}  // namespace
}  // namespace pose_wall
