// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "pose_wall_planar_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include "base/containers/arena.hpp"
#include "drawn_roads.hpp"
#include "planar/route/planner.hpp"
#include "route_truth.hpp"
#include "trials/trial_task.hpp"

namespace {

using namespace pose_wall::test;

pose_wall_planar_plan_settings small_plan() {
  pose_wall_planar_plan_settings settings;
  EXPECT_EQ(pose_wall_planar_plan_settings_init(&settings), POSE_WALL_OK);
  settings.width_max = settings.height_max = 800;
  settings.places_max = 30000;
  settings.open_max = 100000;
  return settings;
}

// Between two poses of a route: a straight stretch, an arc, or a turn on the spot.
struct Stretch {
  double along_m, turn_rad;
};

Stretch stretch_of(const pose_wall_planar_path_pose& a, const pose_wall_planar_path_pose& b) {
  const double length = b.along_m - a.along_m;
  if (b.drive != 0) return {b.drive * length, b.curvature_1_m * b.drive * length};
  return {0.0, turned(a.pose.yaw_rad, b.pose.yaw_rad)};
}

// Every pose follows from the one before, the numbers of the result are those of its poses, and all on the way is free.
void expect_true_route(const DrawnGrid& grid, const pose_wall_planar_plan_settings& s, const TrialPlanner& planner,
                       const pose_wall_planar_plan_result& result, const pose_wall_planar_pose& start,
                       const pose_wall_planar_pose& goal) {
  ASSERT_GE(result.poses, 1U);
  const pose_wall_planar_path_pose& first = planner.poses[0];
  const pose_wall_planar_path_pose& last = planner.poses[result.poses - 1];
  EXPECT_NEAR(first.pose.x_m, start.x_m, 1e-9);
  EXPECT_NEAR(turned(first.pose.yaw_rad, start.yaw_rad), 0.0, 1e-9);
  EXPECT_NEAR(last.pose.x_m, goal.x_m, 1e-6);
  EXPECT_NEAR(last.pose.y_m, goal.y_m, 1e-6);
  EXPECT_NEAR(turned(last.pose.yaw_rad, goal.yaw_rad), 0.0, 1e-3);
  EXPECT_NEAR(last.along_m, result.length_m, 1e-9);
  const Rectangle body = rectangle_of(s).grown(-1e-5);
  double cost = 0.0, turning = 0.0;
  std::uint32_t cusps = 0;
  std::int32_t gear = 0;
  for (std::uint32_t k = 1; k < result.poses; ++k) {
    const pose_wall_planar_path_pose &a = planner.poses[k - 1], &b = planner.poses[k];
    const Stretch way = stretch_of(a, b);
    const pose_wall::planar::Pose2 from{a.pose.x_m, a.pose.y_m, a.pose.yaw_rad};
    const int steps = 1 + static_cast<int>(std::abs(way.along_m) / 0.05 + std::abs(way.turn_rad) / 0.02);
    for (int i = 1; i <= steps; ++i) {
      const double part = static_cast<double>(i) / steps;
      const auto at = pose_wall::planar::route::along_arc(from, part * way.along_m, part * way.turn_rad);
      ASSERT_TRUE(is_rectangle_free(grid.view(), s.occupied_from, body, at.x_m, at.y_m, at.yaw_rad)) << "pose " << k;
    }
    const auto end = pose_wall::planar::route::along_arc(from, way.along_m, way.turn_rad);
    ASSERT_NEAR(end.x_m, b.pose.x_m, 1e-6) << k;
    ASSERT_NEAR(end.y_m, b.pose.y_m, 1e-6) << k;
    ASSERT_NEAR(turned(end.yaw_rad, b.pose.yaw_rad), 0.0, 1e-3) << k;
    cost += std::abs(way.along_m) * (way.along_m < 0.0 ? s.reverse_cost : 1.0);
    turning += std::abs(way.turn_rad);
    if (b.drive * gear < 0) {
      ++cusps;
      EXPECT_NE(a.flags & POSE_WALL_PLANAR_PATH_STOP, 0U) << k;
    }
    const bool is_turn = (b.flags & (POSE_WALL_PLANAR_PATH_TURN_LEFT | POSE_WALL_PLANAR_PATH_TURN_RIGHT)) != 0;
    EXPECT_EQ(is_turn, b.drive == 0) << k;
    if (b.drive != 0) gear = b.drive;
  }
  EXPECT_EQ(cusps, result.cusps);
  EXPECT_NEAR(turning, result.turning_rad, 0.01);
  EXPECT_NEAR(cost + s.turn_cost_m_rad * turning + s.cusp_cost_m * cusps, result.cost_m, 0.02);
  EXPECT_GE(result.bound, 1.0);
  EXPECT_NE(last.flags & POSE_WALL_PLANAR_PATH_STOP, 0U);
}

DrawnGrid drawn_small(std::uint32_t seed) {
  if (seed % 3 == 0) return pose_wall::test::drawn_maze(seed, 40.0);
  if (seed % 3 == 1) return pose_wall::test::drawn_network(seed, 40.0);
  return pose_wall::test::drawn_hall(seed, 40.0, 30);
}

TEST(Plan, RoutesThroughDrawnGridsAreFreeAndTrue) {
  const pose_wall_planar_plan_settings settings = small_plan();
  TrialPlanner planner(settings);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> yaw(-3.1, 3.1);
  int found = 0, asked = 0;
  for (std::uint32_t seed = 0; seed < 60; ++seed) {
    const DrawnGrid grid = drawn_small(seed);
    const std::size_t places = grid.places_xy.size() / 2;
    if (places < 2) continue;
    const Rectangle body = rectangle_of(settings);
    const auto draw = [&] {  // mostly one that fits
      pose_wall_planar_pose pose{};
      for (int k = 0; k < 12; ++k) {
        const std::size_t i = random() % places;
        pose = {grid.places_xy[2 * i], grid.places_xy[2 * i + 1], yaw(random)};
        if (is_rectangle_free(grid.view(), 50, body, pose.x_m, pose.y_m, pose.yaw_rad)) break;
      }
      return pose;
    };
    const pose_wall_planar_pose start = draw(), goal = draw();
    const pose_wall_planar_plan_result result = planner.plan(grid, start, goal);
    const bool fits = is_rectangle_free(grid.view(), 50, body, start.x_m, start.y_m, start.yaw_rad) &&
                      is_rectangle_free(grid.view(), 50, body, goal.x_m, goal.y_m, goal.yaw_rad);
    EXPECT_EQ(fits, result.outcome != POSE_WALL_PLANAR_PLAN_START_BLOCKED &&
                        result.outcome != POSE_WALL_PLANAR_PLAN_GOAL_BLOCKED);
    asked += fits ? 1 : 0;
    if (result.outcome != POSE_WALL_PLANAR_PLAN_FOUND) continue;
    ++found;
    SCOPED_TRACE(seed);
    expect_true_route(grid, settings, planner, result, start, goal);
  }
  EXPECT_GT(found, 25);
  EXPECT_GT(found, asked * 3 / 4);
}

TEST(Plan, AStraightRoadIsDrivenStraight) {
  DrawnGrid grid(40.0, 100);
  grid.box(1.0, 18.0, 39.0, 22.0, 0);
  TrialPlanner planner(small_plan());
  const pose_wall_planar_plan_result ahead = planner.plan(grid, {5.0, 20.0, 0.0}, {35.0, 20.0, 0.0});
  EXPECT_EQ(ahead.outcome, POSE_WALL_PLANAR_PLAN_FOUND);
  EXPECT_NEAR(ahead.length_m, 30.0, 1e-9);
  EXPECT_NEAR(ahead.turning_rad, 0.0, 1e-9);
  EXPECT_EQ(ahead.cusps, 0U);
  const pose_wall_planar_plan_result back = planner.plan(grid, {35.0, 20.0, 0.0}, {5.0, 20.0, 0.0});
  EXPECT_EQ(back.outcome, POSE_WALL_PLANAR_PLAN_FOUND);
  EXPECT_NEAR(back.cost_m, 36.0, 1e-9);
  EXPECT_EQ(planner.poses[1].drive, -1);
}

TEST(Plan, AroundACornerTheLongMachineSwingsAndTheRouteIsNearlyTheShortest) {
  DrawnGrid grid(40.0, 100);
  grid.box(2.0, 4.0, 32.0, 8.4, 0);
  grid.box(27.6, 4.0, 32.0, 38.0, 0);
  const pose_wall_planar_plan_settings settings = small_plan();
  TrialPlanner planner(settings);
  const pose_wall_planar_pose start{6.0, 6.2, 0.0}, goal{29.8, 33.0, 0.5 * 3.14159265};
  const pose_wall_planar_plan_result result = planner.plan(grid, start, goal);
  ASSERT_EQ(result.outcome, POSE_WALL_PLANAR_PLAN_FOUND);
  expect_true_route(grid, settings, planner, result, start, goal);
  EXPECT_LT(result.length_m, 23.8 + 26.8);
  EXPECT_LT(result.turning_rad, 2.2);
}

TEST(Plan, StartIsGoal) {
  const DrawnGrid grid(20.0, 0);
  TrialPlanner planner(small_plan());
  const pose_wall_planar_plan_result result = planner.plan(grid, {8.0, 8.0, 1.0}, {8.0, 8.0, 1.0});
  EXPECT_EQ(result.outcome, POSE_WALL_PLANAR_PLAN_FOUND);
  EXPECT_EQ(result.poses, 1U);
  EXPECT_EQ(result.length_m, 0.0);
  EXPECT_EQ(result.bound, 1.0);
  const pose_wall_planar_plan_result turn = planner.plan(grid, {8.0, 8.0, 1.0}, {8.0, 8.0, -2.0});
  EXPECT_EQ(turn.outcome, POSE_WALL_PLANAR_PLAN_FOUND);
  EXPECT_NEAR(turn.turning_rad, 3.0, 1e-9);
  EXPECT_EQ(turn.spot_turns, 1U);
}

// Pillars of 0.2 m at random places, so near to each other that the machine passes nowhere. Start and goal are clear.
DrawnGrid pillars(double side_m, std::uint32_t seed) {
  DrawnGrid grid(side_m, 0);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> at(0.0, side_m - 0.2);
  for (double drawn = 0.0; drawn < side_m * side_m; ++drawn) {
    const double x_m = at(random), y_m = at(random);
    grid.box(x_m, y_m, x_m + 0.2, y_m + 0.2, 100);
  }
  grid.box(3.0, 3.0, 9.0, 9.0, 0);
  grid.box(side_m - 9.0, side_m - 9.0, side_m - 3.0, side_m - 3.0, 0);
  return grid;
}

// By steps, not by time: the field of the second search looks from each place along 64 headings, once.
TEST(Plan, TheWidestWayIsFoundWithLessWorkThanASearch) {
  pose_wall_planar_plan_settings settings = small_plan();
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    const DrawnGrid grid = pillars(40.0, seed);
    pose_wall::Arena arena(nullptr);
    pose_wall::planar::route::Planner planner;
    planner.lay_out(arena, settings);
    AlignedBlock block(arena.bytes(), Dirt::kRandom);
    pose_wall::Arena placed(block.data());
    planner.lay_out(placed, settings);
    planner.open(settings);
    ASSERT_TRUE(planner.read(grid.view()));
    pose_wall_planar_plan_result result{};
    planner.plan({6.0, 6.0, 0.0}, {34.0, 34.0, 0.0}, {}, &result);
    ASSERT_EQ(result.outcome, POSE_WALL_PLANAR_PLAN_TOO_NARROW) << seed;
    EXPECT_EQ(result.searches, 0U);
    EXPECT_GT(result.width_m, 0.3);
    EXPECT_LT(result.width_m, 1.4);
    const std::uint64_t places = (800 / 2 + 1) * (800 / 2 + 1), coarse = (800 / 5 + 1) * (800 / 5 + 1);
    EXPECT_LE(planner.field_looks(), 2 * 64 * places + 32 * coarse) << seed;
  }
}

