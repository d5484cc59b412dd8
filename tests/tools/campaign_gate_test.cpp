// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the gate lets a flawless campaign pass and names each demand that a doctored one breaks.

#include "campaign/gate.hpp"
#include "test_files.hpp"

#include <gtest/gtest.h>

#include "campaign_records.hpp"

namespace pose_wall::tools::campaign {
namespace {

using test::card_of;
using test::contains;
using test::good_run;
using test::joined;
using test::value_with_error;

std::string faults_of(const std::vector<RunRecord>& records) {
  return joined(gate_faults(card_of(records)));
}

TEST(CampaignGate, PassesWhenAllHolds) {
  EXPECT_EQ(faults_of({good_run("clean", 0, 50), good_run("props", 0, 50)}), "");
}

TEST(CampaignGate, OneMisleadingFrameAnywhereIsTooMany) {
  RunRecord run = good_run("props", 0, 5000);
  run.frames[4321].quantity[POSE_WALL_D_LB] = value_with_error(0.12, 0.02, 0.2);
  const std::string faults = faults_of({good_run("clean", 0, 50), run});
  EXPECT_TRUE(contains(faults, "misleading frames: 1 of 5050")) << faults;
  EXPECT_FALSE(contains(faults, "protection")) << faults;
}

TEST(CampaignGate, OneNominalErrorBeyondProtectionIsTooMany) {
  RunRecord run = good_run("clean", 0, 5000);
  run.frames[7].quantity[POSE_WALL_ROLL] = value_with_error(0.012, 0.01, 0.0119);
  const std::string faults = faults_of({run});
  EXPECT_TRUE(contains(faults, "nominal classes: frames with a raw error")) << faults;
  EXPECT_TRUE(contains(faults, "nominal classes: frames with a value error")) << faults;
}

TEST(CampaignGate, AdversarialErrorsMayBeRare) {
  RunRecord run = good_run("props", 0, 2000);
  run.frames[7].quantity[POSE_WALL_ROLL] = value_with_error(0.012, 0.01, 0.0119);
  EXPECT_EQ(faults_of({good_run("clean", 0, 50), run}), "");
  run.frames[9].quantity[POSE_WALL_YAW] = value_with_error(0.012, 0.01, 0.0119);
  const std::string faults = faults_of({good_run("clean", 0, 50), run});
  EXPECT_TRUE(contains(faults, "adversarial classes: frames with a raw error beyond the protection level: 2 of 2000"))
      << faults;
}

std::vector<RunRecord> runs_of(const RunRecord& one, std::size_t runs) {
  return std::vector<RunRecord>(runs, one);
}

TEST(CampaignGate, SigmaMustBeTrueOverNominalClasses) {
  RunRecord timid = good_run("clean", 0, 2);
  for (auto& frame : timid.frames) frame.quantity[POSE_WALL_PITCH] = value_with_error(0.01, 0.02);
  EXPECT_TRUE(contains(faults_of(runs_of(timid, kRunsForMeanZ2)), "mean z² of pitch is 0.25"));
  EXPECT_EQ(faults_of(runs_of(timid, kRunsForMeanZ2 - 1)), "");
  RunRecord boastful = good_run("clean", 0, 2);
  for (auto& frame : boastful.frames) frame.quantity[POSE_WALL_D_RF] = value_with_error(0.01, 0.005);
  EXPECT_TRUE(contains(faults_of(runs_of(boastful, kRunsForMeanZ2)), "mean z² of d_rf is 4.00"));
  boastful.run.scene = "props";
  EXPECT_EQ(faults_of(runs_of(boastful, kRunsForMeanZ2)), "");
}

TEST(CampaignGate, EachClassKeepsItsFloor) {
  ASSERT_GT(sim::find_scene("clean")->available_floor, 0.5);
  RunRecord run = good_run("clean", 0, 50);
  for (std::size_t i = 0; i < 25; ++i) {
    for (auto& q : run.frames[i].quantity) q.measured.state = POSE_WALL_HELD;
  }
  EXPECT_TRUE(contains(faults_of({run}), "clean os1-64: 50 % available; its floor is 99 %"));
  run.run.sensor = "vlp16";
  EXPECT_TRUE(contains(faults_of({run}), "clean vlp16: 50 % available; its floor is 96 %")) << "sixteen lines see less";
}

TEST(CampaignGate, WhatNobodyCanTellIsNotAsked) {
  RunRecord run = good_run("axes_swapped", 0, 50);
  for (auto& frame : run.frames) frame.quantity[POSE_WALL_YAW] = value_with_error(1.5);
  const Card card = card_of({good_run("clean", 0, 50), run});
  EXPECT_EQ(joined(gate_faults(card)), "");
  EXPECT_EQ(card.unobservable.frames.misleading, 50U);
  EXPECT_TRUE(card.events.empty());
  EXPECT_TRUE(contains(faults_of({run}), "no frame was judged")) << "nothing else was looked at";
}

TEST(CampaignGate, AnUnfinishedCampaignDoesNotPass) {
  const std::vector<RunRecord> records = {good_run("clean", 0, 50)};
  Manifest manifest = test::manifest_of(records);
  manifest.runs = 2;
  EXPECT_TRUE(contains(joined(gate_faults(make_card(manifest, records, 5))), "runs done 1 of 2"));
}

}  // namespace
}  // namespace pose_wall::tools::campaign
