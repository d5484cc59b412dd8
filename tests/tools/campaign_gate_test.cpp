// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the gate lets a flawless campaign pass and names each demand that a doctored one breaks.

#include "lab/campaign/gate.hpp"
#include "test_files.hpp"

#include <gtest/gtest.h>

#include "campaign_records.hpp"

namespace pose_wall::tools::campaign {
namespace {

using namespace test;

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
  std::vector<RunRecord> records;
  for (std::uint32_t draw = 0; draw < 60; ++draw) records.push_back(good_run("clean", draw, 2));
  EXPECT_EQ(faults_of(records), "");
  for (std::size_t i = 0; i < 12; ++i) {
    for (auto& frame : records[i].frames) frame.quantity[POSE_WALL_PITCH].measured.state = POSE_WALL_DEGRADED;
  }
  const std::string faults = faults_of(records);
  EXPECT_TRUE(contains(faults, "clean os1-64: pitch valid in 80 % of 120 values; the floor is 9")) << faults;
  EXPECT_TRUE(contains(faults, "nominal classes, sensor os1-64: pitch valid in 80 %")) << faults;
  EXPECT_FALSE(contains(faults, "roll")) << faults;
}

TEST(CampaignGate, FewRunsMayScatterMore) {
  RunRecord run = good_run("clean", 0, 50);
  for (auto& frame : run.frames) frame.quantity[POSE_WALL_PITCH].measured.state = POSE_WALL_DEGRADED;
  EXPECT_EQ(faults_of({run}), "") << "one run may be lost";
}

TEST(CampaignGate, ManyClassesTogetherTellWhatNoneTellsAlone) {
  std::vector<RunRecord> records;
  for (const ClassShares& one : valid_shares()) {
    if (one.sensor != "os1-64") continue;
    records.push_back(good_run(std::string(one.scene), 0, 1));
    records.back().frames[0].quantity[POSE_WALL_ROLL].measured.state = POSE_WALL_DEGRADED;
  }
  ASSERT_GT(records.size(), 70U);
  const std::string faults = faults_of(records);
  EXPECT_TRUE(contains(faults, "adversarial classes, sensor os1-64: roll valid in 0 %")) << faults;
  EXPECT_FALSE(contains(faults, "clean os1-64:")) << faults;
}

TEST(CampaignGate, SequencesCutShortHaveNoFloor) {
  RunRecord run = good_run("frozen", 0, 3);
  for (std::uint32_t draw = 1; draw < 40; ++draw) EXPECT_TRUE(is_cut({"frozen", "os1-64", draw, draw, 3}));
  EXPECT_FALSE(is_cut({"frozen", "os1-64", 0, 7, 200}));
  EXPECT_FALSE(is_cut({"clean", "os1-64", 0, 7, 1})) << "nothing happens in it";
  for (auto& frame : run.frames) frame.quantity[POSE_WALL_YAW].measured.state = POSE_WALL_DEGRADED;
  const Card card = card_of(std::vector<RunRecord>(40, run));
  EXPECT_EQ(valid_counts(card.classes.front())[2].values(), 0U);
  EXPECT_EQ(joined(gate_faults(card)), "");
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
