// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: four points turned and shifted at once are where each goes by itself, to what floats tell.

#include "base/simd/four_turns.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

TEST(FourTurns, FourAreWhereEachGoes) {
  test::Noise noise(5);
  for (int time = 0; time < 50; ++time) {
    const Eigen::Vector3d axis(noise.uniform(-1, 1), noise.uniform(-1, 1), noise.uniform(0.1, 1));
    const Eigen::Matrix3d R = Eigen::AngleAxisd(noise.uniform(-3, 3), axis.normalized()).toRotationMatrix();
    const Eigen::Vector3d shift_m(noise.uniform(-2, 2), noise.uniform(-2, 2), noise.uniform(-2, 2));
    FourFloats x{}, y{}, z{};
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      x[lane] = static_cast<float>(noise.uniform(-30, 30));
      y[lane] = static_cast<float>(noise.uniform(-30, 30));
      z[lane] = static_cast<float>(noise.uniform(-30, 30));
    }
    const FourPlaces turned = FourTurns(R)(x, y, z), shifted = FourTurns(R, shift_m)(x, y, z);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      const auto at = [lane](const FourPlaces& p) {
        return Eigen::Vector3f(p.x[lane], p.y[lane], p.z[lane]).cast<double>().eval();
      };
      const Eigen::Vector3d expected = R * at({x, y, z});
      EXPECT_LT((at(turned) - expected).norm(), 2e-5);
      EXPECT_LT((at(shifted) - expected - shift_m).norm(), 2e-5);
    }
  }
}

}  // namespace
}  // namespace pose_wall
