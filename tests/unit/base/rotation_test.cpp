// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: roll and pitch follow the specification's sign formulas, and R_level = Ry(pitch) Rx(roll) takes the floor's
// normal to +Z without a turn of its own, up to the greatest tilts that are allowed.

#include "base/math/rotation.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace pose_wall {
namespace {

// Products of three matrices of sines and cosines: a few units in the last place.
constexpr double kTolerance = 1e-14;

Eigen::Matrix3d about(const Eigen::Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

TEST(Rotation, ZyxIsTheProductOfThreeTurns) {
  for (double roll = -3.1; roll < 3.2; roll += 0.7) {
    for (double pitch = -1.5; pitch < 1.6; pitch += 0.5) {
      for (double yaw = -3.1; yaw < 3.2; yaw += 0.9) {
        const Eigen::Matrix3d expected = about(Eigen::Vector3d::UnitZ(), yaw) * about(Eigen::Vector3d::UnitY(), pitch) *
                                         about(Eigen::Vector3d::UnitX(), roll);
        ASSERT_LT((rotation_zyx(roll, pitch, yaw) - expected).cwiseAbs().maxCoeff(), kTolerance);
      }
    }
  }
}

TEST(Rotation, FormulasOfTheSpecification) {
  for (double x = -0.6; x <= 0.6; x += 0.15) {
    for (double y = -0.6; y <= 0.6; y += 0.15) {
      const Eigen::Vector3d n = Eigen::Vector3d(x, y, 1.0).normalized();
      const RollPitch angles = roll_pitch_of_up(n);
      ASSERT_NEAR(angles.roll_rad, std::atan2(n.y(), n.z()), kTolerance);
      ASSERT_NEAR(angles.pitch_rad, std::atan2(-n.x(), std::hypot(n.y(), n.z())), kTolerance);
    }
  }
}

TEST(Rotation, LevelTakesTheNormalUpAndHasNoTurnAboutZ) {
  for (double roll = -1.0; roll <= 1.0; roll += 0.1) {
    for (double pitch = -1.0; pitch <= 1.0; pitch += 0.1) {
      const Eigen::Matrix3d expected = about(Eigen::Vector3d::UnitY(), pitch) * about(Eigen::Vector3d::UnitX(), roll);
      const Eigen::Vector3d up = expected.transpose() * Eigen::Vector3d::UnitZ();
      const RollPitch angles = roll_pitch_of_up(up);
      ASSERT_LT((up_of_roll_pitch({roll, pitch}) - up).norm(), kTolerance);
      ASSERT_NEAR(angles.roll_rad, roll, kTolerance);
      ASSERT_NEAR(angles.pitch_rad, pitch, kTolerance);
      const Eigen::Matrix3d level = level_rotation(up);
      ASSERT_LT((level - expected).cwiseAbs().maxCoeff(), kTolerance);
      ASSERT_LT((level * up - Eigen::Vector3d::UnitZ()).cwiseAbs().maxCoeff(), kTolerance);
    }
  }
}

TEST(Rotation, SignsAsAPersonWouldSayThem) {
  // A machine rolled to the right (right side down) sees the floor's normal lean to its left: +Y.
  EXPECT_GT(roll_pitch_of_up(Eigen::Vector3d(0.0, 0.1, 1.0).normalized()).roll_rad, 0.0);
  // Nose down: the normal leans back, to -X.
  EXPECT_GT(roll_pitch_of_up(Eigen::Vector3d(-0.1, 0.0, 1.0).normalized()).pitch_rad, 0.0);
}

}  // namespace
}  // namespace pose_wall
