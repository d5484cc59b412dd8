// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the small helpers of every fit: tangent coordinates, the corrected plane, Tukey's weight.

#include "base/estimation/tangent_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "base/estimation/tukey.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

Plane random_plane(test::Noise* noise) {
  Plane plane;
  plane.n = Eigen::Vector3d(noise->normal(1), noise->normal(1), noise->normal(1)).normalized();
  plane.d = noise->normal(3);
  return plane;
}

TEST(TangentFrame, IsRightHandedAndInThePlane) {
  test::Noise noise(1);
  for (int i = 0; i < 200; ++i) {
    const Plane plane = random_plane(&noise);
    const TangentFrame f = tangent_frame(plane, Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(0.3, -0.5, 0.9));
    EXPECT_NEAR(plane.signed_distance(f.origin), 0.0, 1e-12);
    EXPECT_NEAR(f.u.norm(), 1.0, 1e-12);
    EXPECT_NEAR(f.v.norm(), 1.0, 1e-12);
    EXPECT_LT((f.u.cross(f.v) - plane.n).norm(), 1e-12);
    EXPECT_GT(f.u.dot(Eigen::Vector3d(0.3, -0.5, 0.9)), 0.0);
  }
}

// The correction is linear in the tangent coordinates and so is the plane's equation: exact, up to the norm.
TEST(TangentFrame, CorrectedTakesTheResidualsAway) {
  test::Noise noise(2);
  for (int i = 0; i < 200; ++i) {
    const Plane plane = random_plane(&noise);
    const TangentFrame f = tangent_frame(plane, Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(0.3, -0.5, 0.9));
    const Eigen::Vector3d c(noise.normal(0.1), noise.normal(0.1), noise.normal(0.1));
    const Plane after = corrected(plane, f, c);
    EXPECT_NEAR(after.n.norm(), 1.0, 1e-12);
    for (int k = 0; k < 10; ++k) {
      const double u = noise.normal(3), v = noise.normal(3);
      const Eigen::Vector3d p = f.origin + u * f.u + v * f.v + (c[0] + c[1] * u + c[2] * v) * plane.n;
      EXPECT_NEAR(after.signed_distance(p), 0.0, 1e-11);
    }
  }
}

TEST(Plane, FlippedIsTheSameSurface) {
  const Plane plane{Eigen::Vector3d(0, 0.6, 0.8), 2.0};
  const Eigen::Vector3d p(3, -1, 5);
  EXPECT_EQ(plane.flipped().signed_distance(p), -plane.signed_distance(p));
}

TEST(Tukey, WeightsFallFromOneToNothing) {
  EXPECT_EQ(tukey_weight(0.0, 0.01), 1.0);
  EXPECT_NEAR(tukey_weight(0.01, 0.01), std::pow(1.0 - 1.0 / (4.685 * 4.685), 2), 1e-12);
  EXPECT_EQ(tukey_weight(0.02, 0.01), tukey_weight(-0.02, 0.01));
  EXPECT_EQ(tukey_weight(0.04686, 0.01), 0.0);
  EXPECT_EQ(tukey_weight(1e9, 0.01), 0.0);
  EXPECT_EQ(tukey_weight(std::nan(""), 0.01), 0.0);
}

}  // namespace
}  // namespace pose_wall
