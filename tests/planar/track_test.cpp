// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "pose_wall_planar_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "track_loop.hpp"
#include "trials/trial_task.hpp"

namespace {

using namespace pose_wall::test;
using DrivenGround = pose_wall::test::Ground;

pose_wall_planar_track_settings usual_track() {
  pose_wall_planar_track_settings settings;
  EXPECT_EQ(pose_wall_planar_track_settings_init(&settings), POSE_WALL_OK);
  return settings;
}

DrivenGround drawn_ground(std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> slip(0.05, 0.20);
  DrivenGround ground;
  ground.slip_left = slip(random);
  ground.slip_right = slip(random);
  ground.slip_wave = 0.02;
  return ground;
}

TEST(Track, OnCurvesWithSlipDelayAndNoiseItStaysWithinFiveCentimetres) {
  const pose_wall_planar_track_settings settings = usual_track();
  for (std::uint32_t seed = 1; seed <= 30; ++seed) {
    const auto route = drawn_route(seed);
    LoopTracker tracker(settings);
    const LoopRun run = run_loop(tracker, route, route[0].pose, drawn_ground(seed), seed);
    EXPECT_EQ(run.last_state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_TRACK_DONE)) << seed;
    EXPECT_LT(run.worst_cross(0.0, true), 0.05) << seed;
    EXPECT_LT(run.worst_cross(0.0, false), 0.10) << seed;
    const auto& goal = route.back().pose;
    EXPECT_LT(std::hypot(run.end.x_m - goal.x_m, run.end.y_m - goal.y_m), 0.06) << seed;
    EXPECT_LT(std::abs(std::remainder(run.end.yaw_rad - goal.yaw_rad, 6.283185307)), 0.03) << seed;
  }
}

// No limit cycle: with even tracks and 0.3 s of delay a long straight is driven without swinging to and fro.
TEST(Track, DoesNotOscillate) {
  for (const int drive : {1, -1}) {
    for (const double delay : {0.0, 0.15, 0.3, 0.45}) {  // the tracker believes 0.3
      DrivenGround ground;
      ground.delay_s = delay;
      const auto route = route_of({{60.0, 0.0, drive}});
      LoopTracker tracker(usual_track());
      const LoopRun run = run_loop(tracker, route, {0.0, 0.0, 0.0}, ground, 3);
      EXPECT_EQ(run.last_state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_TRACK_DONE));
      EXPECT_LT(run.worst_cross(5.0, false), 0.03) << delay;
      EXPECT_LE(run.swings(5.0, 0.015), 4) << delay;
    }
  }
}

TEST(Track, AnErrorFadesWithinItsWayAndDoesNotOvershoot) {
  for (const double settle : {1.2, 1.6, 3.0}) {
    for (const double aside : {0.3, -0.3}) {
      pose_wall_planar_track_settings settings = usual_track();
      settings.settle_m = settle;
      DrivenGround ground;
      ground.pose_sigma_m = ground.pose_sigma_rad = 0.0;
      const auto route = route_of({{20.0, 0.0, 1}});
      LoopTracker tracker(settings);
      const LoopRun run = run_loop(tracker, route, {0.0, aside, 0.0}, ground, 1);
      double beyond = 0.0, after = 0.0;
      for (const Moment& m : run.moments) {
        beyond = std::max(beyond, aside > 0.0 ? -m.cross_m : m.cross_m);
        if (m.along_m > 1.5 * settle) after = std::max(after, std::abs(m.cross_m));
      }
      EXPECT_LT(beyond, 0.1 * 0.3) << settle;
      EXPECT_LT(after, 0.1 * 0.3) << settle;
    }
  }
}

TEST(Track, LearnsSlipAndDrift) {
  DrivenGround ground;
  ground.slip_left = 0.05;
  ground.slip_right = 0.20;
  const auto route = route_of({{40.0, 0.0, 1}});
  LoopTracker tracker(usual_track());
  const LoopRun run = run_loop(tracker, route, {0.0, 0.0, 0.0}, ground, 2);
  EXPECT_NEAR(run.slip, 0.125, 0.03);
  EXPECT_NEAR(run.drift_1_m, -0.15 / 0.9 / 0.875, 0.04);
  EXPECT_LT(run.worst_cross(10.0, false), 0.03);
}

double room_of_a_narrow_place(void*, double x, double) {
  return x > 8.0 && x < 12.0 ? 0.85 : 5.0;
}