TEST(Plan, NoWayLeadsThroughAWallHoweverThin) {
  DrawnGrid wall(40.0, 0);
  wall.box(20.0, 0.0, 20.05, 40.0, 100);  // one cell
  TrialPlanner planner(small_plan());
  EXPECT_EQ(planner.plan(wall, {8.0, 20.0, 0.0}, {32.0, 20.0, 0.0}).outcome, POSE_WALL_PLANAR_PLAN_NOT_CONNECTED);
  DrawnGrid stairs(40.0, 0);  // one cell, aslant: it hangs together by corners only
  for (int k = 0; k < 800; ++k) stairs.cells[static_cast<std::size_t>(k * 800 + k)] = 100;
  EXPECT_EQ(planner.plan(stairs, {30.0, 8.0, 0.0}, {8.0, 30.0, 0.0}).outcome, POSE_WALL_PLANAR_PLAN_NOT_CONNECTED);
  stairs.box(19.8, 19.8, 20.4, 20.4, 0);
  const pose_wall_planar_plan_result gap = planner.plan(stairs, {30.0, 8.0, 0.0}, {8.0, 30.0, 0.0});
  EXPECT_EQ(gap.outcome, POSE_WALL_PLANAR_PLAN_TOO_NARROW);
  EXPECT_NEAR(gap.place.x_m, 20.1, 0.3);
  EXPECT_NEAR(gap.place.y_m, 20.1, 0.3);
}

