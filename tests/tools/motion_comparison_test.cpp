// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves, by errors put in by hand: what eval makes of a motion table is right in every number and every axis, on a
// machine that is turned, lost, or began elsewhere; and tables that are none are refused by line and column.

#include "study/motion/motion_comparison.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "motion_tables.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr double kTiny = 1e-9;
constexpr double kQuarterTurn = 1.5707963267948966;

MotionComparison compared(const std::string& motion, const std::string& truth) {
  std::istringstream motion_stream(motion), truth_stream(truth);
  const MotionTable table = read_motion_table(CsvTable::parse(motion_stream));
  const PoseTruth poses = read_pose_truth(CsvTable::parse(truth_stream));
  return compare_motion(table, poses);
}

std::vector<Cells> straight(int frames, double step_m) {
  std::vector<Cells> rows;
  for (int i = 0; i < frames; ++i) rows.push_back(placed(100.0 + step_m * i, 5.0, 1.4));
  return rows;
}

TEST(MotionComparison, EveryNumberOfAStraightDrive) {
  const Cells promised = {{"along_sigma", "0.1"}, {"along_pl", "0.15"}, {"across_pl", "0.15"}};
  const MotionComparison c =
      compared(motion_csv({with(placed(0, 0), promised), with(placed(1.1, 0), promised), with(placed(2, 0.1), promised),
                           with(with(placed(3.3, 0), promised), {{"along_state", "ambiguous"}}),
                           with(placed(4.2, -0.2), promised)}),
               pose_truth_csv(straight(5, 1.0)));
  EXPECT_EQ(c.matched, 5U);
  EXPECT_TRUE(c.along_is_road);
  EXPECT_NEAR(c.way_m, 4.0, kTiny);
  EXPECT_NEAR(c.true_along_m, 4.0, kTiny);
  EXPECT_NEAR(c.measured_along_m, 4.2, kTiny);
  EXPECT_NEAR(c.travel[0].at_end, 0.2, kTiny);
  EXPECT_NEAR(c.travel[0].largest, 0.3, kTiny);
  EXPECT_EQ(c.travel[0].largest_at_frame, 3U);
  EXPECT_NEAR(c.travel[1].at_end, -0.2, kTiny);
  EXPECT_NEAR(c.travel[1].largest, 0.2, kTiny);
  EXPECT_NEAR(c.travel[2].largest, 0.0, kTiny);
  // Errors along: 0.1, 0, 0.3, 0.2 at a sigma of 0.1 and a level of 0.15.
  const DirectionErrors& along = c.pose[POSE_WALL_MOTION_ALONG];
  EXPECT_EQ(along.count(), 4U);
  EXPECT_NEAR(along.rmse(), std::sqrt(0.14 / 4.0), kTiny);
  EXPECT_NEAR(along.largest(), 0.3, kTiny);
  EXPECT_NEAR(along.mean_z2(), 3.5, 1e-7);
  EXPECT_EQ(along.beyond(), 2U);
  // Errors across: 0, 0.1, 0, -0.2, with levels and without sigmas.
  EXPECT_NEAR(c.pose[POSE_WALL_MOTION_ACROSS].rmse(), std::sqrt(0.05 / 4.0), kTiny);
  EXPECT_TRUE(std::isnan(c.pose[POSE_WALL_MOTION_ACROSS].mean_z2()));
  EXPECT_EQ(c.pose[POSE_WALL_MOTION_ACROSS].beyond(), 1U);
  // No level at all is no promise that could hold.
  EXPECT_EQ(c.pose[POSE_WALL_MOTION_UP].beyond(), 4U);
  // Frames 3 and 4 are beyond; what is called ambiguous does not mislead.
  EXPECT_EQ(c.misleading_poses.measured, 3U);
  EXPECT_EQ(c.misleading_poses.misleading, 1U);
  EXPECT_EQ(c.states[POSE_WALL_ALONG_MEASURED], 4U);
  EXPECT_EQ(c.states[POSE_WALL_ALONG_AMBIGUOUS], 1U);
  EXPECT_EQ(c.step[POSE_WALL_MOTION_ALONG].count(), 0U);
  EXPECT_EQ(c.drift.count, 0U);
}

// Turned to the left by a quarter: the road's X is the machine's -Y, and the road's left is its X.
TEST(MotionComparison, AlongIsTheRoadsAxisOnATurnedMachine) {
  const MotionComparison c = compared(motion_csv({placed(0, 0), placed(0.05, -2.1, 0.2)}),
                                      pose_truth_csv({placed(0, 0, 0, kQuarterTurn), placed(2, 0, 0, kQuarterTurn)}));
  EXPECT_NEAR(c.true_along_m, 2.0, kTiny);
  EXPECT_NEAR(c.measured_along_m, 2.1, kTiny);
  EXPECT_NEAR(c.travel[0].at_end, 0.1, kTiny);
  EXPECT_NEAR(c.travel[1].at_end, 0.05, kTiny);
  EXPECT_NEAR(c.travel[2].at_end, 0.2, kTiny);
}

