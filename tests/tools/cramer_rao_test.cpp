// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the Cramer-Rao bound is that of the textbook where it can be worked out by hand, a least-squares fit to the
// same points reaches it, and which points count. Does not prove: that the engine reaches it
// (scenario/clean_efficiency).

#include "study/truth/cramer_rao.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <random>
#include <vector>

namespace pose_wall::tools {
namespace {

constexpr double kNoise_m = 0.01;
constexpr double kHeight_m = 1.5;
constexpr double kToWall_m = 4.0;  // from the middle of a wide road
const std::array<double, kTruthQuantities> kStraight = {0, 0, 0, 4, 4, 4, 4};
const View kWide = {kHeight_m, 100.0, {{{-100.0, 100.0}, {-100.0, 100.0}}}};

class NoisyRoad {
 public:
  void add(double x_m, double y_m, double z_m) {
    for (const double coordinate : {x_m, y_m, z_m}) xyz_.push_back(static_cast<float>(coordinate));
  }
  // Points of the plane across the ray, moved along it.
  void add_with_noise(const Eigen::Vector3d& p, std::mt19937* random) {
    const Eigen::Vector3d moved = p + kNoise_m * std::normal_distribution<double>()(*random) * p.normalized();
    add(moved.x(), moved.y(), moved.z());
  }
  pose_wall_cloud cloud() const {
    pose_wall_cloud out;
    pose_wall_cloud_xyz32(&out, xyz_.data(), static_cast<std::uint32_t>(xyz_.size() / 3), 3 * sizeof(float), 0);
    return out;
  }

