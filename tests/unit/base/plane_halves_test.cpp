// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: where two parts slope alike with a kerb between them, the reach of the halves makes up for the tilt that the
// kerb gives to the plane through both; on rough but plane ground it is next to nothing; too few patches tell nothing.

#include "base/estimation/plane_halves.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <utility>
#include <vector>

#include "base/estimation/normal_equations.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

const Eigen::Vector3d kSlopeU(0.0, 1.0, 0.0), kSlopeV(0.0, 0.0, 1.0);

// Patches of half a metre over 8 by 4 m.
template <typename Height>
std::vector<SurfacePatch> patches_of(const Height& height_m, double noise_m, test::Noise* noise) {
  std::vector<SurfacePatch> patches;
  for (double u = -3.75; u < 4.0; u += 0.5) {
    for (double v = -1.75; v < 2.0; v += 0.5)
      patches.push_back({u, v, height_m(v) + noise->normal(noise_m), 0.0, 1e-6});
  }
  return patches;
}

Eigen::Vector3d plane_through(const std::vector<SurfacePatch>& patches) {
  NormalEquations sums;
  for (const SurfacePatch& p : patches) sums.add(p.u, p.v, p.residual, 1.0);
  return sums.information().inverse() * sums.right_side();
}

double reach(const std::vector<SurfacePatch>& patches, const Eigen::Vector3d& response) {
  const Span<const SurfacePatch> span(patches.data(), static_cast<std::uint32_t>(patches.size()));
  return reach_of_halves(span, plane_through(patches), response);
}

TEST(PlaneHalves, ReachMakesUpForAKerb) {
  test::Noise noise(1);
  for (const double edge_m : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    const auto kerb = [edge_m](double v) { return v > edge_m ? 0.06 : 0.0; };
    const std::vector<SurfacePatch> patches = patches_of(kerb, 0.003, &noise);
    const double tilt = std::fabs(plane_through(patches)[2]);
    EXPECT_GT(tilt, 0.008) << "what is to be made up for, edge at " << edge_m;
    EXPECT_GT(reach(patches, kSlopeV), 0.7 * tilt) << edge_m;
    EXPECT_LT(reach(patches, kSlopeU), 0.1 * tilt) << "along the kerb, edge at " << edge_m;
  }
}

// Halves lie along the ground's own length, so a machine that stands turned on its road does not mix them. Where ground
// is as wide as long, those on either side of the machine's axes are left.
TEST(PlaneHalves, AKerbIsAKerbWhicheverWayTheMachineStands) {
  test::Noise noise(3);
  for (const auto& [length_m, turned_deg] :
       {std::pair(15.5, -80.0), std::pair(15.5, -45.0), std::pair(15.5, -20.0), std::pair(15.5, 0.0),
        std::pair(15.5, 20.0), std::pair(15.5, 45.0), std::pair(15.5, 80.0), std::pair(3.5, 0.0)}) {
    const double angle_rad = turned_deg / 57.29578, c = std::cos(angle_rad), s = std::sin(angle_rad);
    std::vector<SurfacePatch> patches;
    for (double along = -0.5 * length_m; along < 0.5 * length_m + 0.25; along += 0.5) {
      for (double across = -1.75; across < 2.0; across += 0.5) {
        const double height_m = (across > 0.9 ? 0.06 : 0.0) + noise.normal(0.003);
        patches.push_back({c * along - s * across, s * along + c * across, height_m, 0.0, 1e-6});
      }
    }
    const Eigen::Vector3d plane = plane_through(patches), across(0.0, -s, c);
    const double tilt = std::fabs(plane.dot(across));
    EXPECT_GT(tilt, 0.008) << turned_deg;
    EXPECT_GT(reach(patches, across), 0.7 * tilt) << turned_deg;
  }
}

TEST(PlaneHalves, RoughGroundHardlyReaches) {
  test::Noise noise(2);
  double sum = 0.0;
  constexpr int kDraws = 200;
  for (int run = 0; run < kDraws; ++run) {
    sum += reach(patches_of([](double v) { return 0.1 * v; }, 0.02, &noise), kSlopeV) / kDraws;
  }
  EXPECT_LT(sum, 0.001);
}

TEST(PlaneHalves, TooFewPatchesTellNothing) {
  std::vector<SurfacePatch> patches;
  for (int k = 0; k < 9; ++k)
    patches.push_back({1.0 + 0.5 * k, k % 2 == 0 ? 0.5 : 1.5, k % 3 == 0 ? 0.1 : 0.0, 0.0, 1e-6});
  EXPECT_EQ(reach(patches, kSlopeU), 0.0);
  const Span<const SurfacePatch> none(nullptr, 0);
  EXPECT_EQ(reach_of_halves(none, Eigen::Vector3d::Zero(), kSlopeV), 0.0);
}

}  // namespace
}  // namespace pose_wall
