// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: `campaign --motion` measures the same numbers each time, whatever the number of jobs, and as `pose_wall
// motion` does on files; it goes on where it stopped; its exit status is the gate's. Does not prove: how good they are.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "lab/campaign/motion_classes.hpp"
#include "lab/campaign/plan.hpp"
#include "lab/campaign/runner.hpp"
#include "lab/sim/simulator.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

Ran motion_campaign_in(const std::string& folder, const std::vector<std::string>& more = {}) {
  return command({"campaign", "--motion", "--output", folder, "--scenes", "rough,distorted", "--sensors", "vlp16",
                  "--frames", "6", "--quiet"},
                 more);
}

// All cells but times.
std::string numbers_of(const std::string& file) {
  const CsvTable table = table_of(file);
  const std::size_t time = table.find_column("total_ms").value();
  std::string text;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t column = 0; column < table.head().size(); ++column) {
      if (column != time) text += table.cell(row, column) + ",";
    }
    text += "\n";
  }
  return text;
}

TEST(MotionCampaign, TheSameSeedGivesTheSameNumbersWithOneJobOrTwo) {
  const TempFolder one, two, other;
  ASSERT_EQ(motion_campaign_in(one.path(), {"--jobs", "1"}).exit_status, 0);
  ASSERT_EQ(motion_campaign_in(two.path(), {"--jobs", "2"}).exit_status, 0);
  ASSERT_EQ(motion_campaign_in(other.path(), {"--seed", "2"}).exit_status, 0);
  for (const char* name : {"records/rough/vlp16/000000.csv", "records/distorted/vlp16/000000.csv"}) {
    const std::string numbers = numbers_of(one.file(name));
    EXPECT_EQ(std::count(numbers.begin(), numbers.end(), '\n'), 6) << name;
    EXPECT_EQ(numbers, numbers_of(two.file(name))) << name;
    EXPECT_NE(numbers, numbers_of(other.file(name))) << name;
  }
}

// As the card's commands do it.
TEST(MotionCampaign, ARunByItselfIsTheRunAmongOthers) {
  const TempFolder all, alone;
  ASSERT_EQ(motion_campaign_in(all.path(), {"--draws", "2"}).exit_status, 0);
  ASSERT_EQ(command({"campaign", "--motion", "--seed", "1", "--scenes", "rough", "--sensors", "vlp16", "--first-draw",
                     "1", "--draws", "1", "--frames", "4", "--output", alone.path(), "--quiet"})
                .exit_status,
            0);
  const char* const name = "records/rough/vlp16/000001.csv";
  const std::string among = numbers_of(all.file(name)), by_itself = numbers_of(alone.file(name));
  EXPECT_EQ(std::count(by_itself.begin(), by_itself.end(), '\n'), 4);
  EXPECT_EQ(among.substr(0, by_itself.size()), by_itself);
}

// A frame in memory is the frame of the file, times and rings included.
TEST(MotionCampaign, AFrameIsAsTheSimulatorWritesIt) {
  const campaign::MotionClass& distorted = *campaign::find_motion_class("distorted");
  const sim::Simulator simulator(campaign::make_motion_setup(distorted, "vlp16", 3), 3);
  const sim::Frame rendered = simulator.render(1);
  const Frame timed = campaign::rendered_frame(rendered, true), plain = campaign::rendered_frame(rendered, false);
  EXPECT_EQ(timed.cloud.width * timed.cloud.height, rendered.count());
  EXPECT_NE(timed.cloud.time.type, 0U);
  EXPECT_NE(timed.cloud.ring.type, 0U);
  EXPECT_EQ(plain.cloud.time.type, 0U);
  for (const Frame* frame : {&timed, &plain}) {
    for (const std::uint32_t i : {0U, 1U, static_cast<std::uint32_t>(rendered.count()) - 1U}) {
      EXPECT_EQ(test::number_at(*frame, frame->cloud.x, i), static_cast<double>(rendered.xyz_intensity[4 * i]));
      EXPECT_EQ(test::number_at(*frame, frame->cloud.z, i), static_cast<double>(rendered.xyz_intensity[4 * i + 2]));
    }
  }
}

TEST(MotionCampaign, GoesOnWhereItStoppedAndRefusesRecordsOfTheEngine) {
  const TempFolder folder;
  ASSERT_EQ(motion_campaign_in(folder.path()).exit_status, 0);
  const std::string kept = folder.file("records/rough/vlp16/000000.csv");
  const std::string gone = folder.file("records/distorted/vlp16/000000.csv");
  const std::string before = numbers_of(gone), kept_text = text_of(kept);
  std::filesystem::remove(gone);
  EXPECT_EQ(motion_campaign_in(folder.path()).exit_status, 0);
  EXPECT_EQ(numbers_of(gone), before);
  EXPECT_EQ(text_of(kept), kept_text) << "times and all: it was not measured again";
  EXPECT_TRUE(test::says(command({"campaign", "--output", folder.path(), "--scenes", "rough", "--sensors", "vlp16",
                                  "--frames", "2", "--quiet"}),
                         2, "library: the records have motion, this campaign has engine"));
  EXPECT_TRUE(
      test::says(motion_campaign_in(folder.path(), {"--set", "motion_keyframe=0.3"}), 2, "motion_keyframe=0.3"));
}

// Of the same records, the truth of one of them moved.
TEST(MotionCampaign, TheGateIsTheExitStatus) {
  const TempFolder folder;
  ASSERT_EQ(motion_campaign_in(folder.path()).exit_status, 0);
  const std::string file = folder.file("records/rough/vlp16/000000.csv");
  const CsvTable table = table_of(file);
  std::string text = text_of(file).substr(0, text_of(file).find('\n') + 1) + csv_line(table.head());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    std::vector<std::string> cells;
    for (std::size_t column = 0; column < table.head().size(); ++column) cells.push_back(table.cell(row, column));
    const double moved_m = table.number(row, table.find_column("true_x").value()) + (row + 1 == table.rows() ? 50 : 0);
    cells[table.find_column("true_x").value()] = csv_number(moved_m);
    text += csv_line(cells);
  }
  std::ofstream(file) << text;
  EXPECT_TRUE(test::says(command({"campaign", "--card-only", "--gate", "--quiet", "--output", folder.path()}), 3,
                         "gate: rough vlp16: step beyond its level, along: 1 of 5"));
  EXPECT_EQ(command({"campaign", "--card-only", "--quiet", "--output", folder.path()}).exit_status, 0);
  std::ofstream(file) << "# pose_wall campaign of somebody else\n";
  EXPECT_EQ(command({"campaign", "--card-only", "--quiet", "--output", folder.path()}).exit_status, 1);
}

TEST(MotionCampaign, WordsThatDoNotGoTogetherAreRefused) {
  const TempFolder folder;
  EXPECT_EQ(motion_campaign_in(folder.path(), {"--kind", "nominal"}).exit_status, 2);
  EXPECT_EQ(command({"campaign", "--list"}).exit_status, 2);
  EXPECT_EQ(command({"campaign", "--motion"}).exit_status, 2);
  const Ran list = command({"campaign", "--motion", "--list"});
  EXPECT_EQ(list.exit_status, 0);
  for (const campaign::MotionClass& one : campaign::motion_classes()) {
    EXPECT_TRUE(contains(list.printed, one.name) && contains(list.printed, one.expected)) << one.name;
  }
}

}  // namespace
}  // namespace pose_wall::tools