TEST(Plan, WithoutARouteTheReasonIsGiven) {
  const pose_wall_planar_plan_settings settings = small_plan();
  TrialPlanner planner(settings);
  DrawnGrid wall(40.0, 0);
  wall.box(19.0, 0.0, 21.0, 40.0, 100);
  const pose_wall_planar_pose left{8.0, 20.0, 0.0}, right{32.0, 20.0, 0.0};
  EXPECT_EQ(planner.plan(wall, left, right).outcome, POSE_WALL_PLANAR_PLAN_NOT_CONNECTED);
  EXPECT_EQ(planner.plan(wall, {20.0, 20.0, 0.0}, right).outcome, POSE_WALL_PLANAR_PLAN_START_BLOCKED);
  EXPECT_EQ(planner.plan(wall, left, {20.0, 20.0, 0.0}).outcome, POSE_WALL_PLANAR_PLAN_GOAL_BLOCKED);
  EXPECT_EQ(planner.plan(wall, {9e5, 20.0, 0.0}, right).outcome, POSE_WALL_PLANAR_PLAN_START_BLOCKED);

  // A gap of 1 m is too narrow for 1.2 m and two margins.
  DrawnGrid gap = wall;
  gap.box(18.9, 30.0, 21.1, 31.0, 0);
  const pose_wall_planar_plan_result narrow = planner.plan(gap, left, right);
  EXPECT_EQ(narrow.outcome, POSE_WALL_PLANAR_PLAN_TOO_NARROW);
  EXPECT_NEAR(narrow.place.x_m, 20.0, 1.3);
  EXPECT_NEAR(narrow.place.y_m, 30.5, 0.3);
  EXPECT_NEAR(narrow.width_m, 1.0, 0.11);
  EXPECT_TRUE(std::isnan(narrow.length_m));

  // A road of 1.7 m with a corner: the circle gets round, the machine does not.
  DrawnGrid bend(40.0, 100);
  bend.box(2.0, 4.0, 30.0, 5.7, 0);
  bend.box(28.3, 4.0, 30.0, 30.0, 0);
  const pose_wall_planar_plan_result tight = planner.plan(bend, {6.0, 4.85, 0.0}, {29.15, 25.0, 1.5707963});
  EXPECT_EQ(tight.outcome, POSE_WALL_PLANAR_PLAN_TOO_TIGHT);
  EXPECT_GT(tight.place.x_m, 20.0);

  const DrawnGrid unknown(40.0, -1);
  EXPECT_EQ(planner.plan(unknown, left, right).outcome, POSE_WALL_PLANAR_PLAN_START_BLOCKED);
}

