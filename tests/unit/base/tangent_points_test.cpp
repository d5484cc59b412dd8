// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a plane told as a height over another one is that plane: distances and sides are the same, however far it is
// turned, corrections add up, and the points of a list are those of the cloud.

#include "base/estimation/tangent_points.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr std::uint32_t kPoints = 200;

struct Cloud {
  test::Placed<TangentPoints> points{kPoints};
  std::vector<Eigen::Vector3d> at;

  explicit Cloud(const Plane& around) {
    test::Noise noise(2);
    points->begin(around, Eigen::Vector3d(0.3, -0.2, 0.1), Eigen::Vector3d::UnitX());
    for (std::uint32_t k = 0; k < kPoints; ++k) {
      at.emplace_back(noise.uniform(-15, 15), noise.uniform(-15, 15), noise.uniform(-3, 3));
      test::add_point(at.back(), 1.0F, points.get());
    }
  }
};

Plane leaning() {
  Plane plane;
  plane.n = Eigen::Vector3d(0.1, -0.99, 0.05).normalized();
  plane.d = 2.5;
  return plane;
}

// Floats of 30 m: 2e-6.
TEST(TangentPoints, DistancesAreThoseFromThePlane) {
  Cloud cloud(leaning());
  for (const PlaneOver over : {PlaneOver{}, PlaneOver{0.1, 0.02, -0.03}, PlaneOver{-0.3, 0.4, 0.7}}) {
    const Plane plane = cloud.points->plane_of(over);
    EXPECT_NEAR(plane.n.norm(), 1.0, 1e-12);
    for (std::uint32_t k = 0; k < kPoints; ++k) {
      EXPECT_NEAR(cloud.points->distance(k, over, over.foreshortening()), plane.signed_distance(cloud.at[k]), 1e-5);
    }
  }
}

// Told four at a time, in floats, each is where it is told to be one by one.
TEST(TangentPoints, PointsOfAListAreThoseOfTheCloud) {
  constexpr std::uint32_t kRoom = 21;
  test::Noise noise(5);
  test::OwnedPoints cloud(kPoints);
  for (std::uint32_t k = 0; k < kPoints; ++k) {
    cloud.add(noise.uniform(-30, 30), noise.uniform(-30, 30), noise.uniform(-3, 3), static_cast<float>(k + 1));
  }
  for (std::uint32_t listed = 0; listed <= kRoom + 4; ++listed) {
    std::vector<std::uint32_t> list;
    for (std::uint32_t k = 0; k < listed; ++k) list.push_back((37 * k + 11) % kPoints);
    test::Placed<TangentPoints> points(kRoom);
    points->begin(leaning(), Eigen::Vector3d(0.3, -0.2, 0.1), Eigen::Vector3d::UnitX());
    test::add_point(Eigen::Vector3d(1.0, 2.0, 3.0), 0.5F, points.get());
    points->add(cloud.set(), Span<const std::uint32_t>(list.data(), listed));
    ASSERT_EQ(points->count, listed < kRoom ? listed + 1 : kRoom) << "as far as there is room";
    EXPECT_EQ(points->weight[0], 0.5F);
    for (std::uint32_t k = 1; k < points->count; ++k) {
      const Eigen::Vector3d expected = points->in_frame(cloud.set().at(list[k - 1]));
      EXPECT_NEAR(points->u[k], expected.x(), 1e-5) << k;
      EXPECT_NEAR(points->v[k], expected.y(), 1e-5) << k;
      EXPECT_NEAR(points->r[k], expected.z(), 1e-5) << k;
      EXPECT_EQ(points->weight[k], cloud.set().weight[list[k - 1]]) << k;
    }
  }
}

TEST(TangentPoints, CorrectionsAddUp) {
  PlaneOver over{0.1, 0.02, -0.03};
  over.add(Eigen::Vector3d(0.01, -0.02, 0.005));
  EXPECT_NEAR(over.offset_m, 0.11, 1e-15);
  EXPECT_NEAR(over.slope_u, 0.0, 1e-15);
  EXPECT_NEAR(over.slope_v, -0.025, 1e-15);
  EXPECT_EQ(over.as_correction(), Eigen::Vector3d(over.offset_m, over.slope_u, over.slope_v));
}

TEST(TangentPoints, BeginForgetsWhatWasThere) {
  Cloud cloud(leaning());
  cloud.points->begin(Plane{}, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX());
  EXPECT_EQ(cloud.points->count, 0U);
  test::add_point(Eigen::Vector3d(1.0, 2.0, 3.0), 5.0F, cloud.points.get());
  EXPECT_EQ(cloud.points->u[0], 1.0F);
  EXPECT_EQ(cloud.points->v[0], 2.0F);
  EXPECT_EQ(cloud.points->r[0], 3.0F);
  EXPECT_EQ(cloud.points->weight[0], 5.0F);
}

TEST(TangentPoints, FourDistancesAreThoseOfEach) {
  Cloud cloud(leaning());
  const PlaneOver over{-0.3, 0.04, 0.07};
  for (std::uint32_t k = 0; k + kFour <= kPoints; k += 3) {
    const FourFloats r = cloud.points->four_distances(k, over, over.foreshortening());
    for (std::uint32_t lane = 0; lane < kFour; ++lane) {
      const double one = cloud.points->distance(k + lane, over, over.foreshortening());
      EXPECT_NEAR(static_cast<double>(r[lane]), one, 5e-6) << k;
    }
  }
}

}  // namespace
}  // namespace pose_wall
