// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the traced engine gives the plain engine's bits over a sequence whose memory it carries on by itself. A
// sweep's first row is what a card says of the same runs. Another limit changes what the gate lets pass, and only while
// it is swept. What cannot be swept is refused by name. Does not prove: that a limit of the table is the right one.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "campaign_tables.hpp"
#include "ran_command.hpp"
#include "study/explain/gate_list.hpp"
#include "study/explain/traced_frame.hpp"
#include "support/sim_run.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using nlohmann::json;
using namespace test;

// Two draws of four frames of two scenes that a sparse sensor sees.
const test::CampaignRuns kSweptRuns({"--scenes", "clean,partial", "--sensors", "vlp16", "--draws", "2", "--frames", "4",
                                     "--quiet"});

json swept(const std::string& what, const test::CampaignRuns& runs = kSweptRuns) {
  return runs.rows("--sweep", what);
}

class TracedSequence : public ::testing::TestWithParam<const char*> {};

TEST_P(TracedSequence, HasTheBitsOfTheEngineThatIsDelivered) {
  const sim::SceneSetup setup = sim::make_setup(GetParam(), "vlp16", false, 1);
  const sim::Simulator simulator(setup, 1);
  api::Config config;
  *config.get() = pose_wall::test::config_for(setup, pose_wall::test::sparse_config());
  pose_wall::test::EngineUnderTest plain(*config.get());
  TracedEngine traced;
  ASSERT_EQ(traced.open(config), POSE_WALL_OK);
  for (std::uint32_t i = 0; i < 22; ++i) {
    const sim::Frame frame = simulator.render(i);
    pose_wall_result result = api::make_result();
    ASSERT_EQ(traced.process(pose_wall::test::cloud_of(frame), result), POSE_WALL_OK);
    ASSERT_TRUE(same_bits(plain.process(pose_wall::test::cloud_of(frame)), result)) << "frame " << i;
    EXPECT_GT(traced.trace().gates, 0U);
  }
}

// What is held, repeated, or of another time is where a memory that is not carried on would show.
INSTANTIATE_TEST_SUITE_P(Scenes, TracedSequence,
                         ::testing::Values("nominal", "wall_lost", "frozen", "stamp_jump", "turn_step"));

TEST(TracedSequence, BeginsAnewWhenItIsOpenedAgain) {
  const sim::SceneSetup setup = sim::make_setup("nominal", "vlp16", false, 1);
  const sim::Simulator simulator(setup, 1);
  api::Config config;
  *config.get() = pose_wall::test::config_for(setup, pose_wall::test::sparse_config());
  TracedEngine engine;
  std::vector<pose_wall_result> first(2, api::make_result());
  for (pose_wall_result& result : first) {
    ASSERT_EQ(engine.open(config), POSE_WALL_OK);
    ASSERT_EQ(engine.process(pose_wall::test::cloud_of(simulator.render(0)), result), POSE_WALL_OK);
  }
  EXPECT_TRUE(same_bits(first[0], first[1]));
}

TEST(Sweep, TheTablesLimitIsWhatTheCardSays) {
  const TempFolder folder;
  ASSERT_EQ(kSweptRuns.with({"--set", "motion=off", "--scans", "instant", "--output", folder.path()}).exit_status, 0);
  const json card = json::parse(text_of(folder.file("card.json"))).at("totals").at("both");
  const json row = swept("wall_length=1.5").at(0);
  EXPECT_TRUE(row.at("limit").is_null());
  EXPECT_EQ(row.at("frames"), card.at("counts").at("frames"));
  for (const char* count : {"misleading", "value_beyond_protection", "raw_beyond_protection"}) {
    EXPECT_EQ(row.at(count), card.at("counts").at(count).at("frames")) << count;
  }
  EXPECT_EQ(row.at("degraded"), card.at("shares").at("degraded"));
  const json& valid = card.at("quantities");
  const auto share = [&valid](const char* q) { return valid.at(q).at("shares").at("valid").get<double>(); };
  EXPECT_GT(row.at("valid_angles"), 0.0) << "or nothing is compared";
  EXPECT_NEAR(row.at("valid_angles"), (share("roll") + share("pitch") + share("yaw")) / 3.0, 1e-12);
}

TEST(Sweep, ALimitThatNoWallReachesRefusesAllWalls) {
  const json rows = swept("wall_length=100");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_LT(rows[0].at("gate").at("not_passed"), rows[0].at("gate").at("asked"));
  EXPECT_GT(rows[0].at("valid_distances"), 0.0);
  EXPECT_EQ(rows[1].at("limit"), 100.0);
  EXPECT_EQ(rows[1].at("gate").at("limit_least"), 100.0);
  EXPECT_GT(rows[1].at("gate").at("asked"), 0U);
  EXPECT_EQ(rows[1].at("gate").at("not_passed"), rows[1].at("gate").at("asked"));
  EXPECT_EQ(rows[1].at("valid_distances"), 0.0);
  EXPECT_EQ(rows[0].at("frames_changed"), 0U);
  EXPECT_EQ(rows[1].at("frames_changed"), rows[1].at("frames"));
  EXPECT_LT(rows[1].at("valid_angles"), rows[0].at("valid_angles")) << "yaw is the walls'";
  EXPECT_GT(rows[1].at("valid_angles"), 0.0) << "roll and pitch are the floor's";
}

