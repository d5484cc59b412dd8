// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the parts of pose_wall_planar drive a simulated machine to its goal together; a person in the way stops it;
// a place that is not unique is never driven from; what is refused is named. Does not prove: how often they fail.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "english_left.hpp"
#include "lab/drive/drive_files.hpp"
#include "lab/drive/drive_run.hpp"
#include "lab/sim/network_kinds.hpp"
#include "ran_command.hpp"
#include "study/planar/plane_pose.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

// A road of 60 m, taught.
class TaughtRoad {
 public:
  explicit TaughtRoad(const char* kind = "corridor", double length_m = 60.0, double share = 0.6)
      : network(plan_of(kind, length_m), 1),
        model(drive_sensor("mid360")),
        roads(teach_roads(
            network, model, 1, [](double) { return true; }, share)) {}

  // From one keyframe to another.
  DriveRunSettings way(std::size_t from, std::size_t to) const {
    DriveRunSettings settings;
    settings.people = 0;
    settings.loses_walls = false;
    settings.start = roads.marks.at(from).truth;
    settings.goal = roads.marks.at(to).map;
    settings.time_most_s = 150.0;
    return settings;
  }

  sim::Network network;
  const sim::SensorModel& model;
  TaughtRoads roads;

 private:
  static sim::NetworkPlan plan_of(const char* kind, double length_m) {
    sim::NetworkPlan plan = sim::find_network_kind(kind)->plan;
    plan.length_m = length_m;
    return plan;
  }
};

// Taught once for all that drive there.
const TaughtRoad& corridor() {
  static const TaughtRoad road;
  return road;
}

TEST(DriveRun, ReachesItsGoalWithoutAContact) {
  const TaughtRoad& road = corridor();
  DriveRun drive(road.network, road.model, road.roads, road.way(30, 60));
  const DriveEnd end = drive.run([](const DriveFrame&) { return true; });
  EXPECT_TRUE(end.has_arrived) << end.reason;
  EXPECT_EQ(end.contacts, 0U);
  EXPECT_EQ(end.wrong_places, 0U);
  EXPECT_LT(end.error_worst_m, 0.2);
  EXPECT_LT(end.off_route_worst_m, 0.2);
  const DriveFrame& last = drive.frames().back();
  EXPECT_LT(distance_m(last.truth, drive.goal()), 0.3);
  const std::string csv = drive_as_csv(drive.frames());
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), drive.frames().size() + 1);
  EXPECT_TRUE(contains(drive_table(drive, end, road.roads), "reached"));
  EXPECT_TRUE(contains(drive_picture(drive, end, road.roads, "t"), "<polyline"));
}

TEST(DriveRun, WhatWasLostIsToldInWords) {
  const TaughtRoad& road = corridor();
  const DriveRun drive(road.network, road.model, road.roads, road.way(30, 60));
  const test::EnglishAfterwards afterwards;
  for (const auto& [loss, english, chinese] :
       {std::tuple("dark_wall", "those of a wall, 2.0 s", "某处巷帮的回波，2.0 s"),
        std::tuple("dropout", "most of them, 2.0 s", "大部分回波，2.0 s"),
        std::tuple("blind", "all of them, 2.0 s", "全部回波，2.0 s")}) {
    DriveEnd end;
    end.loss = loss;
    end.loss_s = 2.0;
    choose_language(Language::kEnglish);
    EXPECT_TRUE(contains(drive_table(drive, end, road.roads), english)) << drive_table(drive, end, road.roads);
    choose_language(Language::kChinese);
    EXPECT_TRUE(contains(drive_table(drive, end, road.roads), chinese)) << drive_table(drive, end, road.roads);
  }
}

TEST(DriveRun, ReachesWhereTheMapBeganThoughItCannotTurnRoundThere) {
  const TaughtRoad& road = corridor();
  DriveRunSettings settings = road.way(24, 0);
  settings.start = combined(*settings.start, {0.0, 0.0, M_PI});
  settings.goal.reset();
  DriveRun drive(road.network, road.model, road.roads, settings);
  const DriveEnd end = drive.run([](const DriveFrame&) { return true; });
  EXPECT_TRUE(end.has_arrived) << end.reason;
  EXPECT_EQ(end.contacts, 0U);
  EXPECT_LT(distance_m(drive.frames().back().truth, drive.goal()), 0.3);
}

