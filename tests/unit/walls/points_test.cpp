// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a range bias answers by how the ray runs along the normal; points that are put into the order of their
// patches stay what they are, each with its weight and its answer to a range bias; what is dropped is gone from its
// patch and no other; within a patch each lies where its column belongs, and knows what that says; what lies behind the
// last point is a number.

#include "engine/walls/fit/points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/band_fixture.hpp"

namespace pose_wall {
namespace {

using Row = std::array<float, 5>;  // u, v, r, weight, bias

constexpr double kPlane_y_m = 2.5;

struct Sorted {
  test::BandFixture band;
  test::Placed<PatchGrid> patches;
  test::Placed<WallPoints> points;
  std::vector<Row> before;

  explicit Sorted(std::uint32_t count) {
    const WallScene scene = band.scene();
    points->begin(scene, Plane{-Eigen::Vector3d::UnitY(), kPlane_y_m}, Eigen::Vector3d::UnitX());
    test::Noise noise(count);
    test::OwnedPoints cloud(count);
    for (std::uint32_t k = 0; k < count; ++k) {
      cloud.add(noise.uniform(-12, 15), kPlane_y_m + noise.normal(0.02), noise.uniform(-1, 1),
                static_cast<float>(k + 1));
    }
    points->add(cloud.set(), cloud.all());
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
    for (; k < s->points->patches[patch].end; ++k) {
      const FourInts of = s->patches->patch_of(all_four(s->points->at.u[k]), all_four(s->points->at.v[k]));
      ASSERT_EQ(of[0], static_cast<std::int32_t>(patch)) << k;
    }
  }
  EXPECT_EQ(k, s->points->at.count);
}

TEST(WallPoints, ABiasIsHowTheRayRunsAlongTheNormal) {
  Sorted s(101);
  for (std::uint32_t k = 0; k < s.points->at.count; ++k) {
    const TangentPoints& at = s.points->at;
    const Eigen::Vector3d ray = Eigen::Vector3d(at.u[k], at.v[k], at.r[k]) - s.points->sensor;
    EXPECT_NEAR(s.points->bias[k], ray.z() / ray.norm(), 1e-6) << k;
  }
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

// Strips of 15 cm, a decimetre deep, every metre.
test::Placed<StripProfile> strips_every_metre() {
  test::Placed<StripProfile> strips;
  strips->begin(-20.0, -1.0, 1.0);
  for (double u = -12.0; u < 15.0; u += 0.02) {
    const bool strip = std::fabs(u - std::round(u)) < 0.075;
    for (double v = -0.95; v < 1.0; v += 0.1) {
      const double r = (strip ? 0.1 : 0.0) + 0.004 * std::sin(40.0 * u + v);
      const FourFloats height = all_four(static_cast<float>(v));
      strips->add(all_four(static_cast<float>(u)), height, all_four(static_cast<float>(r)), height, first_of_four(1));
    }
  }
  EXPECT_TRUE(strips->find(PlaneOver{}, 0.0, 10.0, 0.2));
  return strips;
}

// Each part of a patch holds what belongs there by its column; returns how many lie in strips.
std::uint32_t expect_in_parts(Sorted* s, const StripProfile& strips) {
  std::uint32_t in_strips = 0;
  s->points->for_each_patch([&](const WallPoints::Patch& patch, std::uint32_t begin) {
    for (std::uint32_t k = begin; k < patch.end; ++k) {
      const StripProfile::FourColumns column = strips.columns_of(all_four(s->points->at.u[k]));
      const bool is_surface = column.surface_probability[0] > 0.0F, is_strip = column.is_strip[0] != 0;
      EXPECT_EQ(is_surface, k < patch.surface_end) << k;
      EXPECT_EQ(is_strip, k >= patch.surface_only_end && k < patch.strip_end) << k;
      EXPECT_EQ(s->points->surface_probability(k)[0], column.surface_probability[0]) << k;
      in_strips += is_strip ? 1U : 0U;
      // Weights tell in which order they came: within a part they keep it.
      const bool begins = k == begin || k == patch.surface_only_end || k == patch.surface_end || k == patch.strip_end;
      EXPECT_TRUE(begins || s->points->at.weight[k] > s->points->at.weight[k - 1]) << k;
    }
  });
  return in_strips;
}

TEST(WallPoints, EachIsWhereItsColumnBelongs) {
  Sorted s(2001);
  test::Placed<StripProfile> strips = strips_every_metre();
  for (int time = 0; time < 2; ++time) {
    std::vector<std::uint32_t> places(2001);
    s.points->mark_columns(*strips, Span<std::uint32_t>(places.data(), 2001));
    EXPECT_EQ(in_any_order(s.rows()), in_any_order(s.before));
    expect_in_patches(&s);
    EXPECT_GT(expect_in_parts(&s, *strips), 50U);
    const FourFloats behind = s.points->surface_probability(2001);
    for (std::uint32_t lane = 0; lane < kFour; ++lane) EXPECT_EQ(behind[lane], 0.0F);
  }
}

TEST(WallPoints, TheCopyIsOfThoseThatAreMoreLikelyTheSurfaces) {
  Sorted s(2001);
  test::Placed<StripProfile> strips = strips_every_metre();
  std::vector<std::uint32_t> places(2001);
  s.points->mark_columns(*strips, Span<std::uint32_t>(places.data(), 2001));
  s.points->copy_surface();
  std::vector<float> expected, copied;
  for (std::uint32_t k = 0; k < 2001; ++k) {
    if (s.points->probability[k] >= 0.5F) expected.push_back(s.points->at.weight[k]);
  }
  for (std::uint32_t k = 0; k < s.points->surface.count; ++k) copied.push_back(s.points->surface.weight[k]);
  EXPECT_EQ(copied, expected);
  EXPECT_GT(copied.size(), 500U);
  EXPECT_LT(copied.size(), 1900U);
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
