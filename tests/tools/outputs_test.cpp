// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what a verb writes never costs what somebody else made: settings, truth, a recording, the results of the last
// run, what a link points to, a device; and that a file is written whole or not at all.

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "io/frames/whole_file.hpp"
#include "ran_command.hpp"
#include "support/said_by.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

class Outputs : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_EQ(command({"sim", "--sensor", "vlp16", "-n", "1", "-q", "-o", folder.file("road")}).exit_status, 0);
  }
  const TempFolder folder;
  const std::string frames = folder.file("road/frames"), settings = folder.file("road/pose_wall.yaml"),
                    truth = folder.file("road/truth.csv");
};

// A replay goes by the stamps of its frames, also where these stand still or leap.
TEST_F(Outputs, SimulatedFramesAreReplayedByTheirStamps) {
  const std::string road = folder.file("leaps"), out = folder.file("out.csv");
  ASSERT_EQ(command({"sim", "-q", "--scene", "stamp_leap", "--sensor", "vlp16", "-n", "12", "-o", road}).exit_status,
            0);
  ASSERT_EQ(command({"run", "-q", "-c", road + "/pose_wall.yaml", "-o", out, road + "/frames"}).exit_status, 0);
  const auto stamps_of = [](const std::string& file) {
    std::vector<std::string> stamps;
    const CsvTable table = test::table_of(file);
    for (std::size_t row = 0; row < table.rows(); ++row)
      stamps.push_back(table.cell(row, table.find_column("stamp_ns").value()));
    return stamps;
  };
  EXPECT_EQ(stamps_of(out), stamps_of(road + "/truth.csv"));
}

// Drawn ones as well, so that a scene can be made again by its sizes.
TEST_F(Outputs, TheSettingsOfASimulatedRoadNoteItsSizes) {
  const std::string drawn = folder.file("drawn"), again = folder.file("again");
  ASSERT_EQ(command({"sim", "-q", "--random", "--seed", "7", "--sensor", "vlp16", "-n", "1", "-o", drawn}).exit_status,
            0);
  std::vector<std::string> words = {"sim", "-q", "--seed", "7", "--sensor", "vlp16", "-n", "1", "-o", again};
  std::istringstream lines(text_of(drawn + "/pose_wall.yaml"));
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("#   --set ", 0) == 0) words.insert(words.end(), {"--set", line.substr(10)});
  }
  ASSERT_GT(words.size(), 12U);
  ASSERT_EQ(command(words).exit_status, 0);
  EXPECT_EQ(text_of(again + "/truth.csv"), text_of(drawn + "/truth.csv"));
}

TEST_F(Outputs, SettingsAndTruthAreNotOverwritten) {
  const std::vector<std::vector<std::string>> calls = {
      {"run", "-q", "-c", settings, "-o", settings, frames},
      {"report", "-q", "-c", settings, "-o", settings, frames},
      {"report", "-q", "-c", settings, "--truth", truth, "-o", truth, frames},
      {"explain", "-q", "-c", settings, "-n", "0", "-p", settings, frames}};
  const std::string settings_before = text_of(settings), truth_before = text_of(truth);
  for (const std::vector<std::string>& call : calls) {
    const Ran ran = command(call);
    EXPECT_EQ(ran.exit_status, 2) << call[0];
    EXPECT_TRUE(contains(ran.errors, "this is an input; it would be overwritten")) << ran.errors;
  }
  EXPECT_EQ(text_of(settings), settings_before);
  EXPECT_EQ(text_of(truth), truth_before);
}

TEST_F(Outputs, SimLeavesAFolderOfOthersAlone) {
  std::filesystem::create_directory(folder.file("mine"));
  const std::string mine = folder.write("mine/pose_wall.yaml", "# measured by hand\nforward_axis: +Y\n");
  EXPECT_TRUE(
      test::says(command({"sim", "-n", "1", "-q", "-o", folder.file("mine")}), 2, "that pose_wall sim did not write"));
  EXPECT_EQ(text_of(mine), "# measured by hand\nforward_axis: +Y\n");
  EXPECT_FALSE(std::filesystem::exists(folder.file("mine/truth.csv")));
  // Its own it writes anew.
  EXPECT_EQ(command({"sim", "--sensor", "vlp16", "-n", "1", "-q", "-o", folder.file("road")}).exit_status, 0);
}

