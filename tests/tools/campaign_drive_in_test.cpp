// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a campaign that drives in before its scenes plans, records, repeats and merges its runs with the way in, and
// the card's shares leave the way out while its counts of what is wrong do not. Does not prove: that memory helps.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "campaign_records.hpp"
#include "event_command.hpp"
#include "io/csv/csv_table.hpp"
#include "lab/campaign/card_files.hpp"
#include "lab/campaign/card_words.hpp"
#include "lab/campaign/command_words.hpp"
#include "lab/campaign/folder.hpp"
#include "lab/campaign/part.hpp"
#include "lab/campaign/recipe.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using campaign::Phase;
using campaign::PlanRequest;
using campaign::RunRecord;
using namespace test;

using Runs = std::vector<campaign::Run>;

PlanRequest driven_request(double drive_in_m) {
  PlanRequest request;
  request.scenes = {"clean", "wall_lost", "duplicated"};
  request.drive_in_m = drive_in_m;
  return request;
}

TEST(CampaignDriveIn, TheWayComesBeforeTheSceneAsItIsDrawnWithout) {
  const Runs at_once = make_plan(driven_request(0.0)), driven = make_plan(driven_request(2.0));
  ASSERT_EQ(driven.size(), at_once.size());
  for (std::size_t i = 0; i < driven.size(); ++i) {
    EXPECT_EQ(driven[i].seed, at_once[i].seed);
    EXPECT_EQ(driven[i].frames, at_once[i].frames);
    EXPECT_EQ(driven[i].drive_in_frames, 25U) << "at 0.8 m/s and 10 Hz";
    EXPECT_EQ(frames_of(driven[i]), frames_of(at_once[i]) + 25U);
    EXPECT_EQ(setup_of(driven[i]).machine.drive_in_m, 2.0);
    EXPECT_EQ(setup_of(driven[i]).rock.rock_repeats, 0.0);
    EXPECT_EQ(driven[i].settings, at_once[i].settings);
  }
  EXPECT_EQ(frames_of(driven), frames_of(at_once) + 25U * driven.size());
}

TEST(CampaignDriveIn, CampaignsOfOtherWaysDiffer) {
  const auto manifest_for = [](const PlanRequest& request) { return make_manifest(request, make_plan(request), {}); };
  const campaign::Manifest at_once = manifest_for(driven_request(0.0)), driven = manifest_for(driven_request(2.5));
  EXPECT_EQ(difference(at_once, driven), "  driven in: the records have 0 m, this campaign has 2.5 m\n");
  EXPECT_EQ(difference(driven, manifest_for(driven_request(2.5))), "");
  EXPECT_TRUE(contains(driven.command(), " --drive-in 2.5")) << driven.command();
  EXPECT_FALSE(contains(at_once.command(), "--drive-in")) << at_once.command();
}

// Frames of the way cost as much as others: a run of three frames costs nearly as much as one of sixty.
TEST(CampaignDriveIn, PartsCostAboutTheSame) {
  PlanRequest request;
  request.sensors = {"vlp16"};
  request.draws = 2;
  request.drive_in_m = 20.0;
  const Runs all = make_plan(request);
  std::size_t least = frames_of(all), most = 0;
  for (std::uint32_t number = 1; number <= 8; ++number) {
    const std::size_t frames = frames_of(runs_of_part(all, {number, 8}));
    least = std::min(least, frames);
    most = std::max(most, frames);
  }
  EXPECT_LT(static_cast<double>(most), 1.2 * static_cast<double>(least));
}

RunRecord driven_run(const std::string& scene, std::uint32_t way, std::uint32_t of_scene) {
  RunRecord run = test::good_run(scene, 1, way + of_scene);
  run.run.frames = of_scene;
  run.run.drive_in_frames = way;
  run.run.drive_in_m = 2.0;
  for (std::uint32_t i = 0; i < way; ++i) run.frames[i].phase = Phase::kDriveIn;
  return run;
}

campaign::Card card_of_driven(const std::vector<RunRecord>& records) {
  campaign::Manifest manifest = test::manifest_of(records);
  manifest.plan.drive_in_m = 2.0;
  return make_card(manifest, records, 10);
}

TEST(CampaignDriveIn, SharesAreOfTheSceneAlone) {
  RunRecord run = driven_run("clean", 6, 4);
  for (std::uint32_t i = 0; i < 6; ++i) {
    run.frames[i].quantity[POSE_WALL_YAW] = value_with_error(0.0, 0.01, 0.9, POSE_WALL_DEGRADED);
    run.frames[i].quantity[POSE_WALL_YAW].reasons = POSE_WALL_R_ALERT_LIMIT;
  }
  run.frames[9].quantity[POSE_WALL_YAW].measured.state = POSE_WALL_HELD;
  const campaign::Card card = card_of_driven({run});
  const campaign::ClassCard& one = card.classes.front();
  EXPECT_EQ(one.quantities[POSE_WALL_YAW].frames(), 4U);
  EXPECT_EQ(one.quantities[POSE_WALL_YAW].valid(), 3U);
  EXPECT_EQ(one.quantities[POSE_WALL_YAW].in_state(POSE_WALL_DEGRADED), 0U);
  EXPECT_EQ(campaign::reasons_text(one), "-") << "nothing but the way was kept back by a reason";
  EXPECT_DOUBLE_EQ(card.kinds.front().valid[2].share(), 0.75);
  for (const campaign::ScaledCounts& counts : card.nominal_curve) {
    EXPECT_EQ(counts.angles, 12U);
    EXPECT_EQ(counts.distances, 16U);
    EXPECT_EQ(counts.frames, 10U);
  }
}

