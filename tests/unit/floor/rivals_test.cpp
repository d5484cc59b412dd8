// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: where a ramp rises or falls before the machine and most of what is seen is the ramp, the levels reach to the
// flat floor that it stands on, whichever way it looks; where it stands on the ramp they need not; a floor below a
// table as long as the road is told of as well. What lies beside a floor that is seen to all sides, a ramp or heap
// further on, costs nothing. A floor that is seen on one side only and not near the machine is doubted by itself. A
// tilted plane through the floor's own rough ground is no rival; one that shows ground which the floor leaves out is.
// Does not prove what share of a floor must be seen: next to nothing of it is too little.

#include "engine/floor/rivals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "support/floor_fixture.hpp"

namespace pose_wall {
namespace {

using test::FloorFixture;

// Flat ground behind, and a ramp from a line ahead of the machine on, between walls, as seen by a sensor that looks
// far.
struct Ramp {
  double from_m, slope_rad;
  double flat_from_m, flat_to_m;  // where the flat ground is seen
  double ramp_to_m = 13.0;
  double heading_rad = 0.0;

  double height_at(double x_m) const { return x_m > from_m ? std::tan(slope_rad) * (x_m - from_m) : 0.0; }
  FloorResult floor() const {
    FloorFixture g;
    test::Noise noise(3);
    const auto add = [&](double x, double y, double height) {
      const double c = std::cos(heading_rad), s = std::sin(heading_rad);
      g.add(c * x - s * y, s * x + c * y, height);
    };
    for (double x = -14.0; x <= ramp_to_m; x += 0.1) {
      const bool is_seen = (x >= flat_from_m && x <= flat_to_m) || x >= from_m;
      for (double y = -2.0; y <= 2.0 && is_seen; y += 0.1) add(x, y, height_at(x) + noise.normal(0.005));
      for (double h = 0.0; h <= 3.0; h += 0.1) {
        for (const double y : {-2.5, 2.5}) add(x, y + noise.normal(0.005), height_at(x) + h);
      }
    }
    return g.floor();
  }
};

bool is_ambiguous(const FloorResult& f) {
  return (f.fit.reasons & POSE_WALL_R_FLOOR_AMBIGUOUS) != 0;
}

// A ramp that falls may be refused instead; one that rises has nothing below it.
bool is_refused_for_what_is_below(const FloorResult& f, double slope_rad) {
  EXPECT_TRUE(slope_rad < 0.0 || !f.fit.refused);
  return f.fit.refused;
}

// The level, not more: a bound that reaches further than to the flat floor and some would be of no use.
void expect_reaches_upright(const FloorResult& f) {
  const RollPitch angles = roll_pitch_of_up(f.fit.plane.n);
  const double tilt_rad = tilt_of_up(f.fit.plane.n);
  EXPECT_TRUE(is_ambiguous(f));
  EXPECT_GE(f.roll.bound_rad.sum(), std::fabs(angles.roll_rad));
  EXPECT_GE(f.pitch.bound_rad.sum(), std::fabs(angles.pitch_rad));
  EXPECT_LE(std::hypot(f.roll.bound_rad.sum(), f.pitch.bound_rad.sum()), 2.5 * tilt_rad + 0.1);
}

TEST(FloorBeside, BeforeARampTheLevelsReachToTheFlatFloor) {
  for (const double slope_rad : {0.12, 0.2, -0.12, -0.2}) {
    for (const double heading_rad : {0.0, 0.8, 1.57, 3.0}) {
      SCOPED_TRACE(::testing::Message() << slope_rad << " seen from " << heading_rad);
      const FloorResult f = Ramp{2.5, slope_rad, -9.0, -5.5, 13.0, heading_rad}.floor();
      if (is_refused_for_what_is_below(f, slope_rad)) continue;
      ASSERT_GT(tilt_of_up(f.fit.plane.n), 0.1) << "the ramp shows more";
      expect_reaches_upright(f);
    }
  }
}

// Flat ground far behind lies high over the ramp that is prolonged, and where the ramp falls much lies below it.
TEST(FloorBeside, AlsoWhereLittleOfTheFlatFloorIsSeenFarBehind) {
  for (const double slope_rad : {0.16, 0.2, -0.09, -0.16}) {
    for (const auto& [from_m, to_m] : {std::pair{-9.0, -7.0}, std::pair{-9.0, -8.0}, std::pair{-12.0, -10.5}}) {
      SCOPED_TRACE(::testing::Message() << slope_rad << " flat from " << from_m << " to " << to_m);
      const FloorResult f = Ramp{2.5, slope_rad, from_m, to_m}.floor();
      if (is_refused_for_what_is_below(f, slope_rad)) continue;
      ASSERT_GT(tilt_of_up(f.fit.plane.n), 0.05) << "the ramp shows more";
      expect_reaches_upright(f);
    }
  }
}

// Levelled by no fit: which of two planes carries the machine, whatever a choice before would have said of them.
struct TwoPlanes {
  double other_slope_rad = 0.0, line_m = 0.0;  // the other one rises or falls from a line on, along x
  double other_height_m = 0.0;                 // or lies higher or lower all over
  double other_from_m = -9.0, other_to_m = -5.0;
  double floor_from_m = 3.0, floor_to_m = 9.0;

