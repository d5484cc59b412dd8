// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the scene that the walls are looked for in is the specification's: directions horizontal, sampling points in
// the levelled frame, the band above the floor; and a plane is read with the stated signs.

#include "engine/walls/scene.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "base/math/rotation.hpp"
#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

TEST(WallScene, FollowsTheSpecificationForAllAxesAndTilts) {
  const Eigen::Vector3d axes[] = {Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(),
                                  -Eigen::Vector3d::UnitY()};
  const Settings settings = test::settings_with({{"lateral_offset_left", "0.6"}, {"lateral_offset_right", "-0.5"}});
  test::OwnedPoints none(1);
  test::Placed<ReturnsByDirection> no_returns;
  const Extrinsic extrinsic{Eigen::Matrix3d::Identity(), Eigen::Vector3d(0.1, 0.2, 0.3)};
  for (const Eigen::Vector3d& forward : axes) {
    const Eigen::Vector3d left = Eigen::Vector3d::UnitZ().cross(forward);
    Levelling level;
    level.R_level_base = level_rotation(Eigen::Vector3d(0.1, -0.2, 1.0).normalized());
    level.floor_z_level_m = -1.3;
    const Axes machine{forward, left};
    const WallScene s = wall_scene({none.set(), none.set(), none.set(), *no_returns, IngestCounts{}}, settings, level,
                                   machine, extrinsic);
    EXPECT_LT((s.sensor_level_m - level.R_level_base * extrinsic.sensor_base_m).norm(), 1e-12);
    EXPECT_EQ(s.forward_level.z(), 0.0);
    EXPECT_NEAR(s.forward_level.norm(), 1.0, 1e-12);
    EXPECT_GT(s.forward_level.dot(level.R_level_base * forward), 0.9);
    EXPECT_LT((s.left_level - Eigen::Vector3d::UnitZ().cross(s.forward_level)).norm(), 1e-12);
    const Eigen::Vector3d left_front = level.R_level_base * (2.0 * forward + 0.6 * left);
    const Eigen::Vector3d right_back = level.R_level_base * (-2.0 * forward - 0.5 * left);
    EXPECT_LT((s.sample_level_m[0][0] - left_front).norm(), 1e-12);
    EXPECT_LT((s.sample_level_m[1][1] - right_back).norm(), 1e-12);
    EXPECT_NEAR(s.z_min_level_m, -1.3 + 0.25, 1e-12);
    EXPECT_NEAR(s.z_max_level_m, -1.3 + 2.5, 1e-12);
  }
}

TEST(WallScene, DirectionsDistancesAndLeanDoNotHangOnTheNormalsSign) {
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitX();
  for (double angle = -0.8; angle <= 0.8; angle += 0.1) {
    Plane wall;
    wall.n = Eigen::Vector3d(std::sin(angle), -std::cos(angle), 0.0);
    wall.d = 2.5;
    for (const Plane& p : {wall, wall.flipped()}) {
      EXPECT_NEAR(yaw_of(along_of(p, forward), forward), angle, 1e-12);
      EXPECT_NEAR(distance_at(p, Eigen::Vector3d(2, 0, 0)), std::fabs(2.5 + 2.0 * std::sin(angle)), 1e-12);
    }
  }
}

TEST(WallScene, PositiveLeanIsAwayFromTheMachineAtTheTop) {
  // The left wall's normal points to the machine, and up where its top leans away.
  Plane wall;
  wall.n = Eigen::Vector3d(0.0, -std::cos(0.1), std::sin(0.1));
  EXPECT_NEAR(lean_of(wall), 0.1, 1e-12);
}

}  // namespace
}  // namespace pose_wall