TEST(DriveRun, APersonWhoStaysStopsTheMachineAndTheReasonSaysSo) {
  const TaughtRoad& road = corridor();
  DriveRunSettings settings = road.way(20, 64);
  settings.people = 1;
  settings.people_stay = true;
  settings.patience_s = 40.0;
  settings.time_most_s = 400.0;
  DriveRun drive(road.network, road.model, road.roads, settings);
  const DriveEnd end = drive.run([](const DriveFrame&) { return true; });
  EXPECT_FALSE(end.has_arrived);
  EXPECT_EQ(end.contacts, 0U);
  EXPECT_TRUE(contains(end.reason, "the stop held it for 40 s: ")) << end.reason;
  EXPECT_TRUE(contains(end.reason, "thing")) << end.reason;
  EXPECT_GT(drive.frames().back().nearest_m, 0.05);
  EXPECT_LT(drive.frames().back().nearest_m, 4.0) << "it stopped for something else";
}

TEST(DriveRun, AGoalInTheRockHasThePlannersReason) {
  const TaughtRoad& road = corridor();
  DriveRunSettings settings = road.way(30, 60);
  settings.goal = combined(*settings.goal, {0.0, 12.0, 0.0});
  DriveRun drive(road.network, road.model, road.roads, settings);
  const DriveEnd end = drive.run([](const DriveFrame&) { return true; });
  EXPECT_FALSE(end.has_arrived);
  EXPECT_TRUE(contains(end.reason, "there is no route. The machine does not fit at the goal")) << end.reason;
  EXPECT_TRUE(contains(end.reason, "Another --goal")) << end.reason;
  EXPECT_FALSE(contains(end.reason, "--to") || contains(end.reason, "--set")) << "options of another command";
  EXPECT_LT(end.driven_m, 20.0) << "it drives nowhere without a route";
  EXPECT_GT(end.unique_after_s, 0.0) << "its place was found";
}

TEST(DriveRun, TwinRoadsAreNeverTakenForEachOther) {
  const TaughtRoad road("twin", 110.0, kTaughtShare);
  DriveRunSettings settings = road.way(road.roads.marks.size() / 2, 0);
  settings.time_most_s = 30.0;
  DriveRun drive(road.network, road.model, road.roads, settings);
  const DriveEnd end = drive.run([](const DriveFrame&) { return true; });
  EXPECT_EQ(end.wrong_places, 0U);
  EXPECT_EQ(end.contacts, 0U);
  for (const DriveFrame& frame : drive.frames()) {
    if (frame.phase == PilotPhase::kFollowing) break;
    EXPECT_LE(std::abs(frame.command.speed_m_s), 0.2 + 1e-9) << "faster than a creep at " << frame.time_s << " s";
  }
  EXPECT_NE(drive.frames().front().place_state, std::uint32_t{POSE_WALL_PLANAR_LOCALISE_UNIQUE});
}

TEST(DriveRun, TheSameSeedGivesTheSameBits) {
  const TaughtRoad& road = corridor();
  DriveRunSettings settings = road.way(30, 60);
  settings.people = 2;
  settings.loses_walls = true;
  settings.time_most_s = 8.0;
  std::string csv[2];
  for (std::string& text : csv) {
    DriveRun drive(road.network, road.model, road.roads, settings);
    (void)drive.run([](const DriveFrame&) { return true; });
    text = drive_as_csv(drive.frames());
  }
  EXPECT_GT(csv[0].size(), 5000U);
  EXPECT_EQ(csv[0], csv[1]);
}

TEST(DriveVerb, FaultsOfUsage) {
  const std::pair<std::vector<std::string>, const char*> usage[] = {
      {{"drive", "--network", "rok"}, "'rock'"},
      {{"drive", "--sensor", "vlp61"}, "'vlp16'"},
      {{"drive", "--people", "99"}, "20"},
      {{"drive", "--people", "-1"}, "--people"},
      {{"drive", "--seed", "-1"}, "--seed"},
      {{"drive", "--goal", "1,2"}, "--goal: '1,2' is refused; allowed: x,y,yaw"},
      {{"drive", "--gaol", "1,2,3"}, "--gaol"},
  };
  for (const auto& [words, answer] : usage) EXPECT_TRUE(test::says(command(words), 2, answer));
}

TEST(DriveVerb, TheFolderMustBeWritable) {
  const test::TempFolder folder;
  const std::string file = folder.write("in_the_way", "x");
  EXPECT_TRUE(test::says(command({"drive", "-o", file}), 2, "in_the_way"));
}

}  // namespace
}  // namespace pose_wall::tools