TEST(CampaignDriveIn, AWrongValueOnTheWayCounts) {
  RunRecord run = driven_run("clean", 6, 4);
  run.frames[2].quantity[POSE_WALL_D_LF] = value_with_error(0.2, 0.01, 0.05);
  run.frames[3].quantity[POSE_WALL_D_LF] = value_with_error(0.3, 0.01, 0.05);
  const campaign::Card card = card_of_driven({run});
  EXPECT_EQ(card.nominal.frames.frames, 10U);
  EXPECT_EQ(card.nominal.frames.misleading, 2U);
  EXPECT_EQ(card.nominal.frames.value_beyond_protection, 2U);
  EXPECT_EQ(card.nominal.frames.raw_beyond_protection, 2U);
  EXPECT_EQ(card.nominal_curve[4].misleading, 2U) << "at factor 1";
  EXPECT_EQ(card.nominal_curve[4].beyond, 2U);
  EXPECT_EQ(card.distances.regions().misleading_if_valid, 2U);
  EXPECT_EQ(card.classes.front().times.alert_max, 2U);
  ASSERT_EQ(card.events.size(), 1U);
  EXPECT_EQ(card.events.front().frame, 3U);
  const std::string page = card_page(card);
  EXPECT_TRUE(contains(page, "The machine drove 2 m before each scene began.")) << page;
  EXPECT_TRUE(contains(page, "| misleading | clean | os1-64 | 1 | 3 (driving in) | d_lf |")) << page;
}

TEST(CampaignDriveIn, AnEventIsTimedFromItsOwnFrames) {
  RunRecord run = driven_run("wall_lost", 5, 15);
  for (std::size_t i = 5; i < 20; ++i) run.frames[i].phase = i < 10 ? Phase::kEvent : Phase::kAfter;
  for (std::size_t i = 7; i < 12; ++i) run.frames[i].quantity[POSE_WALL_D_LF].measured.state = POSE_WALL_HELD;
  campaign::EventTimes times;
  times.add(run, {test::kAngleLimit_rad, test::kDistanceLimit_m});
  EXPECT_EQ(times.noticed, std::vector<std::size_t>{2}) << "the last frame of the way is the one before the event";
  EXPECT_EQ(times.recovered, std::vector<std::size_t>{2});
}

TEST(CampaignDriveIn, EventsAreRepeatedByTheCampaignWithTheWay) {
  const auto command_of = [](std::size_t wrong) {
    RunRecord run = driven_run("props", 6, 4);
    run.frames[wrong].quantity[POSE_WALL_YAW] = value_with_error(0.02, 0.01, 0.0101);
    const campaign::Card card = card_of_driven({run});
    return recipe(card.events.at(0), card.manifest);
  };
  const std::string words = "pose_wall campaign --seed 1 --scenes props --sensors os1-64 --first-draw 1 --draws 1";
  EXPECT_EQ(command_of(8), words + " --frames 3 --drive-in 2 --output DIR");
  EXPECT_EQ(command_of(6), words + " --frames 1 --drive-in 2 --output DIR");
  EXPECT_EQ(command_of(4), words + " --frames 1 --drive-in 2 --output DIR") << "with the way, which has the frame";
}

// Two draws of two scenes, one with an event; seven frames of the way and two of the scene each.
Ran driven_campaign(const std::string& output, const std::vector<std::string>& more = {}) {
  return test::command({"campaign", "--output", output, "--scenes", "clean,partial", "--sensors", "vlp16", "--draws",
                        "2", "--frames", "2", "--drive-in", "0.5"},
                       more);
}