TEST_F(Outputs, SimSaysHowManyFramesOfItsLongerRunItRemoved) {
  const auto simulate = [this](const char* count) {
    return command({"sim", "--sensor", "vlp16", "-n", count, "-o", folder.file("road")});
  };
  EXPECT_FALSE(contains(simulate("4").errors, "removed"));
  EXPECT_TRUE(test::says(simulate("2"), 0, "road: 2 frames of an earlier, longer run removed\n"));
  EXPECT_FALSE(std::filesystem::exists(frames + "/000002.pcd"));
}

TEST_F(Outputs, AMistypedInputLeavesTheResultsOfTheLastRun) {
  const std::string results = folder.write("keep.csv", "the last run\n");
  EXPECT_TRUE(test::says(command({"run", "-q", "-o", results, folder.file("road/framez")}), 1, "is left as it was"));
  EXPECT_EQ(text_of(results), "the last run\n");
}

TEST_F(Outputs, ALinkStaysALinkAndADeviceADevice) {
  const std::string page = folder.write("page.html", "old"), link = folder.file("link.html");
  std::filesystem::create_symlink(page, link);
  EXPECT_EQ(command({"report", "-q", "-c", settings, "-o", link, frames}).exit_status, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  EXPECT_TRUE(contains(text_of(page), "<html"));
  const Ran ran = command({"report", "-q", "-c", settings, "-o", "/dev/null", frames});
  EXPECT_EQ(ran.exit_status, 2);
  EXPECT_TRUE(contains(ran.errors, "this is a device; a file is allowed")) << ran.errors;
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST_F(Outputs, AHyphenIsStandardOutputAndNoFile) {
  const Ran rows = command({"run", "-q", "-c", settings, "-o", "-", frames});
  EXPECT_EQ(rows.exit_status, 0) << rows.errors;
  EXPECT_EQ(rows.printed.rfind("frame,source,stamp_ns,", 0), 0U) << rows.printed;
  const std::vector<std::vector<std::string>> calls = {{"report", "-q", "-c", settings, "-o", "-", frames},
                                                       {"explain", "-q", "-n", "0", "-p", "-", frames},
                                                       {"doctor", "-q", "-o", "-", frames},
                                                       {"sim", "-q", "-n", "1", "-o", "-"}};
  for (const std::vector<std::string>& call : calls) {
    EXPECT_TRUE(test::says(command(call), 2, " -: this is not written to standard output"));
  }
  EXPECT_FALSE(std::filesystem::exists("-"));
}

TEST(DemoOutputs, WhatIsInTheWayIsNamed) {
  const TempFolder folder;
  const auto demo_in = [](const std::string& output) {
    return command({"demo", "-q", "-n", "1", "--sensor", "vlp16", "-o", output});
  };
  const std::string mine = folder.write("mine.txt", "precious"), truth = folder.file("out/truth.csv");
  const Ran no_folder = demo_in(mine);
  EXPECT_EQ(no_folder.exit_status, 2);
  EXPECT_TRUE(contains(no_folder.errors, mine + " is a file; allowed is a folder")) << no_folder.errors;
  EXPECT_EQ(text_of(mine), "precious");
  std::filesystem::create_directories(truth);
  EXPECT_TRUE(test::says(demo_in(folder.file("out")), 1, truth + ": cannot be written"));
}

TEST(WholeFile, IsThereWholeOrNotAtAll) {
  const TempFolder folder;
  const std::string file = folder.write("page.html", "old"), taken = folder.file("taken");
  write_whole_file(file, "new");
  EXPECT_EQ(text_of(file), "new");
  EXPECT_FALSE(std::filesystem::exists(part_of(file)));
  std::filesystem::create_directory(taken);
  const std::string said = test::said_by<std::runtime_error>([&] { write_whole_file(taken, "new"); });
  EXPECT_TRUE(contains(said, taken + ": cannot be written: ")) << said;
  EXPECT_FALSE(std::filesystem::exists(part_of(taken)));
}

}  // namespace
}  // namespace pose_wall::tools
