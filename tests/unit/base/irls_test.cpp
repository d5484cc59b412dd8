// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a plane is found again under a third of outliers, weights are capped, what spans no plane is refused, and
// what lies behind the last point plays no part.

#include "base/estimation/irls.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "support/stage_fixtures.hpp"

namespace pose_wall {
namespace {

constexpr IrlsSettings kSettings{0.15, 0.003, 0.05, 10};
constexpr std::uint32_t kPoints = 3000;

Plane leaning() {
  Plane plane;
  plane.n = Eigen::Vector3d(0.1, -0.99, 0.05).normalized();
  plane.d = 2.5;
  return plane;
}

// Points on the plane over 8 x 2 m with noise, and a share of outliers on the sensor's side.
void fill(double outliers, double sigma, test::OwnedPoints* points) {
  test::Noise noise(3);
  const Plane plane = leaning();
  const Eigen::Vector3d u = plane.n.cross(Eigen::Vector3d::UnitZ()).normalized(), v = plane.n.cross(u);
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    const bool outlier = i < outliers * kPoints;
    const double off = outlier ? noise.uniform(0.05, 0.3) : noise.normal(sigma);
    points->add(-plane.d * plane.n + noise.uniform(-4, 4) * u + noise.uniform(-1, 1) * v + off * plane.n);
  }
}

IrlsResult fit(test::OwnedPoints* points, const Plane& start) {
  test::Placed<TangentPoints> scratch(points->all().size());
  return irls_tukey(points->set(), points->all(), start, Eigen::Vector3d::UnitX(), kSettings, scratch.get());
}

double angle_between(const Plane& a, const Plane& b) {
  return std::acos(std::min(1.0, a.n.dot(b.n)));
}

// 3000 points of 1 cm over 8 m: slope 0.01 / (2.3 sqrt(2000)) = 0.1 mrad, offset 0.2 mm; five times that. Outliers
// that start at 5 cm leave the Tukey weights of a 1 cm scale (cutoff 4.7 cm) untouched.
TEST(Irls, RecoversThePlaneUnderAThirdOfOutliers) {
  for (const double outliers : {0.0, 0.3}) {
    test::OwnedPoints points(kPoints);
    fill(outliers, 0.01, &points);
    Plane start = leaning();
    start.n = (start.n + Eigen::Vector3d(0.005, 0.0, 0.01)).normalized();
    start.d += 0.02;
    const IrlsResult got = fit(&points, start);
    ASSERT_TRUE(got.solved);
    EXPECT_LT(angle_between(got.plane, leaning()), 0.001) << outliers;
    EXPECT_NEAR(got.plane.d, 2.5, 0.003) << outliers;
    EXPECT_LT(got.scale_m, 0.02) << outliers;
  }
}

// The last points are read four at a time with what lies behind them.
TEST(Irls, WhatLiesBehindTheLastPointPlaysNoPart) {
  test::OwnedPoints points(kPoints);
  fill(0.0, 0.01, &points);
  test::Placed<TangentPoints> scratch(kPoints);
  for (const std::uint32_t count : {100U, 101U, 102U, 103U}) {
    IrlsOver fits[3];
    int filled = 0;
    // What counts as a point, were it counted: the scale is told of every third, or with three more of every fifth.
    IrlsSettings settings = kSettings;
    settings.scale_points = (count + 2) / 3;
    for (const float behind : {0.0F, 1.0F, std::numeric_limits<float>::quiet_NaN()}) {
      scratch->begin(leaning(), Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX());
      for (std::uint32_t i = 0; i < count; ++i) test::add_point(points.set().at(i), 1.0F, scratch.get());
      for (std::uint32_t k = count; k < count + kFour; ++k) {
        for (Span<float>* row : {&scratch->u, &scratch->v, &scratch->r, &scratch->weight}) (*row)[k] = behind;
      }
      IrlsOver& fit = fits[filled++];
      fit = irls_tukey(*scratch, count, PlaneOver{}, settings);
      ASSERT_TRUE(fit.solved) << count;
      EXPECT_EQ(fits[0].over.as_correction(), fit.over.as_correction()) << count << " " << behind;
      EXPECT_EQ(fits[0].scale_m, fit.scale_m) << count << " " << behind;
    }
  }
}

TEST(Irls, ThePerfectPlaneStaysWhereItIs) {
  test::OwnedPoints points(kPoints);
  fill(0.0, 0.0, &points);
  const IrlsResult got = fit(&points, leaning());
  ASSERT_TRUE(got.solved);
  EXPECT_LT(angle_between(got.plane, leaning()), 1e-6);
  EXPECT_EQ(got.scale_m, kSettings.scale_min_m);
}

TEST(Irls, RefusesALineAPointAndNothing) {
  const Plane floor{Eigen::Vector3d::UnitZ(), 0.0};
  test::OwnedPoints line(1000), point(1000), none(1), far(1000);
  for (int i = 0; i < 1000; ++i) {
    line.add(0.01 * i, 0.02 * i, 0.0);
    point.add(1.0, 2.0, 0.0);
    far.add(0.1 * (i % 30), 0.1 * (i / 30), 5.0);
  }
  EXPECT_FALSE(fit(&line, floor).solved);
  EXPECT_FALSE(fit(&point, floor).solved);
  EXPECT_FALSE(fit(&none, floor).solved);
  EXPECT_FALSE(fit(&far, floor).solved) << "nothing within the gate";
}

TEST(Irls, ARefusalLeavesAFinitePlane) {
  test::OwnedPoints point(10);
  for (int i = 0; i < 10; ++i) point.add(1.0, 2.0, 0.0);
  const IrlsResult got = fit(&point, Plane{Eigen::Vector3d::UnitZ(), 0.0});
  EXPECT_TRUE(std::isfinite(got.plane.d) && std::isfinite(got.plane.n.sum()));
}

// One voxel that stands for a thousand points must not weigh like them.
TEST(Irls, OneHeavyPointDoesNotPullThePlane) {
  test::OwnedPoints points(1000);
  test::Noise noise(5);
  for (int i = 0; i < 900; ++i) points.add(noise.uniform(-4, 4), noise.uniform(-4, 4), 0.0);
  for (int i = 0; i < 20; ++i) points.add(0.1 * i, 0.0, 0.01, 1000.0F);
  const IrlsResult got = fit(&points, Plane{Eigen::Vector3d::UnitZ(), 0.0});
  ASSERT_TRUE(got.solved);
  // Capped at 8 each, the twenty hold at most 160 of 1060: 1.5 mm.
  EXPECT_LT(std::fabs(got.plane.d), 0.0016);
}

// Sums of four lanes each: the last group need not be whole, and what lies behind the count plays no part.
TEST(Irls, AnyCountOfPoints) {
  test::Noise noise(6);
  for (const std::uint32_t count : {4U, 5U, 6U, 7U, 8U, 101U}) {
    test::Placed<TangentPoints> points(count + 3);
    points->begin(Plane{Eigen::Vector3d::UnitZ(), 0.0}, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX());
    for (std::uint32_t i = 0; i < count; ++i) {
      const double u = i % 2 == 0 ? noise.uniform(-4, 0) : noise.uniform(0, 4), v = i % 4 < 2 ? -1.0 : 1.0;
      test::add_point(Eigen::Vector3d(u, v, 0.02 + 0.01 * u - 0.005 * v), 1.0F, points.get());
    }
    for (int i = 0; i < 3; ++i) test::add_point(Eigen::Vector3d(1.0, 1.0, 0.1), 1000.0F, points.get());
    const IrlsOver fit = irls_tukey(*points, count, PlaneOver{}, kSettings);
    ASSERT_TRUE(fit.solved) << count;
    EXPECT_NEAR(fit.over.offset_m, 0.02, 1e-5) << count;
    EXPECT_NEAR(fit.over.slope_u, 0.01, 1e-5) << count;
    EXPECT_NEAR(fit.over.slope_v, -0.005, 1e-5) << count;
  }
}

TEST(Irls, TakesNoMorePointsThanThereIsRoomFor) {
  constexpr std::uint32_t kRoom = 8;
  for (std::uint32_t count = 1; count <= 200; ++count) {
    test::OwnedPoints cloud(count);
    for (std::uint32_t i = 0; i < count; ++i) cloud.add(0.5 * (i % 7), 0.3 * (i % 5), 0.0);
    test::Placed<TangentPoints> points(kRoom);
    irls_tukey(cloud.set(), cloud.all(), Plane{Eigen::Vector3d::UnitZ(), 0.0}, Eigen::Vector3d::UnitX(), kSettings,
               points.get());
    ASSERT_EQ(points->count, std::min(count, kRoom));
    for (std::uint32_t k = 0; k < points->count; ++k) EXPECT_EQ(points->u[k], cloud.set().x[k]) << "the first";
  }
}

// A part of the points is fitted by taking the others' weight.
TEST(Irls, PointsWithoutWeightPlayNoPart) {
  constexpr std::uint32_t kHalved = 6000;
  test::Placed<TangentPoints> all(kHalved), some(kHalved);
  const Plane plane{Eigen::Vector3d::UnitZ(), 0.0};
  for (auto* points : {all.get(), some.get()}) points->begin(plane, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX());
  test::Noise noise(8);
  for (std::uint32_t i = 0; i < kHalved; ++i) {
    const bool out = i % 8 < 5;  // a layer 6 cm off, within the gate
    const Eigen::Vector3d p(noise.uniform(-4, 4), noise.uniform(-1, 1), noise.normal(0.01) + (out ? 0.06 : 0.0));
    test::add_point(p, out ? 0.0F : 1.0F, all.get());
    if (!out) test::add_point(p, 1.0F, some.get());
  }
  const IrlsOver a = irls_tukey(*all, all->count, PlaneOver{}, kSettings);
  const IrlsOver b = irls_tukey(*some, some->count, PlaneOver{}, kSettings);
  ASSERT_TRUE(a.solved && b.solved);
  EXPECT_NEAR(a.over.offset_m, b.over.offset_m, 2e-4);
  EXPECT_NEAR(a.scale_m, b.scale_m, 2e-3) << "each of some 750 of the points, but not the same";
}

TEST(Irls, EndsWhereItStandsStill) {
  test::Placed<TangentPoints> points(400U);
  points->begin(Plane{Eigen::Vector3d::UnitZ(), 0.0}, Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX());
  test::Noise noise(9);
  for (int i = 0; i < 400; ++i) {
    test::add_point(Eigen::Vector3d(noise.uniform(-4, 4), noise.uniform(-1, 1), 0.03 + noise.normal(0.01)), 1.0F,
                    points.get());
  }
  IrlsSettings once = kSettings, soon = kSettings;
  once.rounds = 1;
  soon.stands_still = 1.0;
  const IrlsOver a = irls_tukey(*points, 400, PlaneOver{}, once), b = irls_tukey(*points, 400, PlaneOver{}, soon);
  EXPECT_EQ(a.over.offset_m, b.over.offset_m) << "one round moves less than a metre";
  EXPECT_NE(a.over.offset_m, irls_tukey(*points, 400, PlaneOver{}, kSettings).over.offset_m);
}

}  // namespace
}  // namespace pose_wall