TEST(Track, SlowsInNarrowPlacesInCurvesAndBeforeStops) {
  const pose_wall_planar_track_settings settings = usual_track();
  const auto route = route_of({{20.0, 0.0, 1}, {1.57, 1.57, 1}, {6.0, 0.0, 1}});
  LoopTracker tracker(settings);
  const LoopRun run = run_loop(tracker, route, {0.0, 0.0, 0.0}, DrivenGround(), 1, room_of_a_narrow_place);
  double open = 0.0, narrow = 0.0, curve = 0.0, last = 0.0;
  bool was_slowed_by[4] = {};
  for (const Moment& m : run.moments) {
    was_slowed_by[m.slowed_by] = true;
    if (m.along_m > 4.0 && m.along_m < 6.0) open = std::max(open, m.commanded_m_s);
    if (m.along_m > 9.0 && m.along_m < 11.0) narrow = std::max(narrow, m.commanded_m_s);
    if (m.along_m > 20.5 && m.along_m < 21.3) curve = std::max(curve, m.commanded_m_s);
    if (m.along_m > 27.45) last = std::max(last, m.commanded_m_s);
  }
  EXPECT_NEAR(open, settings.speed_max_m_s, 0.01);
  EXPECT_NEAR(narrow, 0.5 * settings.speed_max_m_s, 0.02);  // 0.25 m beside it of 0.5 m
  EXPECT_LT(curve, 0.30);
  EXPECT_LT(last, 0.2);
  for (const bool was : was_slowed_by) EXPECT_TRUE(was);
}

TEST(Track, StopsAtCuspsAndTurnsOnTheSpotTheLongWayIfToldSo) {
  const auto route = route_of({{4.0, 0.0, 1}, {5.0, 0.5, -1}, {0.0, 4.0, 0}, {4.0, 0.0, 1}});
  LoopTracker tracker(usual_track());
  const LoopRun run = run_loop(tracker, route, {0.0, 0.0, 0.0}, drawn_ground(4), 5);
  EXPECT_EQ(run.last_state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_TRACK_DONE));
  const auto& goal = route.back().pose;
  EXPECT_LT(std::hypot(run.end.x_m - goal.x_m, run.end.y_m - goal.y_m), 0.08);
  bool forward = false, backward = false;
  for (const Moment& m : run.moments) {
    forward = forward || m.commanded_m_s > 0.1;
    backward = backward || m.commanded_m_s < -0.1;
    EXPECT_TRUE(m.along_m < 4.3 || m.along_m > 8.5 || m.commanded_m_s <= 0.0) << m.along_m;
  }
  EXPECT_TRUE(forward && backward);
}

TEST(Track, ThePlannersRoutesAreDrivenWithinTheirMargin) {
  pose_wall_planar_plan_settings settings;
  ASSERT_EQ(pose_wall_planar_plan_settings_init(&settings), POSE_WALL_OK);
  settings.width_max = settings.height_max = 800;
  pose_wall::test::TrialPlanner planner(settings);
  int driven = 0;
  for (std::uint32_t seed = 0; seed < 24 && driven < 8; ++seed) {
    const auto grid =
        seed % 2 == 0 ? pose_wall::test::drawn_network(seed, 40.0) : pose_wall::test::drawn_hall(seed, 40.0, 30);
    if (grid.places_xy.size() < 4) continue;
    const auto at = [&](std::size_t i, double yaw) {
      return pose_wall_planar_pose{grid.places_xy[2 * i], grid.places_xy[2 * i + 1], yaw};
    };
    const pose_wall_planar_pose start = at(0, 0.3), goal = at(grid.places_xy.size() / 2 - 1, 1.0);
    const auto result = planner.plan(grid, start, goal);
    if (result.outcome != POSE_WALL_PLANAR_PLAN_FOUND) continue;
    ++driven;
    const std::vector<pose_wall_planar_path_pose> route(planner.poses.begin(), planner.poses.begin() + result.poses);
    LoopTracker tracker(usual_track());
    const auto clearance = [](void* context, double x, double y) {
      return pose_wall_planar_plan_clearance(static_cast<const pose_wall_planar_planner*>(context), x, y);
    };
    const LoopRun run = run_loop(tracker, route, start, drawn_ground(seed), seed + 1, clearance, planner.planner);
    EXPECT_EQ(run.last_state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_TRACK_DONE)) << seed;
    EXPECT_LT(run.worst_cross(0.0, false), 0.1) << seed;
  }
  EXPECT_GE(driven, 5);
}

pose_wall_planar_track_input good_input(double x, std::int64_t now_ns) {
  return {sizeof(pose_wall_planar_track_input), 1, now_ns, now_ns, {x, 0.0, 0.0}, 0.05, std::nan("")};
}

// Steps with poses that `change` may spoil; the last command.
template <typename Change>
pose_wall_planar_track_command steps(LoopTracker& tracker, int count, std::int64_t* now_ns, const Change& change) {
  pose_wall_planar_track_command command{};
  command.struct_size = sizeof(command);
  for (int k = 0; k < count; ++k) {
    *now_ns += 50000000;
    pose_wall_planar_track_input input = good_input(1.0, *now_ns);
    change(input);
    EXPECT_EQ(pose_wall_planar_track_step(tracker.tracker, &input, &command), POSE_WALL_OK);
    EXPECT_TRUE(std::isfinite(command.left_m_s) && std::isfinite(command.right_m_s));
  }
  return command;
}