 private:
  std::vector<float> xyz_;
};

// Four floor points in a square: z errors are the range noise times the cosine of incidence, the same for all.
NoisyRoad square_floor(double half_m) {
  NoisyRoad road;
  for (const double x : {-half_m, half_m}) {
    for (const double y : {-half_m, half_m}) road.add(x, y, -kHeight_m);
  }
  return road;
}

TEST(CramerRao, FourFloorPointsByHand) {
  const double half_m = 1.2;
  const NoisyRoad road = square_floor(half_m);
  const FrameBound bound = CramerRao(api::Config(), kNoise_m).bound(road.cloud(), kStraight, kWide);
  const double across_m = kNoise_m * kHeight_m / std::sqrt(2.0 * half_m * half_m + kHeight_m * kHeight_m);
  // Slope of a line through four heights at +-half: sigma / (half * sqrt(4)).
  EXPECT_NEAR(bound.sigma[POSE_WALL_ROLL], across_m / (2.0 * half_m), 1e-7);
  EXPECT_NEAR(bound.sigma[POSE_WALL_PITCH], across_m / (2.0 * half_m), 1e-7);
  EXPECT_EQ(bound.floor_points, 4U);
  for (std::uint32_t q = POSE_WALL_YAW; q <= POSE_WALL_D_RB; ++q) EXPECT_TRUE(std::isnan(bound.sigma[q])) << q;
}

TEST(CramerRao, TwoFloorPointsTellNothing) {
  NoisyRoad road;
  road.add(1.0, 0.0, -kHeight_m);
  road.add(-1.0, 0.0, -kHeight_m);
  const FrameBound bound = CramerRao(api::Config(), kNoise_m).bound(road.cloud(), kStraight, kWide);
  EXPECT_TRUE(std::isnan(bound.sigma[POSE_WALL_ROLL]));
  EXPECT_TRUE(std::isnan(bound.sigma[POSE_WALL_PITCH]));
}

NoisyRoad with_left_wall(double reach_m) {
  NoisyRoad road = square_floor(1.2);
  for (const double x : {-reach_m, reach_m}) {
    for (const double z : {-0.5, 0.5}) road.add(x, kToWall_m, z);
  }
  return road;
}

TEST(CramerRao, OneWallGivesItsOwnDistancesAndYaw) {
  const FrameBound bound = CramerRao(api::Config(), kNoise_m).bound(with_left_wall(3.0).cloud(), kStraight, kWide);
  const double share = kToWall_m / std::sqrt(3.0 * 3.0 + kToWall_m * kToWall_m + 0.5 * 0.5);
  // The machine stands level and straight: no error of the floor turns into yaw.
  EXPECT_NEAR(bound.sigma[POSE_WALL_YAW], kNoise_m * share / (2.0 * 3.0), 1e-7);
  // At 2 m ahead: offset and slope together.
  const double slope_part = 2.0 * kNoise_m * share / (2.0 * 3.0);
  EXPECT_NEAR(bound.sigma[POSE_WALL_D_LF], std::hypot(kNoise_m * share / 2.0, slope_part), 1e-7);
  EXPECT_NEAR(bound.sigma[POSE_WALL_D_LB], bound.sigma[POSE_WALL_D_LF], 1e-7);
  EXPECT_TRUE(std::isnan(bound.sigma[POSE_WALL_D_RF]));
}

TEST(CramerRao, AnErrorOfTheFloorTurnsIntoYawWhereTheNoseIsUp) {
  // Nose up by 0.3 rad: a roll error turns part of itself about the vertical.
  const Eigen::Matrix3d level = Eigen::AngleAxisd(-0.3, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const auto yaw_sigma = [&](double floor_half_m) {
    NoisyRoad road;
    for (const double x : {-1.0, 1.0}) {
      for (const double y : {-floor_half_m, floor_half_m}) {
        const Eigen::Vector3d p = level.transpose() * Eigen::Vector3d(x, y, -kHeight_m);
        road.add(p.x(), p.y(), p.z());
      }
      for (const double z : {-0.5, 0.5}) {
        const Eigen::Vector3d p = level.transpose() * Eigen::Vector3d(3.0 * x, kToWall_m, z);
        road.add(p.x(), p.y(), p.z());
      }
    }
    const std::array<double, kTruthQuantities> truth = {0, -0.3, 0, 4, 4, kNoTruth, kNoTruth};
    return CramerRao(api::Config(), kNoise_m).bound(road.cloud(), truth, kWide).sigma[POSE_WALL_YAW];
  };
  EXPECT_GT(yaw_sigma(0.3), 1.5 * yaw_sigma(1.9));
}

TEST(CramerRao, MorePointsAndGrazingRaysTellMore) {
  const CramerRao bounds{api::Config(), kNoise_m};
  const double near = bounds.bound(with_left_wall(3.0).cloud(), kStraight, kWide).sigma[POSE_WALL_YAW];
  const double far = bounds.bound(with_left_wall(9.0).cloud(), kStraight, kWide).sigma[POSE_WALL_YAW];
  // Three times the lever, and the noise lies along the wall rather than across it: 5.04 / 9.86 of it is left.
  EXPECT_NEAR(far, near / 3.0 * 5.025 / 9.862, 1e-3 * near);
}

TEST(CramerRao, OnlyPointsInViewCount) {
  const NoisyRoad road = with_left_wall(3.0);
  const CramerRao bounds{api::Config(), kNoise_m};
  View view = kWide;
  view.wall_span_m[0] = {-100.0, 0.0};
  EXPECT_EQ(bounds.bound(road.cloud(), kStraight, view).wall_points[0], 2U);
  view = kWide;
  view.floor_radius_m = 1.0;
  EXPECT_EQ(bounds.bound(road.cloud(), kStraight, view).floor_points, 0U);
  api::Config low;
  ASSERT_EQ(low.set("wall_z_max", 1.5), POSE_WALL_OK);
  EXPECT_EQ(CramerRao(low, kNoise_m).bound(road.cloud(), kStraight, kWide).wall_points[0], 2U);
  api::Config body;
  ASSERT_EQ(body.set("body_box_1", "0 5 0 5 -2 2"), POSE_WALL_OK);
  EXPECT_EQ(CramerRao(body, kNoise_m).bound(road.cloud(), kStraight, kWide).wall_points[0], 2U);
  EXPECT_EQ(CramerRao(body, kNoise_m).bound(road.cloud(), kStraight, kWide).floor_points, 3U);
}

TEST(CramerRao, FloorAtTheFootOfAWallDoesNotCount) {
  NoisyRoad road = square_floor(1.2);
  for (const double away_m : {0.1, 0.2, 0.3}) road.add(1.0, kToWall_m - away_m, -kHeight_m);
  const CramerRao bounds{api::Config(), kNoise_m};
  EXPECT_EQ(bounds.bound(road.cloud(), kStraight, kWide).floor_points, 5U);
  const std::array<double, kTruthQuantities> no_walls = {0, 0, 0, kNoTruth, kNoTruth, kNoTruth, kNoTruth};
  EXPECT_EQ(bounds.bound(road.cloud(), no_walls, kWide).floor_points, 7U);
}

// Heights of floor points with noise along the ray, the plane by weighted least squares at the points' true places:
// the estimator that reaches the bound. 2000 draws give its standard deviation to 1.6 % (1 sigma); 6 % asked.
TEST(CramerRao, LeastSquaresReachesIt) {
  std::mt19937 random(5);
  std::vector<Eigen::Vector3d> places;
  for (int i = 0; i < 60; ++i) {
    const double angle = 0.1 * i, away_m = 1.0 + 0.03 * i;
    places.emplace_back(away_m * std::cos(angle), away_m * std::sin(angle), -kHeight_m);
  }
  NoisyRoad road;
  for (const Eigen::Vector3d& p : places) road.add_with_noise(p, &random);
  const FrameBound bound = CramerRao(api::Config(), kNoise_m).bound(road.cloud(), kStraight, kWide);

  double roll2 = 0.0, pitch2 = 0.0;
  constexpr int kDraws = 2000;
  for (int draw = 0; draw < kDraws; ++draw) {
    Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : places) {
      const double across_m = kNoise_m * kHeight_m / p.norm();
      const double residual_m = across_m * std::normal_distribution<double>()(random);
      const Eigen::Vector3d a(1.0, p.x(), p.y());
      information += a * a.transpose() / (across_m * across_m);
      right += a * residual_m / (across_m * across_m);
    }
    const Eigen::Vector3d slope = information.inverse() * right;
    roll2 += slope[2] * slope[2];
    pitch2 += slope[1] * slope[1];
  }
  EXPECT_NEAR(std::sqrt(roll2 / kDraws) / bound.sigma[POSE_WALL_ROLL], 1.0, 0.06);
  EXPECT_NEAR(std::sqrt(pitch2 / kDraws) / bound.sigma[POSE_WALL_PITCH], 1.0, 0.06);
  // 60 points scatter as the noise says, give or take a tenth (1 sigma).
  EXPECT_NEAR(bound.noise_ratio, 1.0, 0.35);
}

}  // namespace
}  // namespace pose_wall::tools
