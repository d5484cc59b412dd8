// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the motion library that takes notes gives the numbers of the delivered one. Another limit of a gate changes
// what becomes of the frames, and only while it is swept; a gate that is left out stops nothing. What cannot be swept
// is refused by name. Does not prove: that a limit of the table is the right one.

#include "lab/campaign/motion_trials.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "campaign_tables.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using nlohmann::json;
using test::contains;
using test::Ran;
using test::TempFolder;
using test::text_of;

const test::CampaignRuns kRuns({"--motion", "--scenes", "rough,gaps", "--sensors", "vlp16", "--frames", "12",
                                "--quiet"});

TEST(MotionTrials, WithTheTableTheyAreWhatTheCardSays) {
  const TempFolder folder;
  ASSERT_EQ(kRuns.with({"--output", folder.path()}).exit_status, 0);
  const json card = json::parse(text_of(folder.file("card.json")));
  double measured = 0.0, judged = 0.0;
  for (const json& one : card.at("classes")) {
    const double frames = one.at("frames").get<double>() - one.at("runs").get<double>();
    judged += frames;
    measured += frames * one.at("states").at("measured").get<double>();
  }
  const json row = kRuns.rows("--sweep", "matched=40").at(0);
  EXPECT_TRUE(row.at("limit").is_null());
  EXPECT_EQ(row.at("frames"), judged);
  ASSERT_GT(measured, 0.0);
  EXPECT_NEAR(row.at("measured"), measured / judged, 1e-9);
  EXPECT_EQ(row.at("frames_changed"), 0U);
}

TEST(MotionTrials, ALimitThatNoFrameReachesLosesThemAll) {
  const json rows = kRuns.rows("--sweep", "matched=1000000");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_GT(rows[0].at("measured"), 0.0);
  EXPECT_EQ(rows[1].at("limit"), 1e6);
  EXPECT_EQ(rows[1].at("lost"), 1.0);
  EXPECT_GT(rows[1].at("gate").at("asked"), 0U);
  EXPECT_EQ(rows[1].at("gate").at("not_passed"), rows[1].at("gate").at("asked"));
  EXPECT_GT(rows[1].at("frames_changed"), 0U);
}

TEST(MotionTrials, LeaveTheTableAsItWas) {
  EXPECT_EQ(kRuns.rows("--sweep", "evidence=100").at(0), kRuns.rows("--sweep", "evidence=3").at(0));
}

TEST(MotionTrials, WithoutAGateWhatItStoppedGoesOn) {
  const json swept = kRuns.rows("--sweep", "evidence=100"), rows = kRuns.rows("--ablate", "evidence,contrast");
  EXPECT_EQ(swept.at(1).at("measured"), 0.0) << "no rock prefers its place by 100 deviations";
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].at("without"), "");
  EXPECT_EQ(rows[1].at("without"), "evidence, contrast");
  EXPECT_GE(rows[1].at("measured"), rows[0].at("measured"));
  EXPECT_GT(rows[1].at("gate").at("not_passed"), 0U) << "it judges as before";
}

TEST(MotionTrials, EachGateAloneHasARow) {
  const json rows = kRuns.rows("--ablate", "each");
  ASSERT_EQ(rows.size(), 1U + POSE_WALL_MOTION_TRACE_GATES);
  std::set<std::string> names;
  for (const json& row : rows) names.insert(row.at("without").get<std::string>());
  EXPECT_EQ(names.size(), rows.size());
}

TEST(MotionTrials, TwoJobsPrintTheSameAsOne) {
  const Ran one = kRuns.with({"--sweep", "reach=0.1,1.5", "--jobs", "1"});
  EXPECT_EQ(one.exit_status, 0) << one.errors;
  EXPECT_TRUE(contains(one.printed, "table: 1.5")) << one.printed;
  EXPECT_TRUE(contains(one.printed, "at most, in ratio")) << one.printed;
  EXPECT_EQ(one.printed, kRuns.with({"--sweep", "reach=0.1,1.5", "--jobs", "2"}).printed);
}

TEST(MotionTrials, WhatCannotBeTriedIsRefusedByName) {
  kRuns.expect_refused("--sweep", {{"wall_length=1", "'wall_length' is no gate of the motion library"},
                                   {"nothing=1", "these are: observations, in_time"},
                                   {"matched", "has no limits"},
                                   {"matched=", "'' is refused"},
                                   {"matched=few", "'few' is refused"},
                                   {"matched=-1", "'-1' is refused"},
                                   {"matched=1e10", "'1e10' is refused"}});
  kRuns.expect_refused("--ablate", {{"wall_low", "'wall_low' is no gate of the motion library"}});
  EXPECT_EQ(kRuns.with({"--sweep", "matched=1", "--output", "folder"}).exit_status, 2) << "it leaves no records";
}

TEST(MotionTrials, EveryGateSaysWhatItIs) {
  for (std::uint32_t gate = 0; gate < POSE_WALL_MOTION_TRACE_GATES; ++gate) {
    const pose_wall_motion_trace_info info = campaign::motion_gate(gate);
    for (const char* text : {info.name, info.sense, info.limit, info.unit, info.origin, info.asks}) {
      EXPECT_STRNE(text, "") << info.name;
    }
    EXPECT_EQ(pose_wall_motion_trace_set_limit(gate, -1.0), POSE_WALL_E_VALUE_RANGE);
  }
  EXPECT_EQ(pose_wall_motion_trace_set_limit(POSE_WALL_MOTION_TRACE_GATES, 1.0), POSE_WALL_E_INDEX);
  EXPECT_EQ(pose_wall_motion_trace_let_pass(POSE_WALL_MOTION_TRACE_GATES), POSE_WALL_E_INDEX);
  pose_wall_motion_trace_info info{};
  EXPECT_EQ(pose_wall_motion_trace_gate_info(POSE_WALL_MOTION_TRACE_GATES, &info), POSE_WALL_E_INDEX);
  EXPECT_EQ(pose_wall_motion_trace_gate_info(0, nullptr), POSE_WALL_E_NULL);
}

}  // namespace
}  // namespace pose_wall::tools
