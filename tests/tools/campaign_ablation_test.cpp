// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: without a gate that guards against a wrong value the table shows the wrong value. Gates that never fail
// change nothing, nor does the order of work. Gates that are named together go together. Afterwards all gates stop
// frames again. What cannot be left out is refused by name. Does not prove: that a gate without effect on these runs
// has none on others.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "campaign_tables.hpp"
#include "lab/campaign/ablation.hpp"
#include "study/explain/gate_list.hpp"

namespace pose_wall::tools {
namespace {

using nlohmann::json;
using test::contains;
using test::Ran;

// A sensor that repeats its cloud under new stamps: the true pose moves on.
const test::CampaignRuns kAblatedRuns({"--scenes", "frozen,clean", "--sensors", "vlp16", "--draws", "1", "--frames",
                                       "25", "--quiet"});

// One valid value, 0 off the truth.
campaign::FrameRecord right_frame() {
  campaign::FrameRecord frame;
  for (campaign::QuantityRecord& q : frame.quantity) q = {0.0, {0.0, 0.0, 0.01, 0.1, POSE_WALL_VALID}, 0U};
  return frame;
}

TEST(GateWorth, CountsWhatBecomesWrongAndWhatBecomesRight) {
  const AlertLimits limits{0.0175, 0.2};
  campaign::FrameRecord wrong = right_frame();
  wrong.quantity[POSE_WALL_D_LF].measured.value = 0.3;
  campaign::FrameRecord held = right_frame();
  held.quantity[POSE_WALL_YAW].measured.state = POSE_WALL_HELD;

  campaign::GateWorth none;
  none.add(right_frame(), right_frame(), limits);
  EXPECT_EQ(none.frames_changed, 0U);
  EXPECT_EQ(none.values.wrong_more(), 0U);

  campaign::GateWorth needed;
  needed.add(right_frame(), wrong, limits);
  needed.add(wrong, right_frame(), limits);
  EXPECT_EQ(needed.frames_changed, 2U);
  EXPECT_EQ(needed.values.misleading.more, 1U);
  EXPECT_EQ(needed.values.misleading.fewer, 1U);
  EXPECT_EQ(needed.values.beyond.more, 1U);
  EXPECT_EQ(needed.values.wrong_more(), 2U);

  campaign::GateWorth dear;
  dear.add(held, right_frame(), limits);
  dear.add(right_frame(), held, limits);
  dear.add(held, right_frame(), limits);
  EXPECT_EQ(dear.values.valid.more, 2U);
  EXPECT_EQ(dear.values.valid.fewer, 1U);
  EXPECT_EQ(dear.values.wrong_more(), 0U);
}

TEST(Ablation, WithoutTheGatesOfARepeatedCloudOldValuesAreValid) {
  const json row = kAblatedRuns.rows("--ablate", "repeated,frozen").at(0);
  EXPECT_EQ(row.at("without"), "repeated, frozen");
  EXPECT_GT(row.at("frames_failed"), 0U);
  EXPECT_GT(row.at("valid_gained"), 0U);
  EXPECT_EQ(row.at("runs_failed"), 1U) << "the clean scene does not repeat";
}

TEST(Ablation, EachGateHasARowAndThoseThatNeverFailChangeNothing) {
  const json rows = kAblatedRuns.rows("--ablate", "each");
  ASSERT_EQ(rows.size(), explain::gate_list().size() - 1) << "all but floor_planes";
  bool changed = false, idle = false;
  for (const json& row : rows) {
    changed = changed || row.at("frames_changed") > 0U;
    if (row.at("frames_failed") > 0U) continue;
    idle = true;
    EXPECT_EQ(row.at("frames_changed"), 0U) << row.at("without");
  }
  EXPECT_TRUE(changed);
  EXPECT_TRUE(idle);
}

TEST(Ablation, LeavesTheGatesAsTheyWereAndPrintsTheSameWithTwoJobs) {
  const Ran one = kAblatedRuns.with({"--ablate", "repeated", "--jobs", "1"});
  EXPECT_TRUE(contains(one.printed, "repeated")) << one.printed << one.errors;
  EXPECT_EQ(one.printed, kAblatedRuns.with({"--ablate", "repeated", "--jobs", "2"}).printed);
}

TEST(Ablation, WhatCannotBeLeftOutIsRefusedByName) {
  kAblatedRuns.expect_refused(
      "--ablate", {
                      {"wall_lenght", "'wall_lenght' is no gate; did you mean 'wall_length'?"},
                      {"zzz", "'zzz' is no gate; 'each' and the names of `pose_wall explain --gates` are allowed"},
                      {"wall_low,", "'' is no gate"},
                      {"floor_planes", "floor_planes cannot go: the fit needs a plane"},
                      {",", "'' is no gate"},
                  });
  EXPECT_EQ(kAblatedRuns.with({"--ablate", "wall_low", "--sweep", "wall_low=0"}).exit_status, 2)
      << "one table at a time";
  EXPECT_EQ(kAblatedRuns.with({"--ablate", "wall_low", "--output", "folder"}).exit_status, 2);
}

}  // namespace
}  // namespace pose_wall::tools