TEST(Sweep, LeavesTheTableAsItWas) {
  EXPECT_EQ(swept("wall_length=100").at(0), swept("wall_length=50").at(0));
}

TEST(Sweep, TwoJobsPrintTheSameAsOne) {
  const Ran one = kSweptRuns.with({"--sweep", "wall_length=3,100", "--jobs", "1"});
  EXPECT_EQ(one.exit_status, 0) << one.errors;
  EXPECT_TRUE(contains(one.printed, "wall_length: supported along the road")) << one.printed;
  EXPECT_TRUE(contains(one.printed, "table: 2 ")) << one.printed;
  EXPECT_EQ(one.printed, kSweptRuns.with({"--sweep", "wall_length=3,100", "--jobs", "2"}).printed);
}

TEST(Sweep, AGateWhoseLimitEachFrameTellsTakesOneForAll) {
  const json rows = swept("protection_smoothed=0,1e9");
  EXPECT_EQ(rows.at(1).at("valid_angles"), 0.0) << "no level is that small";
  EXPECT_EQ(rows.at(2).at("gate").at("not_passed"), 0U);
  EXPECT_GT(rows.at(0).at("gate").at("asked"), 0U);
}

TEST(Sweep, ABareYesOrNoLetsEverythingPassWithZero) {
  const test::CampaignRuns runs(
      {"--scenes", "stamp_still", "--sensors", "vlp16", "--draws", "1", "--frames", "14", "-q"});
  const json rows = swept("stamp_still=0,1", runs);
  EXPECT_GT(rows.at(0).at("gate").at("not_passed"), 0U);
  EXPECT_EQ(rows.at(1).at("gate").at("not_passed"), 0U);
  json one = rows.at(2);
  one["limit"] = nullptr;
  EXPECT_EQ(one, rows.at(0)) << "1 is what the table has";
}

TEST(Sweep, WhatCannotBeSweptIsRefusedByName) {
  kSweptRuns.expect_refused(
      "--sweep",
      {
          {"wall_lenght=1", "'wall_lenght' is no gate; did you mean 'wall_length'?"},
          {"=1", "'' is no gate; `pose_wall explain --gates` lists them"},
          {"wall_length", "has no limits; GATE=A,B,... is asked for: numbers in m"},
          {"wall_length=", "wall_length: '' is refused; numbers in m, separated by commas, are allowed"},
          {"wall_length=1,,2", "'' is refused"},
          {"wall_length=1,two", "'two' is refused; numbers in m"},
          {"wall_length=nan", "'nan' is refused"},
          {"wall_length=1e999", "'1e999' is refused"},
          {"floor_planes=0", "'0' is refused; numbers from 1"},
          {"wall_low=0.5", "'0.5' is refused; 0 (it lets everything pass) and 1 (as in the table) are allowed"},
      });
}

TEST(Sweep, WhatCannotGoWithItIsRefusedByName) {
  const TempFolder folder;
  EXPECT_TRUE(test::says(kSweptRuns.with({"--sweep", "wall_length=1", "--output", folder.path(), "--gate"}), 2,
                         "--output, --gate cannot go with it"));
  EXPECT_EQ(kSweptRuns.with({"--sweep", "wall_length=1", "--motion"}).exit_status, 2);
  EXPECT_EQ(kSweptRuns.with({"--sweep", "wall_length=1", "--sweep", "wall_lean=1"}).exit_status, 2)
      << "one gate at a time";
  EXPECT_TRUE(test::says(kSweptRuns.with({"--json", "--output", folder.path()}), 2, "--json needs --sweep"));
}

TEST(GateList, TellsEveryGateWithItsLimitAndNeedsNoFrame) {
  const Ran ran = command({"explain", "--gates"});
  EXPECT_EQ(ran.exit_status, 0) << ran.errors;
  for (const pose_wall_trace_info& gate : explain::gate_list()) {
    EXPECT_TRUE(contains(ran.printed, std::string("\n") + gate.name + " ")) << gate.name;
    EXPECT_TRUE(contains(ran.printed, std::string(gate.asks) + " (" + gate.origin + ")\n")) << gate.name;
  }
  EXPECT_TRUE(contains(ran.printed, "at least wall_length_min "));
  EXPECT_FALSE(contains(ran.printed, "s.wall_length_min"));
}

TEST(GateList, RefusesWhatItWouldPassOver) {
  const std::pair<std::vector<std::string>, const char*> usage[] = {
      {{"explain", "--gates", "-c", "vlp16", "--set", "range_min=1", "a.pcd"}, "leave out INPUT, --config, --set"},
      {{"explain", "--json", "--gates"}, "leave out --json"},
      {{"explain", "--gates", "--jsno"}, "unknown option --jsno"}};
  for (const auto& [words, answer] : usage) {
    const Ran ran = command(words);
    EXPECT_EQ(ran.exit_status, 2);
    EXPECT_EQ(ran.printed, "");
    EXPECT_TRUE(contains(ran.errors, answer)) << ran.errors;
  }
  EXPECT_EQ(command({"explain", "--gates", "--language", "en"}).exit_status, 0);
}

}  // namespace
}  // namespace pose_wall::tools