TEST(MotionComparison, TurnsAreAboutTheAxesOfTheStart) {
  const MotionComparison c = compared(motion_csv({placed(0, 0), with(placed(1, 0, 0, 0.03), {{"yaw_pl", "0.02"}})}),
                                      pose_truth_csv({placed(0, 0), placed(1, 0, 0, 0.01)}));
  EXPECT_NEAR(c.turn.at_end, 0.02, 1e-7);
  EXPECT_NEAR(c.pose[POSE_WALL_MOTION_YAW].rmse(), 0.02, 1e-7);
  EXPECT_NEAR(c.pose[POSE_WALL_MOTION_ROLL].rmse(), 0.0, 1e-7);
}

TEST(MotionComparison, ThePathsAreLaidOnEachOtherAtTheFirstCommonRow) {
  // The table begins lost, and where both have a pose first it stands at (5, 1), turned by a quarter.
  const MotionComparison c =
      compared(motion_csv({lost_frame(), placed(5, 1, 0, kQuarterTurn), placed(5, 2, 0, kQuarterTurn)}),
               pose_truth_csv({placed(9, 0), placed(10, 0), placed(11, 0)}));
  EXPECT_EQ(c.first_frame, 1U);
  EXPECT_NEAR(c.way_m, 1.0, kTiny);
  EXPECT_NEAR(c.travel[0].largest, 0.0, kTiny);
  EXPECT_NEAR(c.travel[1].largest, 0.0, kTiny);
  ASSERT_EQ(c.true_place_start_m.size(), 3U);
  EXPECT_FALSE(c.true_place_start_m[0].has_value());
  EXPECT_NEAR((*c.true_place_start_m[2] - Eigen::Vector3d(5, 2, 0)).norm(), 0.0, kTiny);
}

TEST(MotionComparison, StepsAreJudgedInTheRoadToo) {
  const Cells promised = {{"step_along_sigma", "0.1"}, {"step_along_pl", "0.05"}, {"step_yaw_pl", "0.05"}};
  // At frame 1 turned by a quarter, from there a metre along the road: that is to the machine's right.
  const MotionComparison c = compared(
      motion_csv({placed(0, 0), with(with(placed(1, 0, 0, kQuarterTurn), stepped(1, 0, kQuarterTurn)), promised),
                  with(with(placed(2, 0, 0, kQuarterTurn), stepped(0, -1.1, 0.02)), promised)}),
      pose_truth_csv({placed(0, 0), placed(1, 0, 0, kQuarterTurn), placed(2, 0, 0, kQuarterTurn)}));
  const DirectionErrors& along = c.step[POSE_WALL_MOTION_ALONG];
  EXPECT_EQ(along.count(), 2U);
  EXPECT_NEAR(along.largest(), 0.1, kTiny);
  EXPECT_NEAR(along.mean_z2(), 0.5, 1e-7);
  EXPECT_EQ(along.beyond(), 1U);
  EXPECT_NEAR(c.step[POSE_WALL_MOTION_ACROSS].largest(), 0.0, kTiny);
  EXPECT_NEAR(c.step[POSE_WALL_MOTION_YAW].largest(), 0.02, 1e-7);
  EXPECT_EQ(c.step[POSE_WALL_MOTION_YAW].beyond(), 0U);
  EXPECT_EQ(c.misleading_steps.measured, 2U);
  EXPECT_EQ(c.misleading_steps.misleading, 1U);
  EXPECT_EQ(c.misleading_poses.misleading, 0U);
}

TEST(MotionComparison, AStepAfterAFrameThatCouldNotBeReadIsFromTheOneBefore) {
  const MotionComparison c = compared(
      motion_csv(
          {placed(0, 0), {{"along_state", "unreadable"}, {"along_pl", ""}}, with(placed(2, 0), stepped(2.1, 0))}),
      pose_truth_csv(straight(3, 1.0)));
  EXPECT_EQ(c.step[POSE_WALL_MOTION_ALONG].count(), 1U);
  EXPECT_NEAR(c.step[POSE_WALL_MOTION_ALONG].largest(), 0.1, kTiny);
  EXPECT_EQ(c.states[POSE_WALL_ALONG_MEASURED + 1], 1U);
}

