// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Mine classes have two truths. Proves: what lies between them is not wrong, what lies beyond both is. Each is told by
// its name. Such classes have rows of their own, and a misleading value in them fails the gate. Records keep both. With
// `region: on` more values are valid in such roads, and none is wrong.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "campaign_records.hpp"
#include "lab/campaign/card_files.hpp"
#include "lab/campaign/card_sections.hpp"
#include "lab/campaign/gate.hpp"
#include "lab/campaign/plan.hpp"
#include "lab/campaign/runner.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/simulator.hpp"
#include "ran_command.hpp"
#include "study/motion/moving_engine.hpp"
#include "test_files.hpp"

namespace pose_wall::tools::test {
namespace {

using namespace campaign;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

QuantityRecord told(double raw, double road, double surveyed) {
  return {road, {raw, raw, 0.01, 0.015, POSE_WALL_VALID}, 0, surveyed};
}

TEST(MineTruths, WhatLiesBetweenIsNotWrong) {
  EXPECT_EQ(told(2.45, 2.4, 2.5).judged_truth(0.1), 2.45);
  EXPECT_EQ(told(2.45, 2.5, 2.4).judged_truth(0.1), 2.45);
  EXPECT_EQ(told(2.7, 2.4, 2.5).judged_truth(0.1), 2.5) << "beyond both, it is off the nearer one";
  EXPECT_EQ(told(2.1, 2.4, 2.5).judged_truth(0.1), 2.4);
}

// No crosscut makes everything right that lies between its mouth and its end.
TEST(MineTruths, BetweenTruthsOfTwoThingsIsNothing) {
  EXPECT_EQ(told(3.0, 2.4, 17.5).judged_truth(0.1), 2.4) << "the wall, and the end of a crosscut";
  EXPECT_EQ(told(17.0, 2.4, 17.5).judged_truth(0.1), 17.5);
}

// What the machine acts on is judged, held values too, and not what its frame measured.
TEST(MineTruths, AHeldValueIsJudgedByItself) {
  QuantityRecord held = told(2.9, 2.4, 2.5);
  held.measured.value = 2.45;
  EXPECT_EQ(held.judged_truth(0.1), 2.45);
}

TEST(MineTruths, OneAloneCounts) {
  EXPECT_EQ(told(2.45, 2.4, kNone).judged_truth(0.1), 2.4);
  EXPECT_EQ(told(2.45, kNone, 2.5).judged_truth(0.1), 2.5);
  EXPECT_TRUE(std::isnan(told(2.45, kNone, kNone).judged_truth(0.1)));
  EXPECT_EQ(told(kNone, 2.4, 2.5).judged_truth(0.1), 2.4) << "a value that is not there still has a truth";
}

RunRecord mine_run(double raw, double road, double surveyed) {
  RunRecord run = good_run("mine_blasted", 0, 2);
  for (auto& frame : run.frames) frame.quantity[POSE_WALL_D_LF] = told(raw, road, surveyed);
  return run;
}

TEST(MineTruths, ClassesHaveARowOfTheirOwn) {
  const Card card = card_of({mine_run(2.45, 2.4, 2.5), good_run("clean", 0, 3)});
  EXPECT_EQ(card.mine.frames.frames, 2U);
  EXPECT_EQ(card.mine.frames.misleading, 0U);
  EXPECT_EQ(card.judged.frames.frames, 3U) << "levels are made for the ideal road";
  ASSERT_FALSE(card.kinds.empty());
  EXPECT_EQ(card.kinds.front().kind, sim::SceneKind::kMine);
}

TEST(MineTruths, EachIsToldByItsName) {
  const Card card = card_of({mine_run(2.55, 2.4, 2.5)});  // 15 cm off the road, 5 cm off the rock
  const ClassCard& one = card.classes.front();
  EXPECT_EQ(one.by_road[POSE_WALL_D_LF].valid_beyond_alert(), 2U);
  EXPECT_EQ(one.by_survey[POSE_WALL_D_LF].valid_beyond_alert(), 0U);
  EXPECT_EQ(one.quantities[POSE_WALL_D_LF].valid_beyond_alert(), 0U);
  EXPECT_TRUE(
      contains(truths_section(card), "| mine_blasted | os1-64 | distances | 8 | 150.0 mm | 50.0 mm | 2 | 0 | 0 |"))
      << truths_section(card);
  EXPECT_EQ(truths_section(card_of({good_run("clean", 0, 3)})), "");
}

TEST(MineTruths, AValueBeyondBothFailsTheGate) {
  EXPECT_FALSE(contains(joined(gate_faults(card_of({mine_run(2.58, 2.4, 2.5)}))), "misleading"));
  EXPECT_TRUE(
      contains(joined(gate_faults(card_of({mine_run(2.65, 2.4, 2.5)}))), "mine classes: misleading frames: 2 of 2"));
}

TEST(MineTruths, ARecordKeepsBoth) {
  const TempFolder folder;
  const RunRecord run = mine_run(2.45, 2.4, 2.5);
  write_record(folder.file("r.csv"), run, "c");
  const QuantityRecord back = read_record(folder.file("r.csv"), "c").frames[1].quantity[POSE_WALL_D_LF];
  EXPECT_EQ(back.truth, 2.4);
  EXPECT_EQ(back.surveyed, 2.5);
  EXPECT_EQ(back.measured.raw, 2.45);
}

TEST(MineTruths, MeasuredRunsHaveBothAndWithoutRegionsThoseOfMinesAlone) {
  PlanRequest request;
  request.scenes = {"mine_cut", "clean"};
  request.sensors = {"vlp16"};
  request.draws = 1;
  request.frames = 1;
  const Instrument nothing = {[](const LoadedConfig&) { return std::int32_t{POSE_WALL_OK}; },
                              [](const pose_wall_cloud&, pose_wall_result&) { return std::int32_t{POSE_WALL_OK}; }};
  for (const bool regions : {true, false}) {
    const EngineChoice choice = {"", {regions ? "region=on" : "region=off"}};
    for (const auto& run : make_plan(request)) {
      const QuantityRecord q = measure(run, choice, nothing, [] {}).frames.front().quantity[POSE_WALL_D_LF];
      EXPECT_TRUE(std::isfinite(q.truth)) << run.scene;
      EXPECT_EQ(std::isfinite(q.surveyed), regions || run.scene == "mine_cut") << run.scene;
    }
  }
}

TEST(CampaignSurface, ARoadThatCannotBeReadIsNamed) {
  const TempFolder folder;
  const Ran ran =
      command({"campaign", "--scenes", "clean", "--surface", folder.file("none.ply"), "--output", folder.file("out")});
  EXPECT_NE(ran.exit_status, 0);
  EXPECT_TRUE(contains(ran.errors, "none.ply")) << ran.errors;
  const Ran motion = command({"campaign", "--motion", "--surface", "a.ply", "--output", folder.file("out")});
  EXPECT_TRUE(contains(motion.errors, "--surface")) << motion.errors;
  const Ran sim = command({"sim", "--scene", "surveyed", "--output", folder.file("sim")});
  EXPECT_TRUE(contains(sim.errors, "unknown scene 'surveyed'")) << sim.errors;
  const Ran named = command({"campaign", "--scenes", "surveyed", "--output", folder.file("named")});
  EXPECT_TRUE(contains(named.errors, "unknown scene 'surveyed'")) << named.errors;
}

// Values of a frame that are valid, and whether a wall is of the region beside the machine.
struct Counts {
  int valid = 0, of_region = 0;
};

Counts counts_in(const std::string& scene, const std::string& sensor, std::uint64_t seed, const char* region) {
  const sim::Setup setup = sim::make_setup(scene, sensor, false, seed);
  const sim::Simulator simulator(setup, seed);
  const LoadedConfig loaded = config_for(simulator.setup(), {"", {std::string("region=") + region}});
  MovingEngine engine;
  EXPECT_EQ(engine.open(loaded.config, loaded.motion), POSE_WALL_OK);
  const sim::Frame rendered = simulator.render(0);
  Frame frame = rendered_frame(rendered, false);
  frame.cloud.stamp_ns = rendered.stamp_ns;
  pose_wall_result result = api::make_result();
  EXPECT_EQ(engine.process(frame.cloud, result), POSE_WALL_OK);
  const TruthRow road = simulator.truth(0), surveyed = simulator.surveyed_truth(0);
  Counts counts;
  for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const pose_wall_value& value = result.quantity[q];
    if (value.state != POSE_WALL_VALID) continue;
    ++counts.valid;
    QuantityRecord record;
    record.truth = road.value[q];
    record.surveyed = surveyed.value[q];
    record.measured.value = record.measured.raw = value.value;
    const double limit = q <= POSE_WALL_YAW ? 0.01745 : 0.1;
    EXPECT_LE(std::abs(value.value - record.judged_truth(limit)), limit)
        << scene << ' ' << sensor << ' ' << seed << ", " << q << " with region " << region;
  }
  counts.of_region = result.left.extent_max_m == 2.5 || result.right.extent_max_m == 2.5 ? 1 : 0;
  return counts;
}

TEST(MineRegions, MakesMoreValidInRealRockAndNothingWrong) {
  int on = 0, off = 0, of_region = 0;
  for (const char* scene : {"mine_blasted", "mine_shotcrete", "mine_cut", "mine_lined"}) {
    for (const char* sensor : {"os1-64", "os0-128"}) {
      for (const std::uint64_t seed : {41U, 42U, 43U}) {
        const Counts with = counts_in(scene, sensor, seed, "on"), without = counts_in(scene, sensor, seed, "off");
        on += with.valid;
        of_region += with.of_region;
        off += without.valid;
        EXPECT_EQ(without.of_region, 0);
      }
    }
  }
  EXPECT_GT(on, off + 20) << "of 168 values";
  EXPECT_GT(of_region, 8) << "of 24 frames";
}

}  // namespace
}  // namespace pose_wall::tools::test
