// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the standard deviations of yaw and the distances are those of the surface's errors at the sampling points.
// The pivot is where offset and slope are uncorrelated. Of two accepted walls a straight one takes in what the other
// shows of the rock; one that may bend does not, and a refused one lends nothing. Does not prove that the errors of a
// surface are true: wave_models_test and patch_fit_test do.

#include "engine/walls/sample/measure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace pose_wall {
namespace {

constexpr double kFreedom = 40.0;
constexpr double kFine_m = 0.002, kCoarse_m = 0.02;  // standard deviations of the offset under two models

struct Likelihoods {
  double fine, coarse;
};
constexpr Likelihoods kUnsure{0.0, 0.0}, kSureOfFine{0.0, -30.0}, kSureOfCoarse{-30.0, 0.0};

// Offset and slopes, of one surface whose waves are fine or coarse.
PatchErrors errors_of(const Likelihoods& of) {
  PatchErrors out;
  out.layers = 1;
  LinearErrors& errors = out.layer[0];
  const Eigen::Matrix3d fine = Eigen::Vector3d(1.0, 0.01, 0.04).asDiagonal();
  errors.freedom = kFreedom;
  errors.set(0, of.fine, kFine_m * kFine_m * fine);
  errors.set(1, of.coarse, kCoarse_m * kCoarse_m * fine);
  errors.weigh(WaveEvidence{});
  return out;
}

JudgedWall wall(bool straight) {
  JudgedWall w;
  w.fit.found = true;
  w.straight = straight;
  w.at_sample[0] = {1.0, 2.0, 0.5};
  w.at_sample[1] = {1.0, -2.0, 0.5};
  return w;
}

struct Walls {
  JudgedWall side[2];

