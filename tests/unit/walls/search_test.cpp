// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: hypotheses are found on the right side, near vertical and within the allowed angle, keep apart from each
// other, and their number is bounded.

#include "engine/walls/propose/candidates.hpp"

#include <gtest/gtest.h>

#include "support/band_fixture.hpp"

namespace pose_wall {
namespace {

using test::BandFixture;
using test::kLongWall;

const SideView kLeft_view{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};

struct Search {
  explicit Search(BandFixture* band) : search(band->points().set().capacity()), random(1) {
    search->begin(band->points().set(), kLeft_view, band->settings(), &random);
  }
  test::Placed<WallSearch> search;
  Random random;
};

double lateral(const Plane& plane) {
  return -plane.d / plane.n.y();
}

TEST(WallSearch, TheWallOfItsSideLeadsTheList) {
  BandFixture band;
  band.add_wall(2.5, kLongWall, 0.2);
  band.add_wall(-1.5, kLongWall);
  band.add_wall(-1.5, kLongWall);
  Search s(&band);
  s.search->draw();
  ASSERT_GT(s.search->list().count(), 0U);
  // Two points with noise of 1 cm over at least a metre.
  EXPECT_NEAR(lateral(s.search->list()[0].plane), 2.5, 0.1);
  EXPECT_LE(s.search->scored(), band.settings().wall_iterations);
  for (std::uint32_t i = 0; i < s.search->list().count(); ++i) {
    const Plane& p = s.search->list()[i].plane;
    EXPECT_GT(lateral(p), 0.0);
    EXPECT_GT(p.d, 0.0);
    EXPECT_EQ(p.n.z(), 0.0);
    for (std::uint32_t j = 0; j < i; ++j) EXPECT_FALSE(SameWall{kLeft_view}(p, s.search->list()[j].plane));
  }
}

TEST(WallSearch, WithTheDirectionKnownEveryOffsetIsSeen) {
  BandFixture band;
  for (const double y : {1.5, 3.0, 6.0}) band.add_wall(y, kLongWall, 0.0, 0.005);
  Search s(&band);
  s.search->offer_offsets(Eigen::Vector3d(0, 1, 0));
  std::vector<double> found;
  for (std::uint32_t i = 0; i < s.search->list().count(); ++i) found.push_back(lateral(s.search->list()[i].plane));
  for (const double y : {1.5, 3.0, 6.0}) {
    EXPECT_TRUE(std::any_of(found.begin(), found.end(), [&](double f) { return std::fabs(f - y) < 0.06; })) << y;
  }
}

TEST(WallSearch, TooFewPointsGiveNoHypotheses) {
  BandFixture band;
  for (int i = 0; i < 10; ++i) band.points().add(i, 2.5, 0.0);
  Search s(&band);
  s.search->draw();
  s.search->offer(Plane{Eigen::Vector3d(0, -1, 0), 2.5});
  s.search->offer_offsets(Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(s.search->list().count(), 0U);
}

TEST(WallSearch, AllPointsInOnePlaceEndTheSearch) {
  BandFixture band;
  for (int i = 0; i < 500; ++i) band.points().add(1.0, 2.5, 0.0);
  Search s(&band);
  s.search->draw();
  EXPECT_EQ(s.search->scored(), 0U);
}

TEST(WallSearch, WhatMayBeAWall) {
  const auto may = [](double turned, double lean, double d) {
    Plane p;
    p.n = Eigen::Vector3d(std::sin(turned) * std::cos(lean), -std::cos(turned) * std::cos(lean), std::sin(lean));
    p.d = d;
    return may_be_wall(p, kLeft_view, WallLimits(0.8, 0.3));
  };
  EXPECT_TRUE(may(0.0, 0.0, 2.5));
  EXPECT_TRUE(may(0.79, 0.0, 2.5));
  EXPECT_FALSE(may(0.81, 0.0, 2.5));
  EXPECT_FALSE(may(-0.81, 0.0, 2.5));
  EXPECT_TRUE(may(0.0, -0.29, 2.5));
  EXPECT_FALSE(may(0.0, 0.31, 2.5));
  EXPECT_FALSE(may(0.0, 0.0, -2.5)) << "the machine stands behind it";
  EXPECT_FALSE(may(std::nan(""), 0.0, 2.5));
  EXPECT_FALSE(may(0.0, 0.0, std::nan("")));
}

TEST(WallSearch, SameWallIsSymmetricAndLocal) {
  const SameWall same{kLeft_view};
  const Plane a{Eigen::Vector3d(0, -1, 0), 2.5}, near{Eigen::Vector3d(0, -1, 0), 2.6};
  const Plane other{Eigen::Vector3d(0, -1, 0), 2.9}, turned{Eigen::Vector3d(std::sin(0.2), -std::cos(0.2), 0), 2.45};
  EXPECT_TRUE(same(a, near) && same(near, a) && same(a, a.flipped()));
  EXPECT_FALSE(same(a, other) || same(other, a));
  EXPECT_FALSE(same(a, turned));
  EXPECT_FALSE(same(a, Plane{Eigen::Vector3d(1, 0, 0), 2.5})) << "across the road";
  const SameWall surely_same{kLeft_view, 0.05};
  EXPECT_FALSE(surely_same(a, near));
  EXPECT_TRUE(surely_same(a, Plane{Eigen::Vector3d(0, -1, 0), 2.54}));
}

}  // namespace
}  // namespace pose_wall