TEST(Plan, LimitsEndTheSearchWithTheirOutcome) {
  DrawnGrid bend(40.0, 100);
  bend.box(2.0, 4.0, 32.0, 8.4, 0);
  bend.box(27.6, 4.0, 32.0, 38.0, 0);
  const pose_wall_planar_pose start{6.0, 6.2, 0.0}, goal{29.8, 33.0, 1.57};
  pose_wall_planar_plan_settings settings = small_plan();
  ASSERT_EQ(TrialPlanner(settings).plan(bend, start, goal).outcome, POSE_WALL_PLANAR_PLAN_FOUND);
  settings.expansions_max = 50;
  EXPECT_EQ(TrialPlanner(settings).plan(bend, start, goal).outcome, POSE_WALL_PLANAR_PLAN_WORK_LIMIT);
  TrialPlanner planner(small_plan());
  planner.poses.resize(3);
  const pose_wall_planar_plan_result result = planner.plan(bend, start, goal);
  EXPECT_EQ(result.outcome, POSE_WALL_PLANAR_PLAN_ROOM_SMALL);
  EXPECT_GT(result.poses, 3U);

  // A hall, and the goal behind a bend that only the circle gets round: all of the hall is searched.
  DrawnGrid hall(40.0, 0);
  hall.box(20.0, 20.0, 40.0, 40.0, 100);
  hall.box(24.0, 24.0, 32.0, 32.0, 0);
  hall.box(21.0, 28.0, 25.0, 29.7, 0);
  hall.box(21.0, 18.0, 22.7, 29.7, 0);
  const pose_wall_planar_pose inside{28.0, 28.0, 0.0};
  settings = small_plan();
  settings.places_max = 1000;
  EXPECT_EQ(TrialPlanner(settings).plan(hall, start, inside).outcome, POSE_WALL_PLANAR_PLAN_LIST_FULL);
}

