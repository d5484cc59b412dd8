// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: in each class of a campaign scans take the sensor's turn; every second run drives, within the room that the
// scene has, and its scans are bent while the truth stays that of the stamp. All of it depends on the run alone, stands
// in its record, and `pose_wall sim` repeats it. Does not prove: that real machines move like this.

#include "lab/campaign/movement.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/config_file/key_table.hpp"
#include "lab/campaign/event.hpp"
#include "lab/campaign/folder.hpp"
#include "lab/campaign/manifest.hpp"
#include "lab/campaign/plan.hpp"
#include "lab/campaign/runner.hpp"
#include "lab/sim/check_setup.hpp"
#include "lab/sim/run_files.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/simulator.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools::campaign {
namespace {

using namespace test;

PlanRequest request_for(const std::vector<std::string>& scenes, std::uint32_t draws) {
  PlanRequest request;
  request.size = "large";
  request.scenes = scenes;
  request.draws = draws;
  return request;
}

void for_all_runs(const std::function<void(const Run&, const sim::SceneSetup&)>& expect) {
  for (const Run& run : make_plan(request_for({}, 4))) expect(run, setup_of(run));
}

bool names_speed(const std::string& scene) {
  const auto& values = sim::find_scene(scene)->values;
  return std::any_of(values.begin(), values.end(),
                     [](const auto& value) { return std::string(value.key) == "speed_mps"; });
}

TEST(CampaignMovement, EveryScanTakesTheSensorsTurn) {
  for_all_runs([](const auto& run, const sim::SceneSetup& setup) {
    const double period_s = 1.0 / setup.sequence.rate_hz;
    EXPECT_NO_THROW(sim::checked(setup)) << run.scene << " " << run.draw;
    EXPECT_LE(setup.sequence.scan_s, period_s) << run.scene;
    EXPECT_GE(setup.sequence.scan_s, period_s - 1e-4) << run.scene;
    EXPECT_EQ(setup.rock.rock_repeats, 0.0) << run.scene << ": the way along could be told wrong";
  });
}

TEST(CampaignMovement, NoMachineLeavesItsRoom) {
  for_all_runs([](const auto& run, const sim::SceneSetup& setup) {
    const double speed_mps = std::abs(setup.machine.speed_mps), rate_hz = setup.sequence.rate_hz;
    EXPECT_LE(speed_mps, 5.0) << run.scene;
    EXPECT_LE(speed_mps / rate_hz, 0.5 + 1e-9) << run.scene;
    const double way_m = std::abs(sim::pose_at(setup, frames_of(run) / rate_hz).along_m);
    EXPECT_LE(way_m, room_to_drive_m(setup) + 0.01) << run.scene << " " << run.sensor << " " << run.draw;
    if (names_speed(run.scene)) return;
    EXPECT_LE(std::abs(sim::pose_at(setup, 1000.0).along_m), room_to_drive_m(setup) + 0.01)
        << run.scene << ": in a run of many more frames";
  });
}

TEST(CampaignMovement, ThingsAtOnePlaceLeaveLittleRoom) {
  sim::SceneSetup setup;
  EXPECT_TRUE(std::isinf(room_to_drive_m(setup)));
  setup.road.face_distance_m = 1.0;
  EXPECT_EQ(room_to_drive_m(setup), 0.25);
  setup.road.face_distance_m = 8.0;
  EXPECT_EQ(room_to_drive_m(setup), 2.0);
  setup.openings.crosscut_side = sim::kSideLeft;
  EXPECT_EQ(room_to_drive_m(setup), 1.0);
}

TEST(CampaignMovement, EverySecondRunDrivesAndOneOfFourIsStill) {
  for (const char* sensor : {"os1-64", "vlp16"}) {
    PlanRequest request = request_for({"rough", "props", "wall_lost_long"}, 8);
    request.sensors = {sensor};
    const std::vector<campaign::Run> runs = make_plan(request);
    const auto count = [&runs](bool (*is)(const std::vector<std::string>&)) {
      return std::count_if(runs.begin(), runs.end(), [is](const auto& run) { return is(run.settings); });
    };
    EXPECT_EQ(count(stands), 12);
    EXPECT_EQ(count(has_straight_scans), 6);
  }
}

TEST(CampaignMovement, AMachineThatIsStillStaysWhereItIs) {
  for_all_runs([](const auto& run, const sim::SceneSetup& setup) {
    if (!has_straight_scans(run.settings)) return;
    const sim::Placement first = sim::place(setup, sim::pose_at(setup, 0.0));
    const sim::Placement later = sim::place(setup, sim::pose_at(setup, 0.77));
    EXPECT_EQ((first.origin_road - later.origin_road).norm(), 0.0) << run.scene;
    EXPECT_EQ((first.R_road_base - later.R_road_base).norm(), 0.0) << run.scene;
  });
}

TEST(CampaignMovement, AScenesOwnMotionIsKept) {
  for (const auto& run : make_plan(request_for({"frozen", "duplicated", "dropped", "face"}, 6))) {
    const sim::SceneSetup drawn = sim::make_setup(run.scene, run.sensor, true, run.seed);
    const sim::SceneSetup setup = setup_of(run);
    EXPECT_EQ(setup.machine.speed_mps, drawn.machine.speed_mps) << run.scene;
    EXPECT_EQ(setup.machine.turn_rate_dps, drawn.machine.turn_rate_dps) << run.scene;
    EXPECT_FALSE(stands(run.settings)) << run.scene;
  }
  for (const auto& run : make_plan(request_for({"turn_step"}, 6))) {
    const sim::SceneSetup setup = setup_of(run);
    EXPECT_GE(std::abs(setup.machine.turn_step_deg), 8.0);
    const double frames = setup.machine.turn_step_at_s * setup.sequence.rate_hz;
    EXPECT_NEAR(frames, std::round(frames), 1e-9) << "a jump in the midst of a scan is no motion of a machine";
  }
}

TEST(CampaignMovement, TellsTheEngineTheTopSpeedOfAFastMachine) {
  std::size_t fast = 0;
  for (const auto& run : make_plan(request_for({"rough"}, 24))) {
    const sim::SceneSetup setup = setup_of(run);
    const double speed_mps = std::abs(setup.machine.speed_mps);
    const LoadedConfig loaded = config_for(setup, {});
    EXPECT_GT(loaded.motion.speed_max_m_s, speed_mps);
    fast += loaded.motion.speed_max_m_s != default_motion_settings().speed_max_m_s ? 1U : 0U;
    EXPECT_EQ(loaded.motion.speed_max_m_s > 2.0, speed_mps > 1.8) << "others are as users have them";
  }
  EXPECT_GT(fast, 0U);
}

TEST(CampaignMovement, ADrivingMachineBendsItsScansAndTheTruthIsOfTheStamp) {
  for (const auto& run : make_plan(request_for({"rough"}, 2))) {
    sim::SceneSetup setup = setup_of(run);
    const sim::Simulator turning(setup, run.seed);
    setup.sequence.scan_s = 0.0;
    const sim::Simulator instant(setup, run.seed);
    const sim::Frame bent = turning.render(2), straight = instant.render(2);
    EXPECT_GT(*std::max_element(bent.time_ns.begin(), bent.time_ns.end()), 90000000U);
    for (std::size_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      EXPECT_EQ(turning.truth(2).value[q], instant.truth(2).value[q]);
    }
    if (stands(run.settings)) continue;
    const sim::MachinePose begin = turning.pose(2), end = sim::pose_at(setup, begin.time_s + 0.1);
    EXPECT_GT(std::abs(end.along_m - begin.along_m), 0.0);
    EXPECT_NE(bent.xyz_intensity, straight.xyz_intensity);
  }
}

TEST(CampaignMovement, DependsOnTheRunAloneHoweverManyFramesAreAskedFor) {
  PlanRequest request = request_for({"rough", "face", "wall_lost_long"}, 3);
  const std::vector<campaign::Run> large = make_plan(request);
  request.size = "medium";
  request.frames = 2;
  request.sensors = sensors_of(request_for({}, 1));
  const std::vector<campaign::Run> few = make_plan(request);
  ASSERT_EQ(few.size(), large.size());
  for (std::size_t i = 0; i < few.size(); ++i) EXPECT_EQ(few[i].settings, large[i].settings);
}

TEST(CampaignMovement, InstantScansAreOfTheSceneAsItIsDrawn) {
  PlanRequest request = request_for({}, 1);
  request.scans = Scans::kInstant;
  for (const auto& run : make_plan(request)) {
    EXPECT_TRUE(run.settings.empty());
    EXPECT_EQ(setup_of(run).sequence.scan_s, 0.0);
    EXPECT_EQ(setup_of(run).rock.rock_repeats,
              sim::make_setup(run.scene, run.sensor, true, run.seed).rock.rock_repeats);
  }
}

TEST(CampaignMovement, AnEventTouchesTheScanInWhichItBegins) {
  sim::SceneSetup setup;
  setup.faults.lost_side = sim::kSideLeft;
  setup.faults.lost_from_s = 1.05;
  setup.faults.lost_to_s = 2.0;
  EXPECT_EQ(event_of(setup)->first, 11U);
  setup.sequence.scan_s = 0.1;
  EXPECT_EQ(event_of(setup)->first, 10U);
  EXPECT_EQ(event_of(setup)->after, 20U);
}

TEST(CampaignMovement, OtherScansAreAnotherCampaign) {
  PlanRequest request = request_for({"clean"}, 1);
  const auto manifest_for = [](const PlanRequest& r) { return make_manifest(r, make_plan(r), {}); };
  const Manifest turning = manifest_for(request);
  request.scans = Scans::kInstant;
  const Manifest instant = manifest_for(request);
  EXPECT_EQ(difference(turning, instant), "  scans: the records have turning, this campaign has instant\n");
  EXPECT_TRUE(contains(instant.command(), " --scans instant")) << instant.command();
  EXPECT_FALSE(contains(turning.command(), "--scans")) << turning.command();
}

Ran campaign_in(const std::string& folder, const std::vector<std::string>& more) {
  return test::command(
      {"campaign", "--output", folder, "--quiet", "--scenes", "rough", "--draws", "2", "-n", "3", "--sensors", "vlp16"},
      more);
}

TEST(CampaignMovement, RecordsHoldHowTheMachineMovedAndTheFolderSaysHowItWasMeasured) {
  const TempFolder folder;
  ASSERT_EQ(campaign_in(folder.path(), {}).exit_status, 0);
  const Manifest manifest = read_manifest(folder.path());
  EXPECT_EQ(manifest.plan.scans, Scans::kTurning);
  EXPECT_TRUE(manifest.motion_is_on);
  const std::vector<campaign::Run> planned = make_plan(manifest.plan);
  const std::vector<RunRecord> records = read_records(folder.path(), manifest);
  ASSERT_EQ(records.size(), planned.size());
  for (std::size_t i = 0; i < records.size(); ++i) {
    EXPECT_EQ(records[i].run.settings, planned[i].settings);
    EXPECT_EQ(records[i].frames[0].phase, Phase::kFirst);
    EXPECT_EQ(records[i].frames[1].phase, Phase::kNone);
  }
  EXPECT_NE(stands(records[0].run.settings), stands(records[1].run.settings));
  const std::string card = test::text_of(folder.file("card.md"));
  EXPECT_TRUE(contains(card, "half of the runs drive. Motion is on.")) << card;
}

TEST(CampaignMovement, WhatIsMeasuredWithMotionOffSaysSo) {
  const TempFolder folder;
  ASSERT_EQ(campaign_in(folder.path(), {"--set", "motion=off"}).exit_status, 0);
  EXPECT_FALSE(read_manifest(folder.path()).motion_is_on);
  EXPECT_TRUE(contains(test::text_of(folder.file("card.md")), "Motion is off: the engine is alone"));
  EXPECT_TRUE(contains(test::text_of(folder.file("card.json")), "\"motion\": \"off\""));
  const std::vector<std::string> few = {"--scenes", "clean", "--sensors", "vlp16", "--draws", "1", "-n", "2", "-q"};
  for (const std::vector<std::string>& table :
       {std::vector<std::string>{"--sweep", "wall_length=1"}, std::vector<std::string>{"--ablate", "wall_length"}}) {
    std::vector<std::string> words = {"campaign", table[0], table[1]};
    words.insert(words.end(), few.begin(), few.end());
    const Ran instant = test::command(words);
    EXPECT_TRUE(contains(instant.printed, "Scans are of one instant, and points have no times. Motion is off"))
        << instant.printed;
    words.insert(words.end(), {"--scans", "turning"});
    EXPECT_TRUE(contains(test::command(words).printed, "nothing takes the motion out of a scan"));
  }
}

TEST(CampaignMovement, ScansAreRefusedWhereTheyMeanNothing) {
  const TempFolder folder;
  EXPECT_TRUE(test::says(campaign_in(folder.file("card"), {"--scans", "turnign"}), 2, "turning"));
  EXPECT_TRUE(test::says(test::command({"campaign", "--motion", "--scans", "instant", "-q", "-o", folder.file("card")}),
                         2, "--scans applies to scenes"));
  EXPECT_THROW(scans_named("still"), std::invalid_argument);
}

}  // namespace
}  // namespace pose_wall::tools::campaign