TEST(MotionComparison, DriftIsThatOfEverySegment) {
  std::vector<Cells> measured;
  for (int i = 0; i <= 30; ++i) measured.push_back(placed(1.01 * i + (i == 30 ? 0.2 : 0.0), 0));
  const MotionComparison c = compared(motion_csv(measured), pose_truth_csv(straight(31, 1.0)));
  // From 0 to 20: each is 1 % too long, the last by 0.2 m more.
  EXPECT_EQ(c.drift.count, 21U);
  EXPECT_NEAR(c.drift.worst, 0.03, kTiny);
  EXPECT_EQ(c.drift.worst_from_frame, 20U);
  EXPECT_NEAR(c.drift.mean, (20 * 0.01 + 0.03) / 21.0, kTiny);
}

TEST(MotionComparison, LostFramesCountAsStatesAndAsNothingElse) {
  const MotionComparison c =
      compared(motion_csv({placed(0, 0), lost_frame(), lost_frame(), placed(3, 0)}), pose_truth_csv(straight(4, 1.0)));
  EXPECT_EQ(c.states[POSE_WALL_ALONG_LOST], 2U);
  EXPECT_EQ(c.pose[POSE_WALL_MOTION_ALONG].count(), 1U);
  EXPECT_NEAR(c.way_m, 3.0, kTiny) << "the machine drove on while it was lost";
}

TEST(MotionComparison, AReferenceOfOthersHasMatricesAndNoRoad) {
  // It drives along its own Y, with X to the right: a turn of -90 degrees.
  const std::string reference =
      "frame,stamp_s,r00,r01,r02,tx,r10,r11,r12,ty,r20,r21,r22,tz\n"
      "0,5.0,1,0,0,7,0,1,0,7,0,0,1,0\n1,5.1,1,0,0,7,0,1,0,9,0,0,1,0\n";
  const MotionComparison c = compared(motion_csv({placed(0, 0), placed(-0.1, 2.3)}), reference);
  EXPECT_EQ(c.matched_by, "frame");
  EXPECT_FALSE(c.along_is_road);
  EXPECT_NEAR(c.travel[0].at_end, 0.3, kTiny);
  EXPECT_NEAR(c.travel[1].at_end, 0.1, kTiny);
}

// Whatever a damaged file holds: it is refused as a table, or compared; nothing else happens.
TEST(MotionComparison, DamagedTablesAreRefusedOrCompared) {
  const std::string motion = motion_csv({placed(0, 0), with(placed(6, 0.1), stepped(6, 0.1)), lost_frame(),
                                         with(placed(12, 0), {{"along_state", "unobservable"}})});
  const std::string truth = pose_truth_csv(straight(4, 5.0));
  const auto outcome = [](const std::string& a, const std::string& b) {
    try {
      const MotionComparison c = compared(a, b);
      return c.matched > 0 && c.pose[0].beyond() <= c.pose[0].count() &&
             c.misleading_poses.misleading <= c.misleading_poses.measured;
    } catch (const CsvError& error) {
      return *error.what() != '\0';
    }
  };
  for (std::size_t length = 0; length < motion.size(); ++length) {
    ASSERT_TRUE(outcome(motion.substr(0, length), truth)) << length;
  }
  std::mt19937 random(7);
  for (int round = 0; round < 3000; ++round) {
    std::string a = motion, b = truth;
    std::string& damaged = round % 3 == 0 ? b : a;
    for (int flips = 0; flips < 1 + round % 3; ++flips) {
      static const std::string kLikely = "0123456789.,-e\nx\"";
      damaged[random() % damaged.size()] = kLikely[random() % kLikely.size()];
    }
    ASSERT_TRUE(outcome(a, b)) << round;
  }
}

// ---- the verb

Ran evaluated(const TempFolder& folder, const std::string& motion, const std::string& truth,
              const std::vector<std::string>& more = {}) {
  return command({"eval", folder.write("motion.csv", motion), folder.write("truth.csv", truth)}, more);
}

TEST(EvalOfMotion, PrintsTablesAndJson) {
  const TempFolder folder;
  const std::string motion = motion_csv({placed(0, 0), placed(2.2, 0)}), truth = pose_truth_csv(straight(2, 2.0));
  const Ran tables = evaluated(folder, motion, truth);
  EXPECT_EQ(tables.exit_status, 0) << tables.errors;
  for (const char* part : {"2 frames matched by stamp_ns", "way: 2.000 m", "measured +2.200 m", "+0.2000 m", "10.000 %",
                           "measured 100.000 %", "the way is shorter", "0 of 1 poses, 0 of 0 steps"}) {
    EXPECT_TRUE(contains(tables.printed, part)) << part << "\nin\n" << tables.printed;
  }
  const Ran json = evaluated(folder, motion, truth, {"--json"});
  const nlohmann::json data = nlohmann::json::parse(json.printed);
  EXPECT_NEAR(data.at("error").at("along_m").at("at_end").get<double>(), 0.2, kTiny);
  EXPECT_TRUE(data.at("drift").at("mean").is_null());
  EXPECT_EQ(data.at("pose").at("along").at("count"), 1);
  EXPECT_EQ(data.at("states").at("measured"), 2);
}