  double other_at(double x_m) const { return other_height_m + std::tan(other_slope_rad) * (x_m - line_m); }
  FloorResult reached() const {
    FloorFixture g;
    test::Noise noise(3);
    for (double x = floor_from_m; x <= floor_to_m; x += 0.1) {
      for (double y = -2.0; y <= 2.0; y += 0.1) g.add(x, y, noise.normal(0.005));
    }
    for (double x = other_from_m; x <= other_to_m; x += 0.1) {
      for (double y = -2.0; y <= 2.0; y += 0.1) g.add(x, y, other_at(x) + noise.normal(0.005));
    }
    return reach_to_what_is_beside(&g);
  }

  static FloorResult reach_to_what_is_beside(FloorFixture* g) {
    const BoundedPoints& points = g->points().set();
    test::Placed<FloorScratch> scratch(points.capacity());
    scratch->grid.find_open(points, 15.0, 0.0, scratch->low, &scratch->open_base);
    FloorResult floor;
    floor.fit.plane = {Eigen::Vector3d::UnitZ(), test::kFloorBelow_m};
    Random random(1);
    reach_to_floors_beside(g->scene(), &random, scratch.get(), &floor);
    return floor;
  }
};

// A steep plane that is prolonged behind the machine meets the roof there; that is no floor to stand on.
TEST(FloorBeside, ARoofThatTheProlongedPlaneMeetsIsNoFloor) {
  for (const bool has_roof : {false, true}) {
    FloorFixture g;
    test::Noise noise(3);
    constexpr double kSlope = -0.25;                  // falls ahead
    const double roof_m = 2.0 - test::kFloorBelow_m;  // so high above the base's origin
    for (double y = -2.0; y <= 2.0; y += 0.1) {
      for (double x = 2.0; x <= 9.0; x += 0.1) g.add(x, y, kSlope * (x - 2.0) + noise.normal(0.005));
      for (double x = -6.0; x <= -4.0; x += 0.1) g.add(x, y, noise.normal(0.005));
      for (double x = -12.0; x <= -3.0 && has_roof; x += 0.1) g.add(x, y, test::kFloorBelow_m + roof_m);
    }
    const BoundedPoints& points = g.points().set();
    test::Placed<FloorScratch> scratch(points.capacity());
    scratch->grid.find_open(points, 15.0, 0.0, scratch->low, &scratch->open_base);
    FloorResult floor;
    const Eigen::Vector3d n = Eigen::Vector3d(-kSlope, 0.0, 1.0).normalized();
    floor.fit.plane = {n, -n.dot(Eigen::Vector3d(2.0, 0.0, -test::kFloorBelow_m))};
    Random random(1);
    reach_to_floors_beside(g.scene(), &random, scratch.get(), &floor);
    EXPECT_TRUE(is_ambiguous(floor)) << (has_roof ? "below a roof" : "without");
  }
}

// Both ways round: the floor is seen ahead, the other one behind a line.
TEST(FloorBeside, TheSideOfTheLineTellsOnWhichOfTwoPlanesTheMachineStands) {
  for (const double slope_rad : {-0.12, 0.12}) {  // behind the line that is up, and down
    SCOPED_TRACE(slope_rad);
    const FloorResult on_other = TwoPlanes{slope_rad, 2.0}.reached();
    const FloorResult on_floor = TwoPlanes{slope_rad, -3.0, 0.0, -12.0, -8.0}.reached();
    EXPECT_TRUE(is_ambiguous(on_other));
    EXPECT_GE(on_other.pitch.bound_rad.sum(), 0.12 + 0.02) << "the other plane, and some for how well it is known";
    EXPECT_LT(on_other.pitch.bound_rad.sum(), 0.25);
    EXPECT_LT(on_other.roll.bound_rad.sum(), 0.05);
    EXPECT_FALSE(is_ambiguous(on_floor));
    EXPECT_EQ(on_floor.pitch.bound_rad.sum(), 0.0);
  }
}

TEST(FloorBeside, APlaneAllOverBelowMayCarryTheMachineOneAboveMayNot) {
  EXPECT_TRUE(is_ambiguous(TwoPlanes{0.05, 0.0, -0.8}.reached()));
  EXPECT_FALSE(is_ambiguous(TwoPlanes{0.05, 0.0, 0.8}.reached()));
}

// The floor begins 3 m ahead, and as near to its plane lies other ground behind: the machine may stand on either.
TEST(FloorBeside, NearGroundSpeaksForTheFloorOnlyWhereNothingElseIsSeen) {
  for (const double height_m : {-0.3, -0.2, 0.2, 0.3}) {
    const FloorResult floor = TwoPlanes{0.0, 0.0, height_m}.reached();
    EXPECT_TRUE(is_ambiguous(floor)) << height_m;
    EXPECT_GT(floor.pitch.bound_rad.sum(), 0.1) << height_m;
    EXPECT_GT(floor.roll.bound_rad.sum(), 0.1) << height_m;
  }
  TwoPlanes alone;
  alone.other_to_m = alone.other_from_m - 1.0;  // nothing
  EXPECT_FALSE(is_ambiguous(alone.reached()));
}

TEST(FloorBeside, OnAFloorThatIsSeenToBothSidesTheMachineStands) {
  TwoPlanes planes{0.0, 0.0, -0.8, -14.0, -10.0};
  EXPECT_TRUE(is_ambiguous(planes.reached()));
  planes.floor_from_m = -4.5;
  EXPECT_FALSE(is_ambiguous(planes.reached()));
}

// Seen through the floor, whichever side it is seen on.
TEST(FloorBeside, AReflectionInTheFloorCarriesNothing) {
  for (const bool is_reflected : {true, false}) {
    FloorFixture g;
    test::Noise noise(5);
    for (double x = 3.0; x <= 9.0; x += 0.1) {
      for (double y = -2.0; y <= 2.0; y += 0.1) g.add(x, y, noise.normal(0.005));
    }
    const double from_m = is_reflected ? 6.0 : -9.0;
    for (double x = from_m; x <= from_m + 3.0; x += 0.1) {
      for (double y = -1.0; y <= 1.0; y += 0.1) g.add(x, y, -1.2 + noise.normal(0.005));
    }
    EXPECT_EQ(is_ambiguous(TwoPlanes::reach_to_what_is_beside(&g)), !is_reflected);
  }
}

// Flat ground alone, so that nothing beside it can be the reason.
FloorResult reached_on(std::initializer_list<FloorFixture::Area> seen, const char* roi_radius_m = "3") {
  FloorFixture g({{"ground_roi_radius", roi_radius_m}});
  for (const FloorFixture::Area& area : seen) g.add_level(area, 0.0);
  return TwoPlanes::reach_to_what_is_beside(&g);
}

void expect_may_be_a_ramp(const FloorResult& f) {
  constexpr double kAsTheRampsWere_rad = 0.082;  // 4.7 degrees, on a hard campaign
  EXPECT_TRUE(is_ambiguous(f));
  EXPECT_GT(f.roll.bound_rad.sum(), 2.0 * kAsTheRampsWere_rad);
  EXPECT_GT(f.pitch.bound_rad.sum(), 2.0 * kAsTheRampsWere_rad);
}

void expect_carries_the_machine(const FloorResult& f) {
  EXPECT_FALSE(is_ambiguous(f));
  EXPECT_EQ(f.roll.bound_rad.sum(), 0.0);
  EXPECT_EQ(f.pitch.bound_rad.sum(), 0.0);
}

TEST(FloorUnseen, SeenAheadOnlyAndNotNearItMayBeARamp) {
  expect_may_be_a_ramp(reached_on({{5.0, 12.0, -2.0, 2.0}}));
  expect_may_be_a_ramp(reached_on({{-12.0, -5.0, -2.0, 2.0}}));
  expect_may_be_a_ramp(reached_on({{-2.0, 2.0, 5.0, 12.0}}));
  expect_may_be_a_ramp(reached_on({}));
}

TEST(FloorUnseen, AFloorNearTheMachineCarriesIt) {
  expect_carries_the_machine(reached_on({{2.5, 12.0, -2.0, 2.0}}));
}

// A ramp is no nearer because the floor is searched further out.
TEST(FloorUnseen, NearIsTheSameWhateverTheSearch) {
  for (const char* const roi_radius_m : {"1.5", "3", "8"}) {
    expect_may_be_a_ramp(reached_on({{5.0, 12.0, -2.0, 2.0}}, roi_radius_m));
    expect_carries_the_machine(reached_on({{2.5, 12.0, -2.0, 2.0}}, roi_radius_m));
  }
}

TEST(FloorUnseen, AFloorOnBothSidesCarriesTheMachineFromFarAsWell) {
  expect_carries_the_machine(reached_on({{5.0, 12.0, -2.0, 2.0}, {-12.0, -5.0, -2.0, 2.0}}));
}

// A plane that is prolonged meets a few points of walls on its other side, and near the machine.
TEST(FloorUnseen, AFewPointsOfOtherThingsAreNoFloor) {
  expect_may_be_a_ramp(
      reached_on({{5.0, 12.0, -2.0, 2.0}, {-6.0, -5.6, -0.5, 0.5}, {2.0, 2.5, 1.5, 2.0}, {-2.5, -2.0, 1.5, 2.0}}));
}

TEST(FloorBeside, AFloorToAllSidesIsNotDoubtedForARampFurtherOn) {
  const FloorResult f = Ramp{5.0, 0.2, -13.0, 5.0, 9.0}.floor();
  ASSERT_TRUE(f.fit.found && !f.fit.refused);
  EXPECT_LT(tilt_of_up(f.fit.plane.n), 0.01);
  EXPECT_FALSE(is_ambiguous(f));
  EXPECT_LT(std::max(f.roll.bound_rad.sum(), f.pitch.bound_rad.sum()), 0.03);
}

// The floor's fit, level, and a plane through its middle that rises to the left. Both as weighed candidates.
struct TwoReadings {
  FloorFixture g;
  test::Noise noise{7};
  Plane rival;

