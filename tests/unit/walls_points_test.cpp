// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: points that are put into the order of their patches stay what they are, each with its weight and its answer
// to a range bias; what is dropped is gone from its patch and no other; what a column says comes back for each point;
// what lies behind the last point is a number.

#include "stages/walls_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/band_fixture.hpp"

namespace pose_wall {
namespace {

using Row = std::array<float, 5>;  // u, v, r, weight, bias

constexpr double kWall_m = 2.5;

struct Sorted {
  test::BandFixture band;
  test::Placed<PatchGrid> patches;
  test::Placed<WallPoints> points;
  std::vector<Row> before;

  explicit Sorted(std::uint32_t count) {
    const WallScene scene = band.scene();
    points->begin(scene, Plane{-Eigen::Vector3d::UnitY(), kWall_m}, Eigen::Vector3d::UnitX());
    test::Noise noise(count);
    for (std::uint32_t k = 0; k < count; ++k) {
      const Eigen::Vector3d p(noise.uniform(-12, 15), kWall_m + noise.normal(0.02), noise.uniform(-1, 1));
      points->add(p, static_cast<float>(k + 1));
    }
    before = rows();
    std::vector<std::uint32_t> places(count);
    points->sort_by_patch(patches.get(), Span<std::uint32_t>(places.data(), count));
  }

  Row row(std::uint32_t k) {
    const WallPoints& p = *points;
    return {p.at.u[k], p.at.v[k], p.at.r[k], p.at.weight[k], p.bias[k]};
  }
  std::vector<Row> rows() {
    std::vector<Row> out;
    for (std::uint32_t k = 0; k < points->at.count; ++k) out.push_back(row(k));
    return out;
  }
};

std::vector<Row> in_any_order(std::vector<Row> rows) {
  std::sort(rows.begin(), rows.end());
  return rows;
}

// Each patch's range holds its points and no others.
void expect_in_patches(Sorted* s) {
  std::uint32_t k = 0;
  for (std::uint32_t patch = 0; patch < s->patches->patches(); ++patch) {
    for (; k < s->points->patch_end[patch]; ++k) {
      const FourInts of = s->patches->patch_of(all_four(s->points->at.u[k]), all_four(s->points->at.v[k]));
      ASSERT_EQ(of[0], static_cast<std::int32_t>(patch)) << k;
    }
  }
  EXPECT_EQ(k, s->points->at.count);
}

TEST(WallPoints, SortingKeepsEachPointTogether) {
  for (const std::uint32_t count : {0U, 1U, 3U, 4U, 5U, 2001U, WallPoints::kMost}) {
    Sorted s(count);
    EXPECT_EQ(in_any_order(s.rows()), in_any_order(s.before)) << count;
    expect_in_patches(&s);
    for (const Span<float>& row :
         {s.points->at.u, s.points->at.v, s.points->at.r, s.points->at.weight, s.points->bias}) {
      for (std::uint32_t k = count; k < count + kFour; ++k) EXPECT_EQ(row[k], 0.0F) << count;
    }
  }
}

TEST(WallPoints, TwiceInARow) {
  Sorted s(500);
  std::vector<std::uint32_t> places(500);
  const std::vector<Row> once = s.rows();
  s.points->sort_by_patch(s.patches.get(), Span<std::uint32_t>(places.data(), 500));
  EXPECT_EQ(s.rows(), once) << "the order within a patch stays";
}

TEST(WallPoints, WhatIsDroppedIsGoneAndNothingElse) {
  Sorted s(777);
  const std::vector<Row> all = s.rows();
  std::vector<Row> expected;
  for (std::uint32_t k = 0; k < 777; ++k) {
    s.points->spare[k] = k % 3 == 0 ? 0.0F : 1.0F;
    if (k % 3 != 0) expected.push_back(all[k]);
  }
  s.points->keep(s.points->spare);
  EXPECT_EQ(s.rows(), expected);
  expect_in_patches(&s);
  EXPECT_EQ(s.points->at.u[s.points->at.count], 0.0F);
}

TEST(WallPoints, EachKnowsItsColumn) {
  Sorted s(2001);
  test::Placed<StripProfile> strips;
  strips->begin(-20.0, -1.0, 1.0);
  // Strips of 15 cm, a decimetre deep, every metre.
  for (double u = -12.0; u < 15.0; u += 0.02) {
    const bool strip = std::fabs(u - std::round(u)) < 0.075;
    for (double v = -0.95; v < 1.0; v += 0.1) strips->add(u, v, (strip ? 0.1 : 0.0) + 0.004 * std::sin(40.0 * u + v));
  }
  ASSERT_TRUE(strips->find(0.0, 10.0, 0.2));
  s.points->mark_columns(*strips);
  int marked = 0;
  for (std::uint32_t k = 0; k < 2001; ++k) {
    const StripProfile::FourColumns here = s.points->columns_of(k);
    const StripProfile::FourColumns expected = strips->columns_of(all_four(s.points->at.u[k]));
    EXPECT_EQ(here.is_strip[0] != 0, expected.is_strip[0] != 0) << k;
    EXPECT_NEAR(here.surface_probability[0], expected.surface_probability[0], 1e-6F) << k;
    marked += here.is_strip[0] != 0 ? 1 : 0;
  }
  EXPECT_GT(marked, 50);
  const StripProfile::FourColumns behind = s.points->columns_of(2001);
  for (std::uint32_t lane = 0; lane < kFour; ++lane) EXPECT_EQ(behind.surface_probability[lane], 0.0F);
}

TEST(WallPoints, HeightsAreThoseOfThePoints) {
  Sorted s(40);
  for (std::uint32_t k = 0; k < 37; ++k) {
    const FourFloats four = s.points->four_z_level_m(k);
    EXPECT_NEAR(static_cast<double>(four[0]), s.points->z_level_m(k), 1e-5);
  }
}

}  // namespace
}  // namespace pose_wall
