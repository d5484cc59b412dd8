// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: no plane across the machine is solid over more than the bound says, whatever is seen and at any limits; the
// bound is low enough that in a road nothing need be looked for, and high enough that in a junction it is.

#include "engine/walls/choose/across.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/math/elementary.hpp"
#include "support/band_fixture.hpp"

namespace pose_wall {
namespace {

using test::BandFixture;
using test::Noise;

double area_of(const WallScene& scene, const Plane& plane, WallGrid* grid) {
  const Eigen::Vector3d along(-plane.n.y(), plane.n.x(), 0.0);
  mark_wall(scene, plane, along.normalized(), MarkWidth::kThreshold, grid);
  return grid->evidence().area_m2;
}

// Ahead or behind, turned and leaning as far as may be.
Plane plane_across(const Settings& settings, Noise* noise) {
  const double turned_most = radians(settings.yaw_max_deg + kRefineSlack_deg);
  const double lean_most = radians(settings.wall_lean_max_deg);
  const double ahead = noise->uniform(-1.0, 1.0) > 0.0 ? -1.0 : 1.0;  // normals point to the machine
  const double turned = noise->uniform(-turned_most, turned_most), lean = noise->uniform(-lean_most, lean_most);
  Plane plane;
  plane.n =
      Eigen::Vector3d(ahead * std::cos(turned) * std::cos(lean), std::sin(turned) * std::cos(lean), std::sin(lean));
  plane.d = noise->uniform(0.5, 20.0);
  return plane;
}

double most_found(BandFixture* band, int draws, Noise* noise) {
  test::Placed<WallGrid> grid;
  const WallScene scene = band->scene();
  double most_m2 = 0.0;
  for (int draw = 0; draw < draws; ++draw) {
    most_m2 = std::max(most_m2, area_of(scene, plane_across(band->settings(), noise), grid.get()));
  }
  return most_m2;
}

// Points in the air, as thick as can be, over a road of any width, a face across it, a crosscut and what is further out
// than the bins go.
void fill(int seed, Noise* noise, BandFixture* band) {
  const double half_m = noise->uniform(0.5, 12.0);
  const int points = static_cast<int>(noise->uniform(0.0, 60000.0));
  for (int k = 0; k < points; ++k) {
    const double y_m = noise->uniform(-half_m, half_m);
    if (seed % 2 == 0 && std::fabs(y_m) > 1.0 && std::fabs(y_m) < 3.0) continue;  // empty places between full ones
    band->points().add(noise->uniform(-20.0, 20.0), y_m, test::kFloorZ_m + noise->uniform(0.3, 2.4));
  }
  band->add_face(noise->uniform(2.0, 15.0), -half_m, half_m);
  if (seed % 3 == 0) band->add_face(-5.0, 3.0, 60.0);
}

TEST(WallsAcross, NoPlaneShowsMoreThanTheBound) {
  const char* const corners[][3] = {{"45", "20", "0.1"}, {"5", "1", "0.02"}, {"50", "40", "0.5"}, {"50", "1", "0.3"}};
  int seed = 0;
  for (const auto& corner : corners) {
    for (int run = 0; run < 6; ++run) {
      Noise noise(static_cast<std::uint32_t>(++seed));
      BandFixture band(
          {{"yaw_max_deg", corner[0]}, {"wall_lean_max_deg", corner[1]}, {"wall_ransac_thresh", corner[2]}});
      fill(seed, &noise, &band);
      const double found_m2 = most_found(&band, 200, &noise), bound_m2 = most_area_across_m2(band.scene());
      EXPECT_LE(found_m2, bound_m2) << "seed " << seed;
      EXPECT_GT(found_m2, 0.0) << "seed " << seed;
    }
  }
}

TEST(WallsAcross, TheBoundIsReachedByHalf) {
  Noise noise(1);
  BandFixture band({{"wall_ransac_thresh", "0.1"}});
  for (int k = 0; k < 90000; ++k) {
    band.points().add(noise.uniform(-20.0, 20.0), noise.uniform(-3.0, 3.0), test::kFloorZ_m + noise.uniform(0.3, 2.4));
  }
  EXPECT_GT(most_found(&band, 2000, &noise), 0.5 * most_area_across_m2(band.scene()));
}

TEST(WallsAcross, FewPointsFillFewCells) {
  BandFixture band;
  for (int k = 0; k < 10; ++k) band.points().add(5.0, 0.4 * k - 2.0, 0.0);
  EXPECT_LE(most_area_across_m2(band.scene()), 5 * 0.5 * 0.31) << "two points at least to a cell";
  EXPECT_EQ(most_area_across_m2(BandFixture().scene()), 0.0);
}

WallChoice chosen_of(double score_m2, const WallCandidate* left) {
  WallChoice choice;
  choice.side[0] = left;
  choice.score_m2 = score_m2;
  return choice;
}

const Settings kSettings = test::settings_with({});

TEST(WallsAcross, InARoadNothingNeedBeLookedFor) {
  BandFixture band;
  band.add_wall(2.5, {-20.0, 20.0, 0.3, 2.4});
  band.add_wall(-2.5, {-20.0, 20.0, 0.3, 2.4});
  band.add_face(20.0, -2.5, 2.5);
  const WallCandidate wall;
  EXPECT_FALSE(
      may_stand_across(2.0 * most_area_across_m2(band.scene()), chosen_of(2.0 * 40.0 * 2.1, &wall), kSettings));
  EXPECT_TRUE(may_stand_across(2.0 * most_area_across_m2(band.scene()), chosen_of(10.0, &wall), kSettings))
      << "short walls may be faces";
}

TEST(WallsAcross, AcrossARoadItIs) {
  BandFixture band;
  band.add_wall(4.0, {-2.0, 2.0, 0.3, 2.4});
  band.add_wall(-4.0, {-2.0, 2.0, 0.3, 2.4});
  band.add_face(2.5, -12.0, 12.0);
  band.add_face(-2.5, -12.0, 12.0);
  const WallCandidate wall;
  EXPECT_TRUE(may_stand_across(2.0 * most_area_across_m2(band.scene()), chosen_of(2.0 * 4.0 * 2.1, &wall), kSettings));
}

TEST(WallsAcross, WhatIsAheadAndTheMostBehindMayBeTooLittle) {
  const WallCandidate wall;
  EXPECT_TRUE(may_stand_across(10.0 + 31.0, chosen_of(40.0, &wall), kSettings));
  EXPECT_FALSE(may_stand_across(10.0 + 30.0, chosen_of(40.0, &wall), kSettings)) << "as much is no better";
}

// Directions from behind may show something ahead where its own draws have found nothing.
TEST(WallsAcross, BehindIsDrawnWhereItMightTellOfMoreAhead) {
  const WallCandidate wall;
  const WallChoice choice = chosen_of(40.0, &wall);
  EXPECT_FALSE(is_behind_to_be_drawn(10.0, 23.9, choice, kSettings));
  EXPECT_TRUE(is_behind_to_be_drawn(10.0, 24.1, choice, kSettings));
  EXPECT_FALSE(is_behind_to_be_drawn(0.0, 33.9, choice, kSettings));
  EXPECT_TRUE(is_behind_to_be_drawn(0.0, 34.1, choice, kSettings));
}

std::uint32_t reasons_between(bool face_behind) {
  BandFixture band({{"yaw_max_deg", "5"}});
  for (const double y_m : {4.0, -4.0}) band.add_wall(y_m, {-3.0, 3.0, 0.3, 2.4});
  band.add_face(4.0, -3.5, 3.5);
  if (face_behind) band.add_face(-4.0, -3.5, 3.5);
  test::Placed<WallsScratch> scratch(band.points().set().capacity());
  Random random(1);
  const Plane* const nothing[2] = {nullptr, nullptr};
  const WallsResult found = find_walls(band.scene(), nothing, &random, scratch.get());
  return found.side[0].fit.reasons & found.side[1].fit.reasons;
}

// Each face shows less than the two sides do, and so would the most that could stand there; both together show more.
TEST(WallsAcross, WhatIsBehindIsWeighedWhereItMayTellWithWhatIsAhead) {
  EXPECT_NE(reasons_between(true) & POSE_WALL_R_CROSS_ROAD, 0U);
  EXPECT_EQ(reasons_between(false) & POSE_WALL_R_CROSS_ROAD, 0U);
}

TEST(WallsAcross, WhereNothingIsChosenWhatStandsAcrossMayTellWhy) {
  EXPECT_TRUE(may_stand_across(0.0, WallChoice{}, kSettings));
}

TEST(WallsAcross, WhatMayTurnFurtherCrossesTheRoadOnMoreOfItsLength) {
  BandFixture narrow({{"yaw_max_deg", "5"}}), wide({{"yaw_max_deg", "50"}});
  for (BandFixture* band : {&narrow, &wide}) band->add_face(5.0, -2.5, 2.5);
  EXPECT_GT(most_area_across_m2(wide.scene()), 1.3 * most_area_across_m2(narrow.scene()));
}

}  // namespace
}  // namespace pose_wall