TEST(CampaignDriveIn, RecordsHaveThePhaseAndProgressCountsTheWay) {
  const TempFolder folder;
  const Ran ran = driven_campaign(folder.path());
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "4 runs, 36 frames; done already: 0 runs")) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "36 of 36 frames")) << ran.errors;
  const CsvTable frames = table_of(folder.file("frames.csv"));
  std::map<std::string, int> phases;
  for (std::size_t row = 0; row < frames.rows(); ++row) ++phases[frames.cell(row, *frames.find_column("phase"))];
  EXPECT_EQ(phases, (std::map<std::string, int>{{"drive_in", 28}, {"", 4}, {"before", 4}}));
  const campaign::Manifest manifest = campaign::read_manifest(folder.path());
  EXPECT_EQ(manifest.plan.drive_in_m, 0.5);
  const std::string card = test::text_of(folder.file("card.md"));
  EXPECT_TRUE(contains(card, "count the frames of the scenes alone: none from before the drive-in ended.")) << card;
  EXPECT_TRUE(contains(card, "worst events count all frames")) << card;
  for (const RunRecord& record : campaign::read_records(folder.path(), manifest)) {
    EXPECT_EQ(record.run.frames, 2U);
    EXPECT_EQ(record.run.drive_in_frames, 7U);
    EXPECT_EQ(record.run.drive_in_m, 0.5);
    EXPECT_EQ(campaign::is_cut(record.run), record.run.scene == "partial") << "the way does not make up for the scene";
  }
}

TEST(CampaignDriveIn, PartsMergeToWhatOneRunLeaves) {
  const TempFolder one, parts;
  ASSERT_EQ(driven_campaign(one.path(), {"--quiet"}).exit_status, 0);
  ASSERT_EQ(driven_campaign(parts.file("1"), {"--quiet", "--part", "1/2"}).exit_status, 0);
  ASSERT_EQ(driven_campaign(parts.file("2"), {"--quiet", "--part", "2/2"}).exit_status, 0);
  const auto merge = [&](const std::string& second, const std::string& output) {
    return test::command({"campaign", "--merge", parts.file("1"), parts.file(second), "--quiet", "--output", output});
  };
  ASSERT_EQ(merge("2", parts.file("whole")).exit_status, 0);
  for (const char* name : {"campaign.json", "frames.csv", "card.md", "card.json", "level_curve.csv"}) {
    EXPECT_EQ(text_of(parts.file("whole") + "/" + name), text_of(one.file(name))) << name;
  }
  std::vector<std::string> at_once = {"campaign", "--output",      parts.file("other"),
                                      "--scenes", "clean,partial", "--quiet"};
  at_once.insert(at_once.end(), {"--sensors", "vlp16", "--draws", "2", "--frames", "2", "--part", "2/2"});
  ASSERT_EQ(test::command(at_once).exit_status, 0);
  const Ran refused = merge("other", parts.file("mixed"));
  EXPECT_EQ(refused.exit_status, 2);
  EXPECT_TRUE(
      contains(refused.errors, "driven in: " + parts.file("1") + " has 0.5 m, " + parts.file("other") + " has 0 m"))
      << refused.errors;
}

TEST(CampaignDriveIn, TheCommandOfAnEventMeasuresItsFrameAgain) {
  for (const std::size_t wrong : {3U, 8U}) {
    const TempFolder folder, again;
    ASSERT_EQ(driven_campaign(folder.path(), {"--quiet", "--set", "integrity_risk=1e-9"}).exit_status, 0);
    test::run_all_of(test::command_of_event(folder.path(), 1, wrong, again.path()) + " --quiet");
    const CsvTable repeated = table_of(again.file("frames.csv"));
    ASSERT_GT(repeated.rows(), wrong);
    const CsvTable frames = table_of(folder.file("frames.csv"));
    const std::size_t row = frames.rows() / 4 + wrong;  // of the second of four records
    for (const char* column : {"stamp_ns", "roll", "roll_pl", "d_lf", "d_lf_raw", "yaw_state"}) {
      EXPECT_EQ(repeated.cell(wrong, *repeated.find_column(column)), frames.cell(row, *frames.find_column(column)))
          << column;
    }
  }
}

TEST(CampaignDriveIn, IsRefusedWhereItMeansNothing) {
  const TempFolder folder;
  const auto refused = [&folder](std::vector<std::string> words, const std::string& message) {
    words.insert(words.begin(), {"campaign", "--output", folder.file("card"), "--quiet"});
    const Ran ran = test::command(words);
    EXPECT_EQ(ran.exit_status, 2) << message;
    EXPECT_TRUE(contains(ran.errors, message)) << ran.errors;
    EXPECT_FALSE(std::filesystem::exists(folder.file("card")));
  };
  refused({"--motion", "--drive-in", "2"}, "--drive-in applies to scenes");
  refused({"--card-only", "--drive-in", "2"},
          "--card-only takes the records as they are: --drive-in cannot go with it");
  refused({"--merge", folder.path(), "--drive-in", "2"}, "--drive-in cannot go with it");
  for (const char* metres : {"100.5", "-1", "nan", "far"}) {
    refused({"--drive-in", metres}, "'" + std::string(metres) + "' is refused; a number from 0 to 100 is allowed");
  }
  EXPECT_TRUE(
      test::says(test::command({"campaign", "--sweep", "wall_length=1", "--scenes", "clean", "--drive-in", "2"}), 2,
                 "--drive-in cannot go with it"));
}

}  // namespace
}  // namespace pose_wall::tools