  explicit TwoReadings(double rise_rad) {
    rival.n = Eigen::Vector3d(0.0, -std::sin(rise_rad), std::cos(rise_rad));
    rival.d = std::cos(rise_rad) * test::kFloorBelow_m;
  }
  double rise_at(double y_m) const { return -rival.n.y() / rival.n.z() * y_m; }
  // Ground of so much roughness; beyond a line it may follow the other plane.
  void add_ground(double rough_m, double follows_rival_from_y_m, double half_length_m = 5.0) {
    for (double x = -half_length_m; x <= half_length_m; x += 0.1) {
      for (double y = -3.0; y <= 3.0; y += 0.1) {
        const double height_m = y >= follows_rival_from_y_m ? rise_at(y) : 0.0;
        g.add(x, y, height_m + noise.uniform(-rough_m, rough_m));
      }
    }
  }
  // fitted: the floor's fit; level unless it wandered off. much_below: what is seen below the rival shows that it is no
  // floor.
  FloorResult reached(const Plane* fitted = nullptr, bool much_below = false) {
    const BoundedPoints& points = g.points().set();
    test::Placed<FloorScratch> scratch(points.capacity());
    scratch->grid.find_open(points, 15.0, 0.0, scratch->low, &scratch->open_base);
    const Axes axes{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};
    const double thresh_m = g.settings().ground_ransac_thresh;
    FloorCandidates candidates;
    for (const Plane& plane : {Plane{Eigen::Vector3d::UnitZ(), test::kFloorBelow_m}, rival}) {
      scratch->grid.mark(scratch->open_base, plane, thresh_m);
      candidates.item[candidates.count++] = {plane, scratch->grid.evidence(axes), false};
    }
    candidates.item[1].much_below = much_below;
    const double share = candidates.item[1].evidence.score_m2 / candidates.item[0].evidence.score_m2;
    EXPECT_GT(share, 0.5) << "else it is no rival anyway";
    EXPECT_LT(share, 1.0);
    FloorResult floor;
    floor.fit.found = true;
    floor.fit.plane = fitted != nullptr ? *fitted : candidates.item[0].plane;
    reach_to_rivals(g.scene(), scratch->open_base, candidates, scratch.get(), &floor);
    return floor;
  }
};

TEST(FloorRivals, ATiltedPlaneThroughTheFloorsOwnRoughGroundIsNone) {
  TwoReadings readings(0.045);
  readings.add_ground(0.035, 100.0);
  const FloorResult f = readings.reached();
  EXPECT_FALSE(is_ambiguous(f));
  EXPECT_EQ(f.roll.bound_rad.sum(), 0.0);
}

TEST(FloorRivals, APlaneThatShowsGroundTheFloorLeavesOutIsOne) {
  for (const double rise_rad : {0.1, -0.1, 0.2}) {
    TwoReadings readings(rise_rad);
    readings.add_ground(0.01, 0.7);
    const FloorResult f = readings.reached();
    EXPECT_TRUE(is_ambiguous(f)) << rise_rad;
    EXPECT_GE(f.roll.bound_rad.sum(), std::fabs(rise_rad)) << rise_rad;
    EXPECT_LE(f.roll.bound_rad.sum(), std::fabs(rise_rad) + 0.01) << rise_rad << ": half a degree for the rival itself";
  }
}

// On a small floor a few centimetres are many degrees.
TEST(FloorRivals, OnASmallFloorItIsOne) {
  TwoReadings readings(0.045);
  readings.add_ground(0.035, 100.0, 0.3);
  EXPECT_TRUE(is_ambiguous(readings.reached()));
}

// What is no floor shows how much open ground a plane gets in this scene without being one.
TEST(FloorRivals, APlaneThatIsNoFloorSpeaksAgainstASmallOneAlone) {
  for (const bool is_small : {true, false}) {
    TwoReadings readings(0.1);
    readings.add_ground(0.01, 0.7, is_small ? 0.6 : 5.0);
    EXPECT_EQ(is_ambiguous(readings.reached(nullptr, true)), is_small);
  }
}

TEST(FloorRivals, AFitThatWanderedOffToTheRivalExcludesNothing) {
  TwoReadings readings(0.1);
  readings.add_ground(0.01, 0.7);
  EXPECT_TRUE(is_ambiguous(readings.reached(&readings.rival)));
}

// A break of two degrees with ground on both sides: the planes share what lies about the line where they meet.
TEST(FloorRivals, GroundBeyondABreakIsOneThoughBothPlanesShareTheMiddle) {
  TwoReadings readings(0.035);
  readings.add_ground(0.01, 0.5);
  EXPECT_TRUE(is_ambiguous(readings.reached()));
}

// A few stray points of a wall's foot on it do not make it a floor.
TEST(FloorRivals, StraysFurtherOffAreNoGround) {
  TwoReadings readings(0.045);
  readings.add_ground(0.035, 100.0);
  for (double x = -5.0; x <= 5.0; x += 2.5) readings.g.add(x, 4.0, readings.rise_at(4.0));
  EXPECT_FALSE(is_ambiguous(readings.reached()));
}

}  // namespace
}  // namespace pose_wall