  Walls(const Likelihoods& left, const Likelihoods& right, const JudgedWall& left_wall, const JudgedWall& right_wall)
      : side{left_wall, right_wall} {
    const PatchErrors errors[2] = {errors_of(left), errors_of(right)};
    set_sigmas(errors, 5.0, &side);
  }
  Walls(const Likelihoods& left, const Likelihoods& right) : Walls(left, right, wall(true), wall(true)) {}
};

// Of the yaw alone; the distances go with it.
bool is_fine(const JudgedWall& w) {
  return w.yaw_sigma_rad < 3.0 * 0.1 * kFine_m;
}
bool is_coarse(const JudgedWall& w) {
  return w.yaw_sigma_rad > 0.6 * 0.1 * kCoarse_m;
}

TEST(WallSigmas, TheyAreThoseOfTheErrorsAtTheSamplingPoints) {
  Eigen::Matrix3d covariance;
  covariance << 4e-6, 6e-7, 1e-7,  //
      6e-7, 1e-6, 2e-7,            //
      1e-7, 2e-7, 9e-6;
  PatchErrors errors[2];
  errors[0].layers = 1;
  errors[0].layer[0].freedom = kFreedom;
  errors[0].layer[0].set(0, 0.0, covariance);
  errors[0].layer[0].weigh(WaveEvidence{});
  JudgedWall walls[2] = {wall(true), JudgedWall()};
  walls[0].yaw_per_slope = 2.0;
  walls[0].frame.origin = {1.0, 2.0, 0.0};
  walls[0].frame.u = Eigen::Vector3d::UnitX();
  set_sigmas(errors, 5.0, &walls);
  EXPECT_NEAR(walls[0].yaw_sigma_rad, 2.0 * 1e-3, 1e-7);
  EXPECT_NEAR(walls[0].yaw_dof, kFreedom, 0.1);
  for (int end = 0; end < 2; ++end) {
    const Eigen::Vector3d at = walls[0].at_sample[end];
    EXPECT_NEAR(walls[0].distance_sigma_m[end], std::sqrt(at.dot(covariance * at)), 1e-7);
    EXPECT_NEAR(walls[0].distance_dof[end], kFreedom, 0.1);
  }
  EXPECT_NEAR((walls[0].pivot_level_m - Eigen::Vector3d(1.0 - 0.6, 2.0, 0.0)).norm(), 0.0, 1e-6);
  EXPECT_EQ(walls[1].yaw_sigma_rad, 0.0) << "not found";
}

TEST(WallSigmas, AStraightWallTakesInWhatTheOtherShows) {
  EXPECT_TRUE(is_coarse(Walls(kUnsure, kUnsure).side[0]));
  const Walls fine(kUnsure, kSureOfFine), coarse(kUnsure, kSureOfCoarse);
  EXPECT_LT(fine.side[0].yaw_sigma_rad, 0.5 * Walls(kUnsure, kUnsure).side[0].yaw_sigma_rad);
  EXPECT_LT(fine.side[0].distance_sigma_m[0], 0.5 * Walls(kUnsure, kUnsure).side[0].distance_sigma_m[0]);
  EXPECT_GT(coarse.side[0].yaw_sigma_rad, 1.2 * Walls(kUnsure, kUnsure).side[0].yaw_sigma_rad);
  EXPECT_TRUE(is_fine(fine.side[1])) << "and keeps what it knows by itself";
}

TEST(WallSigmas, ItsOwnEvidenceOutvotesTheOthers) {
  const Walls apart(kSureOfFine, kSureOfCoarse);
  EXPECT_TRUE(is_fine(apart.side[0]));
  EXPECT_TRUE(is_coarse(apart.side[1]));
}

// Each takes in what the other one shows by itself, not what that one has taken in before.
TEST(WallSigmas, LeftAndRightAreAlike) {
  const Likelihoods hardly_fine{1.0, 0.0};
  const Walls one(kUnsure, hardly_fine), other(hardly_fine, kUnsure);
  for (int side = 0; side < 2; ++side) {
    EXPECT_EQ(one.side[side].yaw_sigma_rad, other.side[1 - side].yaw_sigma_rad);
    EXPECT_EQ(one.side[side].distance_sigma_m[1], other.side[1 - side].distance_sigma_m[1]);
    EXPECT_EQ(one.side[side].yaw_dof, other.side[1 - side].yaw_dof);
  }
}

TEST(WallSigmas, AWallThatMayBendTakesInNothingButLends) {
  const Walls walls(kUnsure, kSureOfFine, wall(false), wall(true));
  EXPECT_TRUE(is_coarse(walls.side[0]));
  const Walls lends(kUnsure, kSureOfFine, wall(true), wall(false));
  EXPECT_LT(lends.side[0].yaw_sigma_rad, 0.5 * walls.side[0].yaw_sigma_rad);
}

TEST(WallSigmas, ARefusedWallLendsNothingAndTakesInNothing) {
  for (int refused = 0; refused < 2; ++refused) {
    JudgedWall of[2] = {wall(true), wall(true)};
    of[refused].fit.refused = true;
    const Walls walls(kUnsure, kSureOfFine, of[0], of[1]);
    EXPECT_TRUE(is_coarse(walls.side[0])) << refused;
    EXPECT_TRUE(is_fine(walls.side[1])) << refused;
  }
}

// Fronts of strips are a layer of their own: it errs by itself, whatever the other wall shows.
TEST(WallSigmas, AnotherLayerAddsItsErrors) {
  PatchErrors errors[2] = {errors_of(kSureOfFine), errors_of(kSureOfFine)};
  errors[0].layer[1] = errors_of(kSureOfCoarse).layer[0];
  errors[0].layers = 2;
  JudgedWall walls[2] = {wall(true), wall(true)};
  set_sigmas(errors, 5.0, &walls);
  EXPECT_NEAR(walls[0].yaw_sigma_rad, 0.1 * std::hypot(kFine_m, kCoarse_m), 1e-5);
  EXPECT_TRUE(is_fine(walls[1]));
}

}  // namespace
}  // namespace pose_wall
