// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the command that the card gives for an event, typed as it stands, measures its frame once more with the very
// same values, settings of the campaign included. Does not prove: that the card lists the right events.

#include "lab/campaign/recipe.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "event_command.hpp"
#include "io/csv/csv_table.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr std::size_t kFrames = 5;  // of each run: a few are enough, the event is in the last

// Of a campaign of one run, the draw of this number, whose last frame was made to mislead; another folder is in the
// place of DIR.
std::string command_of_last_frame(const std::string& folder, const std::string& again,
                                  const std::vector<std::string>& words, const std::string& draw = "3") {
  EXPECT_EQ(command({"campaign", "--quiet", "--seed", "5", "--draws", "1", "--first-draw", draw, "--output", folder,
                     "--sensors", "vlp16", "--frames", std::to_string(kFrames)},
                    words)
                .exit_status,
            0);
  return test::command_of_event(folder, 0, kFrames - 1, again);
}

void expect_same_last_row(const std::string& frames_file, const std::string& again_file) {
  const CsvTable frames = table_of(frames_file);
  const CsvTable again = table_of(again_file);
  ASSERT_EQ(frames.rows(), again.rows());
  const std::size_t last = frames.rows() - 1;
  for (const std::string q : {"roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"}) {
    for (const char* ending : {"", "_raw", "_sigma", "_pl", "_state"}) {
      const std::string column = q + ending;
      EXPECT_EQ(frames.cell(last, *frames.find_column(column)), again.cell(last, *again.find_column(column))) << column;
    }
  }
}

// One of two draws in a row drives, the other one stands; scans of both take time.
TEST(CampaignRecipe, FramesOnDiskGiveTheValuesOfTheCampaign) {
  std::string lines;
  for (const char* draw : {"3", "4"}) {
    const TempFolder folder;
    const TempFolder again;
    const std::string line =
        command_of_last_frame(folder.path(), again.path(), {"--scenes", "rough", "--set", "integrity_risk=1e-9"}, draw);
    EXPECT_TRUE(contains(line, "pose_wall run")) << line;
    EXPECT_TRUE(contains(line, " --set scan_s=0.1 --set rock_repeats=no --set speed_mps=")) << line;
    run_all_of(line);
    expect_same_last_row(folder.file("frames.csv"), again.file("out.csv"));
    lines += line;
  }
  const std::size_t standing = lines.find("--set speed_mps=0 ");
  EXPECT_NE(standing, std::string::npos) << lines;
  EXPECT_EQ(lines.find("--set speed_mps=0 ", standing + 1), std::string::npos) << lines;
}

TEST(CampaignRecipe, ScansOfOneInstantAreRepeatedAsSuch) {
  const TempFolder folder;
  const TempFolder again;
  const std::string line =
      command_of_last_frame(folder.path(), again.path(), {"--scenes", "jitter", "--scans", "instant"});
  EXPECT_TRUE(contains(line, " --scans instant ")) << line;
  run_all_of(line + " --quiet");
  expect_same_last_row(folder.file("frames.csv"), again.file("frames.csv"));
}

TEST(CampaignRecipe, StampsThatJumpComeFromTheCampaignItself) {
  const TempFolder folder;
  const TempFolder again;
  const std::string line =
      command_of_last_frame(folder.path(), again.path(), {"--scenes", "jitter", "--set", "integrity_risk=1e-9"});
  EXPECT_TRUE(contains(line, "pose_wall campaign")) << line;
  run_all_of(line + " --quiet");
  expect_same_last_row(folder.file("frames.csv"), again.file("frames.csv"));
}

TEST(CampaignRecipe, AFileOfSettingsIsNotForgotten) {
  const TempFolder folder;
  const TempFolder again;
  const std::string config = folder.write("mine.yaml", "temporal_smoothing_tau: 1.0\n");
  const std::string line =
      command_of_last_frame(folder.path(), again.path(), {"--scenes", "rough", "--config", config});
  run_all_of(line + " --quiet");
  expect_same_last_row(folder.file("frames.csv"), again.file("frames.csv"));
}

}  // namespace
}  // namespace pose_wall::tools