TEST(Track, WithoutAGoodPoseItStandsAndGoesOnWithTheNext) {
  const auto route = route_of({{20.0, 0.0, 1}});
  LoopTracker tracker(usual_track());
  std::int64_t now_ns = 5;
  const auto as_it_is = [](auto&) {};
  EXPECT_EQ(steps(tracker, 1, &now_ns, as_it_is).state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_TRACK_IDLE));
  ASSERT_EQ(pose_wall_planar_track_route(tracker.tracker, route.data(), static_cast<std::uint32_t>(route.size()),
                                         nullptr, nullptr),
            POSE_WALL_OK);
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  const auto expect_stop = [&](auto change) {
    EXPECT_GT(steps(tracker, 40, &now_ns, as_it_is).speed_m_s, 0.1);
    const auto command = steps(tracker, 1, &now_ns, change);
    EXPECT_EQ(command.state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_TRACK_NO_POSE));
    EXPECT_EQ(command.speed_m_s, 0.0);
    EXPECT_EQ(command.left_m_s, 0.0);
    EXPECT_TRUE(std::isnan(command.cross_error_m));
  };
  expect_stop([](auto& i) { i.has_pose = 0; });
  expect_stop([&](auto& i) { i.pose.x_m = nan; });
  expect_stop([&](auto& i) { i.pose.yaw_rad = infinite; });
  expect_stop([&](auto& i) { i.pose_level_m = nan; });
  expect_stop([](auto& i) { i.pose_level_m = 0.51; });
  expect_stop([](auto& i) { i.pose_level_m = -1.0; });
  expect_stop([](auto& i) { i.pose_ns -= 600000000; });
  expect_stop([](auto& i) { i.pose_ns += 100000000; });
  expect_stop([](auto& i) { i.pose_ns = std::numeric_limits<std::int64_t>::max(); });
  expect_stop([](auto& i) { i.pose_ns = std::numeric_limits<std::int64_t>::min(); });
  const auto off = steps(tracker, 40, &now_ns, [](auto& i) { i.pose.y_m = 0.6; });
  EXPECT_EQ(off.state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_TRACK_OFF_PATH));
  EXPECT_EQ(off.speed_m_s, 0.0);
  EXPECT_EQ(steps(tracker, 40, &now_ns, as_it_is).state, static_cast<std::uint32_t>(POSE_WALL_PLANAR_TRACK_OFF_PATH));
}

TEST(Track, OddRoutesEndWell) {
  LoopTracker tracker(usual_track());
  std::int64_t now_ns = 5;
  const auto as_it_is = [](auto&) {};
  const auto state_after = [&](const std::vector<pose_wall_planar_path_pose>& route) {
    EXPECT_EQ(pose_wall_planar_track_route(tracker.tracker, route.data(), static_cast<std::uint32_t>(route.size()),
                                           nullptr, nullptr),
              POSE_WALL_OK);
    return steps(tracker, 200, &now_ns, as_it_is).state;
  };
  const pose_wall_planar_path_pose here{{1.0, 0.0, 0.0}, 0.0, 0.0, 0, 0};
  const auto done = static_cast<std::uint32_t>(POSE_WALL_PLANAR_TRACK_DONE);
  EXPECT_EQ(state_after({here}), done);
  auto same = here;
  same.drive = 1;
  EXPECT_EQ(state_after({here, same, same, same}), done);
  auto spot = here;
  spot.flags = POSE_WALL_PLANAR_PATH_TURN_LEFT;
  EXPECT_EQ(state_after({here, spot, spot}), done);
  auto stops = same;
  stops.flags = POSE_WALL_PLANAR_PATH_STOP;
  EXPECT_EQ(state_after({here, stops, stops, stops, stops}), done);
}