TEST(Plan, TheSameBitsFromAnyDirtAndAfterOtherPlans) {
  const DrawnGrid grid = pose_wall::test::drawn_network(4, 40.0), other = pose_wall::test::drawn_hall(5, 40.0, 30);
  const pose_wall_planar_plan_settings settings = small_plan();
  const pose_wall_planar_grid view = grid.view(-3.0, 7.0), other_view = other.view();
  const auto at = [&](std::size_t i) {
    return pose_wall_planar_pose{grid.places_xy[2 * i] - 3.0, grid.places_xy[2 * i + 1] + 7.0, 0.4};
  };
  const pose_wall_planar_pose start = at(0), goal = at(grid.places_xy.size() / 2 - 1);
  std::vector<std::vector<pose_wall_planar_path_pose>> ways;
  for (const Dirt dirt : {Dirt::kZeros, Dirt::kOnes, Dirt::kRandom}) {
    AlignedBlock block(pose_wall::test::bytes_needed(settings), dirt);
    pose_wall_planar_planner* planner = nullptr;
    ASSERT_EQ(pose_wall_planar_plan_open(&settings, block.data(), block.size(), &planner), POSE_WALL_OK);
    for (int round = 0; round < 2; ++round) {
      std::vector<pose_wall_planar_path_pose> poses(3000);
      std::memset(poses.data(), 0, poses.size() * sizeof(poses[0]));
      pose_wall_planar_plan_result result{};
      result.struct_size = sizeof(result);
      ASSERT_EQ(pose_wall_planar_plan(planner, &view, &start, &goal, poses.data(), 3000, &result), POSE_WALL_OK);
      ways.push_back(poses);
      const pose_wall_planar_pose a{20.0, 20.0, 0.0}, b{30.0, 10.0, 1.0};
      ASSERT_EQ(pose_wall_planar_plan(planner, &other_view, &a, &b, poses.data(), 3000, &result), POSE_WALL_OK);
    }
  }
  for (const auto& way : ways) EXPECT_EQ(std::memcmp(way.data(), ways[0].data(), way.size() * sizeof(way[0])), 0);
}

TEST(Plan, WrongArgumentsAreRefusedAndChangeNothing) {
  const pose_wall_planar_plan_settings settings = small_plan();
  TrialPlanner planner(settings);
  const DrawnGrid grid(20.0, 0);
  const pose_wall_planar_pose pose{8.0, 8.0, 0.0};
  const double nan = std::nan("");
  pose_wall_planar_plan_result result{};
  result.struct_size = sizeof(result);
  const auto with = [&](auto change) {
    pose_wall_planar_grid view = grid.view();
    pose_wall_planar_pose start = pose;
    change(view, start);
    return pose_wall_planar_plan(planner.planner, &view, &start, &pose, planner.poses.data(), 10, &result);
  };
  EXPECT_EQ(with([](auto&, auto&) {}), POSE_WALL_OK);
  EXPECT_EQ(with([&](auto&, auto& p) { p.x_m = nan; }), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(with([&](auto&, auto& p) { p.yaw_rad = std::numeric_limits<double>::infinity(); }),
            POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(with([](auto&, auto& p) { p.yaw_rad = 1.1e4; }), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(with([](auto&, auto& p) { p.x_m = 1.1e6; }), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(with([](auto& g, auto&) { g.width = 0; }), POSE_WALL_PLANAR_E_GRID);
  EXPECT_EQ(with([](auto& g, auto&) { g.width = 801; }), POSE_WALL_PLANAR_E_GRID);
  EXPECT_EQ(with([](auto& g, auto&) { g.resolution_m = 0.1; }), POSE_WALL_PLANAR_E_GRID);
  EXPECT_EQ(with([&](auto& g, auto&) { g.origin_x_m = nan; }), POSE_WALL_PLANAR_E_GRID);
  EXPECT_EQ(with([](auto& g, auto&) { g.cells = nullptr; }), POSE_WALL_E_NULL);
  EXPECT_EQ(with([](auto& g, auto&) { g.struct_size = 3; }), POSE_WALL_E_STRUCT_SIZE);
  pose_wall_planar_plan_result wrong{};
  const pose_wall_planar_grid view = grid.view();
  EXPECT_EQ(pose_wall_planar_plan(planner.planner, &view, &pose, &pose, nullptr, 0, &wrong), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(pose_wall_planar_plan(planner.planner, &view, &pose, &pose, nullptr, 1, &result), POSE_WALL_E_NULL);
  std::vector<unsigned char> garbage(planner.block.size(), 0xA5);
  EXPECT_EQ(pose_wall_planar_plan(reinterpret_cast<pose_wall_planar_planner*>(garbage.data()), &view, &pose, &pose,
                                  nullptr, 0, &result),
            POSE_WALL_E_ENGINE);
}

}  // namespace
