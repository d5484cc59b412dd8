// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the judge's own truth has the signs and the lengths that the specification's words demand, for every forward
// axis; its rays end on the surfaces that this truth is of. So a fault of the judge is told from one of the engine.

#include <gtest/gtest.h>

#include <cmath>

#include "judge/court.hpp"

namespace pose_wall::judge {
namespace {

// A square road, 5 m wide and 3 m high, without anything in it.
Road square_road() {
  Road road;
  road.floor = {Vector3d::UnitZ(), 0.0};
  road.left = {-Vector3d::UnitY(), 2.5};
  road.right = {Vector3d::UnitY(), 2.5};
  return road;
}

Machine machine_along(const char* axis) {
  const Road road = square_road();
  for (std::uint64_t seed = 0;; ++seed) {
    Draw draw(seed);
    Machine machine = draw_machine(road, Hung::kUpright, &draw);
    if (machine.forward_axis == axis && machine.s_front_m == 2.0) return machine;
  }
}

Truth truth_at(const Stance& stance, const Machine& machine) {
  const Road road = square_road();
  return truth_of(road, machine, stance.pose(road, machine));
}

class JudgesTruth : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(ForwardAxes, JudgesTruth, testing::Values("+X", "-X", "+Y", "-Y"));

TEST_P(JudgesTruth, AMachineTurnedLeftHasNegativeYawAndItsNoseNearTheLeftWall) {
  Stance stance;
  stance.y_m = 0.3;
  stance.turned_left_rad = 0.1;
  const Truth truth = truth_at(stance, machine_along(GetParam()));
  EXPECT_NEAR(truth.low[POSE_WALL_YAW], -0.1, 1e-12);
  EXPECT_NEAR(truth.low[POSE_WALL_ROLL], 0.0, 1e-12);
  EXPECT_NEAR(truth.low[POSE_WALL_PITCH], 0.0, 1e-12);
  EXPECT_NEAR(truth.low[POSE_WALL_D_LF], 2.2 - 2.0 * std::sin(0.1), 1e-12);
  EXPECT_NEAR(truth.low[POSE_WALL_D_LB], 2.2 + 2.0 * std::sin(0.1), 1e-12);
  EXPECT_NEAR(truth.low[POSE_WALL_D_RF], 2.8 + 2.0 * std::sin(0.1), 1e-12);
  EXPECT_NEAR(truth.low[POSE_WALL_D_RB], 2.8 - 2.0 * std::sin(0.1), 1e-12);
}

TEST_P(JudgesTruth, RollAndPitchAreAboutBaseXAndYWhateverIsForward) {
  const std::string axis = GetParam();
  const double sign = axis[0] == '+' ? 1.0 : -1.0;
  Stance nose_down, right_down;
  nose_down.nose_down_rad = right_down.right_down_rad = 0.1;
  const Truth nose = truth_at(nose_down, machine_along(GetParam()));
  const Truth right = truth_at(right_down, machine_along(GetParam()));
  const int driver_pitch = axis[1] == 'X' ? POSE_WALL_PITCH : POSE_WALL_ROLL;
  const int driver_roll = axis[1] == 'X' ? POSE_WALL_ROLL : POSE_WALL_PITCH;
  // Forward +Y: base X points to the right, and a turn about it that raises +Y is positive: nose up.
  EXPECT_NEAR(nose.error(driver_pitch, (axis[1] == 'X' ? sign : -sign) * 0.1), 0.0, 1e-12);
  EXPECT_NEAR(right.error(driver_roll, sign * 0.1), 0.0, 1e-12);
  EXPECT_NEAR(nose.error(driver_roll, 0.0), 0.0, 1e-12);
  EXPECT_NEAR(right.error(driver_pitch, 0.0), 0.0, 1e-12);
}

// How many of 400 rays of each of 50 roads end on a plane; none may end behind it.
int rays_that_end_on(Plane Road::*plane) {
  int on_plane = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Road road = draw_road(seed, Furnishing::kQuiet);
    Draw draw(seed);
    for (int ray = 0; ray < 400; ++ray) {
      const Vector3d way = Vector3d(draw.normal(), draw.normal(), draw.normal()).normalized();
      const Ray from = {Vector3d(0.1, -0.2, 1.2), way};
      const double hit_m = range_m(road, {}, from, &draw);
      if (hit_m > 40.0) continue;  // behind the machine the walls end there
      const double before_m = (road.*plane).distance_m(from.origin_m + hit_m * way);
      EXPECT_GT(before_m, -1e-6);
      on_plane += std::abs(before_m) < 1e-6 ? 1 : 0;
    }
  }
  return on_plane;
}

TEST(JudgesRoads, RaysOfAQuietRoadEndOnItsTruePlanes) {
  // Of 20,000 rays; each of the three fills an eighth of the sphere at least.
  EXPECT_GT(rays_that_end_on(&Road::floor), 2500);
  EXPECT_GT(rays_that_end_on(&Road::left), 2500);
  EXPECT_GT(rays_that_end_on(&Road::right), 2500);
}

TEST(JudgesRoads, RockHasTheRootMeanSquareThatWasAskedForAndZeroMean) {
  Draw draw(1);
  double sum_m = 0.0, squares_m2 = 0.0;
  constexpr int kRocks = 100, kPlaces = 1000;
  for (int k = 0; k < kRocks; ++k) {
    const Rock rock(&draw, 0.01, 2.0, 0.7);
    for (int place = 0; place < kPlaces; ++place) {
      const double height_m = rock.height_m(draw.uniform(-20.0, 20.0), draw.uniform(0.0, 3.0));
      sum_m += height_m;
      squares_m2 += height_m * height_m;
    }
  }
  constexpr int kAll = kRocks * kPlaces;
  // Some 30 waves fit into each of 100 places of the longest wave: the mean scatters by 0.01 / sqrt(3000).
  EXPECT_NEAR(sum_m / kAll, 0.0, 5.0 * 0.01 / std::sqrt(3000.0));
  EXPECT_NEAR(std::sqrt(squares_m2 / kAll), 0.01, 0.001);
}

}  // namespace
}  // namespace pose_wall::judge
