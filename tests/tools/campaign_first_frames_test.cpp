// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the card tells first frames apart from later ones, and machines that stand from those that move; what is
// wrong in a first frame counts all the same. Frames that the work budget ended are counted, and the gate fails where
// they are too many of a kind or of a class. Sigma is judged where no motion is in a scan.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "campaign_records.hpp"
#include "lab/campaign/card_files.hpp"
#include "lab/campaign/gate.hpp"
#include "test_files.hpp"

namespace pose_wall::tools::campaign {
namespace {

using namespace test;

// The first of the frames is not valid in any value.
RunRecord begun_run(const std::string& scene, std::uint32_t draw, std::uint32_t frames, const char* speed) {
  RunRecord run = good_run(scene, draw, frames);
  run.run.settings = {"scan_s=0.1", speed};
  run.frames[0].phase = Phase::kFirst;
  for (QuantityRecord& q : run.frames[0].quantity) q.measured.state = POSE_WALL_DEGRADED;
  return run;
}

const FramesCard* row_of(const Card& card, const std::string& name) {
  for (const FramesCard& row : card.frames) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

double valid_share(const FramesCard* row) {
  return row == nullptr ? -1.0 : state_shares(row->quantities).valid;
}

TEST(CampaignFirstFrames, HaveARowOfTheirOwnAndAreInNoOtherShare) {
  const Card card = card_of({begun_run("clean", 0, 5, "speed_mps=0"), begun_run("clean", 1, 5, "speed_mps=2.5")});
  EXPECT_EQ(state_shares(card.nominal.quantities).valid, 1.0);
  EXPECT_EQ(card.kinds.front().valid[0].share(), 1.0);
  EXPECT_EQ(card.nominal_curve[4].valid_angles, card.nominal_curve[4].angles) << "at factor 1";
  EXPECT_EQ(card.nominal_curve[4].frames, 10U);
  ASSERT_EQ(card.frames.size(), 4U);
  EXPECT_EQ(valid_share(row_of(card, "first")), 0.0);
  EXPECT_EQ(row_of(card, "first")->frames, 2U);
  EXPECT_EQ(row_of(card, "later, standing")->frames, 4U);
  EXPECT_EQ(row_of(card, "later, moving")->frames, 4U);
  EXPECT_EQ(row_of(card, "all")->runs, 2U);
  EXPECT_DOUBLE_EQ(valid_share(row_of(card, "all")), 0.8);
  EXPECT_EQ(joined(gate_faults(card)), "");
  EXPECT_TRUE(contains(card_page(card), "| nominal | first | 2 | 2 | 0 % | 0 % | 0 % | 0 % |")) << card_page(card);
  EXPECT_TRUE(contains(card_page(card), "| nominal | all | 2 | 10 | 80.0 % |")) << card_page(card);
  const auto page = nlohmann::json::parse(card_json(card));
  EXPECT_EQ(page["frames"][0]["frames"], "first");
  EXPECT_EQ(page["frames"][0]["valid"]["yaw"]["share"], 0.0);
}

TEST(CampaignFirstFrames, StandingAndMovingAreToldApart) {
  RunRecord moving = begun_run("props", 1, 5, "speed_mps=2.5");
  for (FrameRecord& frame : moving.frames) frame.quantity[POSE_WALL_YAW].measured.state = POSE_WALL_HELD;
  const Card card = card_of({begun_run("props", 0, 5, "speed_mps=0"), moving});
  EXPECT_EQ(valid_share(row_of(card, "later, standing")), 1.0);
  EXPECT_DOUBLE_EQ(valid_share(row_of(card, "later, moving")), 6.0 / 7.0);
}

TEST(CampaignFirstFrames, WhatIsWrongInThemCounts) {
  RunRecord run = begun_run("clean", 0, 5, "speed_mps=0");
  run.frames[0].quantity[POSE_WALL_D_LF] = value_with_error(0.3, 0.01, 0.05);
  const Card card = card_of({run});
  EXPECT_EQ(card.nominal.frames.misleading, 1U);
  EXPECT_EQ(card.nominal.frames.value_beyond_protection, 1U);
  ASSERT_EQ(card.events.size(), 1U);
  EXPECT_EQ(card.events.front().frame, 0U);
  EXPECT_TRUE(contains(joined(gate_faults(card)), "misleading frames: 1 of 5"));
}

TEST(CampaignFirstFrames, SigmaIsJudgedWhereNoMotionIsInAScan) {
  const auto card_with = [](const std::vector<std::string>& settings) {
    RunRecord run = good_run("clean", 0, 2);
    run.run.settings = settings;
    for (FrameRecord& frame : run.frames) frame.quantity[POSE_WALL_YAW] = value_with_error(0.01, 0.005);
    std::vector<RunRecord> records(kRunsForMeanZ2, run);
    for (std::size_t i = 0; i < kRunsForMeanZ2; ++i) records.push_back(good_run("clean", 1, 2));
    return card_of(records);
  };
  const Card driving = card_with({"scan_s=0.1", "speed_mps=3"});
  EXPECT_EQ(joined(gate_faults(driving)), "");
  EXPECT_EQ(driving.nominal.straight_runs, kRunsForMeanZ2);
  EXPECT_DOUBLE_EQ(driving.nominal.quantities[POSE_WALL_YAW].mean_z2(), 2.5);
  EXPECT_TRUE(contains(card_page(driving), "| nominal, all | 400 | 1.00 | 1.00 | 2.50 |")) << card_page(driving);
  for (const std::vector<std::string>& straight :
       {std::vector<std::string>{}, {"scan_s=0.1", "speed_mps=0", "sway_roll_deg=0"}}) {
    EXPECT_TRUE(contains(joined(gate_faults(card_with(straight))), "mean z² of yaw is 2.50"));
  }
}

RunRecord limited_run(const std::string& scene, std::uint32_t draw, std::uint32_t frames, std::size_t limited) {
  RunRecord run = good_run(scene, draw, frames);
  for (std::size_t i = 0; i < limited; ++i) run.frames[i].reasons = POSE_WALL_R_WORK_LIMIT;
  return run;
}

TEST(CampaignWorkLimit, AFewFramesInAThousandMayMeetIt) {
  const Card card = card_of({limited_run("clean", 0, 1000, 5), limited_run("props", 0, 1000, 5)});
  EXPECT_EQ(card.nominal.frames.work_limited, 5U);
  EXPECT_EQ(card.judged.frames.work_limited, 10U);
  EXPECT_EQ(joined(gate_faults(card)), "");
  EXPECT_TRUE(contains(card_page(card), "| 5 (0.5 %) |")) << card_page(card);
  const auto page = nlohmann::json::parse(card_json(card));
  EXPECT_EQ(page["totals"]["both"]["counts"]["work_limited"]["frames"], 10);
}

TEST(CampaignWorkLimit, MoreOfAKindFailTheGate) {
  const std::string faults =
      joined(gate_faults(card_of({good_run("clean", 0, 1000), limited_run("props", 0, 1000, 6)})));
  EXPECT_TRUE(contains(faults, "adversarial classes: frames ended by the work budget (work_max): 6 of 1000")) << faults;
  EXPECT_FALSE(contains(faults, "all classes")) << faults;
  EXPECT_FALSE(contains(faults, "nominal")) << faults;
  const Card both = card_of({limited_run("clean", 0, 1000, 6), limited_run("props", 0, 1000, 6)});
  EXPECT_TRUE(
      contains(joined(gate_faults(both)), "all classes: frames ended by the work budget (work_max): 12 of 2000"));
}

TEST(CampaignWorkLimit, AClassCannotHideAmongAllOthers) {
  std::vector<RunRecord> records = {good_run("props", 0, 20000)};
  for (std::uint32_t draw = 0; draw < 24; ++draw) {
    records.push_back(limited_run("dusty_crosscut", draw, 5, draw < 2 ? 5 : 0));
  }
  const std::string faults = joined(gate_faults(card_of(records)));
  EXPECT_TRUE(contains(faults, "dusty_crosscut os1-64: frames ended by the work budget (work_max): 10 of 120"))
      << faults;
  EXPECT_FALSE(contains(faults, "adversarial")) << faults;
  records[2] = good_run("dusty_crosscut", 1, 5);
  EXPECT_EQ(joined(gate_faults(card_of(records))), "") << "one run of a class may be lost";
}

TEST(CampaignWorkLimit, AValuesReasonTellsItAsWell) {
  RunRecord run = good_run("clean", 0, 10);
  run.frames[3].quantity[POSE_WALL_D_RB].reasons = POSE_WALL_R_WORK_LIMIT;
  EXPECT_EQ(card_of({run}).nominal.frames.work_limited, 1U);
}

// Such roads made the engine run out of its budget in 19 of 20 frames.
TEST(CampaignWorkLimit, TheClassOfTheDearestRoadsHasAllThatCostsWork) {
  for (const char* sensor : {"os1-64", "vlp16"}) {
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      const sim::SceneSetup setup = sim::make_setup("dusty_crosscut", sensor, true, seed);
      EXPECT_NE(setup.openings.crosscut_side, 0.0);
      EXPECT_GE(setup.rock.roughness_m, 0.03);
      EXPECT_GE(setup.floor.floor_roughness_m, 0.03);
      EXPECT_GE(setup.faults.dust, 0.1);
    }
  }
}

}  // namespace
}  // namespace pose_wall::tools::campaign