TEST(EvalOfMotion, AMachineThatStandsHasNoPercent) {
  const TempFolder folder;
  const Ran ran = evaluated(folder, motion_csv({placed(0, 0), placed(0.01, 0)}), pose_truth_csv(straight(2, 0.0)));
  EXPECT_EQ(ran.exit_status, 0);
  EXPECT_FALSE(contains(ran.printed, "inf") || contains(ran.printed, "nan")) << ran.printed;
}

TEST(EvalOfMotion, WhatIsNoTableIsRefusedByLineAndColumn) {
  const std::string good = motion_csv({placed(0, 0), placed(1, 0)}), truth = pose_truth_csv(straight(2, 1.0));
  const auto changed = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const auto row = [](const Cells& cells) { return motion_csv({placed(0, 0), cells}); };
  struct Case {
    std::string motion, truth;
    const char* said;
  };
  const Case cases[] = {
      {changed(good, "across_pl", "acros_pl"), truth, "motion.csv: the motion table has no column 'across_pl'"},
      {changed(good, "step_rz", "step_z9"), truth, "no column 'step_rz'"},
      {row(with(placed(1, 0), {{"x", "far"}})), truth, "motion.csv: line 3, column x: 'far' is not a number"},
      {row(with(placed(1, 0), {{"along_pl", "1m"}})), truth, "line 3, column along_pl: '1m' is not a number"},
      {row(with(placed(1, 0), {{"frame", "1.5"}})), truth, "line 3, column frame: '1.5' is no whole number"},
      {row(with(placed(1, 0), {{"stamp_ns", "1e9"}})), truth, "column stamp_ns: '1e9'"},
      {row(with(placed(1, 0), {{"along_state", "sure"}})), truth, "'sure' is no state; measured, ambiguous"},
      {row(with(placed(1, 0), {{"y", ""}})), truth, "line 3: of x, y, z, qx, qy, qz, qw all are numbers"},
      {row(with(placed(1, 0), {{"x", "inf"}})), truth, "line 3: of x, y, z"},
      {row(with(placed(1, 0), {{"step_x", "1"}})), truth, "line 3: of step_x"},
      {row(with(placed(1, 0), {{"qw", "2"}})), truth, "have not the length 1"},
      {row(with(placed(1, 0), {{"along_state", "lost"}})), truth, "the state is lost, but there is a pose"},
      {row({{"along_pl", "1"}}), truth, "the state is measured, but there is no pose"},
      {good.substr(0, good.size() - 25), truth, "cells, the head has"},
      {good, "frame,stamp_ns,roll\n0,0,0\n1,100000000,0\n", "truth.csv: the truth has no poses"},
      {good, "frame,stamp_ns,x,y,z,qx,qy,qz,qw\n7,7,0,0,0,0,0,0,1\n", "no row in common"},
      {good, "frame,stamp_ns,x,y,z,qx,qy,qz,qw\n0,0,,,,,,,\n", "no row has a pose"},
      {good, "frame,stamp_ns,x,y,z,qx,qy,qz,qw\n0,0,0,0,0,0,0,0,3\n", "truth.csv: line 2: qx, qy, qz, qw"},
      {good, "frame,r00,r01,r02,tx,r10,r11,r12,ty,r20,r21,r22,tz\n0,1,0,0,0,0,1,0,0,0,0,-1,0\n", "are no rotation"},
      {good, "frame,r00,r01,r02,tx,r10,r11,r12,ty,r20,r21,r22\n0,1,0,0,0,0,1,0,0,0,0,1\n", "no column 'tz'"},
  };
  const TempFolder folder;
  for (const Case& one : cases) {
    const Ran ran = evaluated(folder, one.motion, one.truth);
    EXPECT_EQ(ran.exit_status, 1) << one.said;
    EXPECT_TRUE(contains(ran.errors, one.said)) << one.said << "\nin\n" << ran.errors;
    EXPECT_EQ(ran.printed, "") << one.said;
  }
  EXPECT_EQ(evaluated(folder, good, truth).exit_status, 0);
}

TEST(EvalOfMotion, TheBoundIsThatOfRun) {
  const TempFolder folder;
  EXPECT_TRUE(
      test::says(evaluated(folder, motion_csv({placed(0, 0)}), pose_truth_csv(straight(1, 1.0)),
                           {"--frames", folder.path(), "--range-noise", "0.01", "-c", folder.write("c.yaml", "")}),
                 2, "--frames"));
}

}  // namespace
}  // namespace pose_wall::tools