TEST(Track, WrongArgumentsAreRefusedAndTheRouteStays) {
  LoopTracker tracker(usual_track());
  const auto route = route_of({{20.0, 0.0, 1}});
  const auto set = [&](auto change, std::uint32_t count) {
    auto changed = route;
    change(changed);
    return pose_wall_planar_track_route(tracker.tracker, changed.data(), count, nullptr, nullptr);
  };
  const double nan = std::nan("");
  EXPECT_EQ(set([](auto&) {}, 10), POSE_WALL_OK);
  EXPECT_EQ(set([](auto&) {}, 0), POSE_WALL_E_VALUE_RANGE);
  EXPECT_EQ(set([](auto& r) { r.resize(9000); }, 9000), POSE_WALL_E_VALUE_RANGE);
  EXPECT_EQ(set([&](auto& r) { r[3].pose.x_m = nan; }, 10), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(set([&](auto& r) { r[3].curvature_1_m = nan; }, 10), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(set([&](auto& r) { r[3].along_m = -1.0; }, 10), POSE_WALL_PLANAR_E_POSE);
  EXPECT_EQ(set([&](auto& r) { r[3].drive = 7; }, 10), POSE_WALL_PLANAR_E_POSE);
  pose_wall_planar_track_input input = good_input(0.0, 1);
  pose_wall_planar_track_command command{};
  EXPECT_EQ(pose_wall_planar_track_step(tracker.tracker, &input, &command), POSE_WALL_E_STRUCT_SIZE);
  EXPECT_EQ(pose_wall_planar_track_step(tracker.tracker, nullptr, &command), POSE_WALL_E_NULL);
}

// A stop lets the machine stand: what is learnt must not change, and the next command begins at rest.
TEST(Track, AStoppedMachineTeachesNoSlip) {
  const auto slip_after_stop = [](bool is_told) {
    LoopTracker tracker(usual_track());
    const auto route = route_of({{20.0, 0.0, 1}});
    EXPECT_EQ(pose_wall_planar_track_route(tracker.tracker, route.data(), static_cast<std::uint32_t>(route.size()),
                                           nullptr, nullptr),
              POSE_WALL_OK);
    pose_wall_planar_track_command command{};
    command.struct_size = sizeof(command);
    for (int k = 1; k <= 200; ++k) {  // it stands for 20 s at the route's first metre
      const pose_wall_planar_track_input input = good_input(1.0, k * 100000000LL);
      EXPECT_EQ(pose_wall_planar_track_step(tracker.tracker, &input, &command), POSE_WALL_OK);
      if (is_told) {
        EXPECT_EQ(pose_wall_planar_track_obeyed(tracker.tracker, 0.0, 0.0), POSE_WALL_OK);
      }
    }
    if (is_told) {
      EXPECT_LT(command.speed_m_s, 0.05) << "each command begins at rest";
    }
    return command.slip;
  };
  EXPECT_EQ(slip_after_stop(true), 0.0);
  EXPECT_GT(slip_after_stop(false), 0.2) << "the tracker that was not told learns slip";
}

TEST(Track, ObeyedRefusesWhatIsNoCommand) {
  LoopTracker tracker(usual_track());
  EXPECT_EQ(pose_wall_planar_track_obeyed(nullptr, 0.0, 0.0), POSE_WALL_E_NULL);
  EXPECT_EQ(pose_wall_planar_track_obeyed(tracker.tracker, std::nan(""), 0.0), POSE_WALL_E_VALUE_RANGE);
  EXPECT_EQ(pose_wall_planar_track_obeyed(tracker.tracker, 0.0, 1e9), POSE_WALL_E_VALUE_RANGE);
  EXPECT_EQ(pose_wall_planar_track_obeyed(tracker.tracker, -0.2, 0.1), POSE_WALL_OK);
}

// Garbage for an hour: no command that is not finite or beyond its limits.
TEST(Track, CommandsKeepTheirLimitsWhateverComesIn) {
  const pose_wall_planar_track_settings settings = usual_track();
  LoopTracker tracker(settings);
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  std::int64_t now_ns = 0;
  for (int k = 0; k < 20000; ++k) {
    if (k % 500 == 0) {
      const auto route = drawn_route(static_cast<std::uint32_t>(k));
      ASSERT_EQ(pose_wall_planar_track_route(tracker.tracker, route.data(), static_cast<std::uint32_t>(route.size()),
                                             nullptr, nullptr),
                POSE_WALL_OK);
    }
    now_ns += static_cast<std::int64_t>(random() % 100000000) - 2000000;
    pose_wall_planar_track_input input = good_input(k % 500 * 0.02 + 0.05 * part(random), now_ns);
    input.pose.y_m = 0.2 * part(random);
    if (random() % 50 == 0) input.pose_ns = static_cast<std::int64_t>(random());
    if (random() % 50 == 0) input.now_ns = static_cast<std::int64_t>(random());
    if (random() % 50 == 0) std::memcpy(&input.pose.yaw_rad, &now_ns, 8);
    if (random() % 50 == 0) input.speed_m_s = 1e300;
    pose_wall_planar_track_command command{};
    command.struct_size = sizeof(command);
    ASSERT_EQ(pose_wall_planar_track_step(tracker.tracker, &input, &command), POSE_WALL_OK);
    ASSERT_TRUE(std::abs(command.speed_m_s) <= settings.speed_max_m_s) << k;
    ASSERT_TRUE(std::abs(command.turn_rad_s) <= settings.turn_max_rad_s) << k;
    ASSERT_TRUE(std::isfinite(command.slip) && std::isfinite(command.drift_1_m)) << k;
  }
}

}  // namespace
