// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: `pose_wall motion` turns frames into whole rows, a path and a map that eval and report take; what cannot be
// read keeps its row; nothing is overwritten that was not meant; and the page of a table has all its words.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "motion_tables.hpp"
#include "pose_wall_motion.h"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

// A drive at 1 m/s, ten frames a second.
struct Drive {
  Drive() {
    EXPECT_EQ(command({"sim", "--scene", "rough", "--sensor", "vlp16", "-n", "4", "--set", "speed_mps=1", "--set",
                       "rock_repeats=no", "-q", "-o", folder.file("road")})
                  .exit_status,
              0);
  }
  Ran motion(const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"motion", "-c", folder.file("road/pose_wall.yaml")};
    words.insert(words.end(), more.begin(), more.end());
    words.push_back(folder.file("road/frames"));
    return command(words);
  }

  TempFolder folder;
};

TEST(MotionVerb, FramesBecomeRowsPathAndMap) {
  const Drive drive;
  const TempFolder& folder = drive.folder;
  const Ran ran =
      drive.motion({"-o", folder.file("m.csv"), "--tum", folder.file("m.tum"), "--map", folder.file("m.ply")});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  for (const char* part : {"along the road", "travel along the road:", "largest level", "motion, per frame: mean ",
                           "worst ", "To look at next:"}) {
    EXPECT_TRUE(contains(ran.errors, part)) << part << "\nin\n" << ran.errors;
  }
  const CsvTable table = table_of(folder.file("m.csv"));
  ASSERT_EQ(table.rows(), 4U);
  const auto cell = [&table](std::size_t row, const char* name) { return table.cell(row, *table.find_column(name)); };
  EXPECT_TRUE(contains(cell(0, "reason"), "first"));
  for (const char* name : {"x", "y", "z", "qx", "qy", "qz"}) EXPECT_EQ(cell(0, name), "0") << name;
  EXPECT_EQ(cell(0, "qw"), "1");
  // As many rows as there are poses, and the same numbers.
  std::istringstream path(text_of(folder.file("m.tum")));
  std::string line, expected;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (cell(row, "x").empty()) continue;
    ASSERT_TRUE(std::getline(path, line));
    expected.clear();
    for (const char* name : {"x", "y", "z", "qx", "qy", "qz", "qw"}) expected += " " + cell(row, name);
    EXPECT_EQ(line.substr(line.find(' ')), expected);
  }
  EXPECT_FALSE(std::getline(path, line));
  EXPECT_EQ(text_of(folder.file("m.ply")).substr(0, 4), "ply\n");
}

TEST(MotionVerb, EvalAndReportTakeItsTable) {
  const Drive drive;
  const TempFolder& folder = drive.folder;
  ASSERT_EQ(drive.motion({"-q", "-o", folder.file("m.csv")}).exit_status, 0);
  const Ran ran = command({"eval", "--json", folder.file("m.csv"), folder.file("road/truth.csv")});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  const nlohmann::json data = nlohmann::json::parse(ran.printed);
  EXPECT_EQ(data.at("matched"), 4);
  EXPECT_EQ(data.at("matched_by"), "stamp_ns");
  EXPECT_NEAR(data.at("way_m").get<double>(), 0.3, 1e-6);
  const Ran page =
      command({"report", "--truth", folder.file("road/truth.csv"), "-o", folder.file("m.html"), folder.file("m.csv")});
  EXPECT_EQ(page.exit_status, 0) << page.errors;
  EXPECT_TRUE(contains(text_of(folder.file("m.html")), "</html>"));
}

TEST(MotionVerb, WhatCannotBeReadKeepsItsRow) {
  const Drive drive;
  const TempFolder& folder = drive.folder;
  folder.write("road/frames/000001b.pcd", "no cloud\n");
  const Ran ran = drive.motion({"-o", folder.file("m.csv"), "--tum", folder.file("m.tum")});
  EXPECT_TRUE(test::says(ran, 1, "000001b.pcd"));
  EXPECT_TRUE(test::says(ran, 1, "unreadable: 1 of 5 frames"));
  const CsvTable table = table_of(folder.file("m.csv"));
  ASSERT_EQ(table.rows(), 5U);
  EXPECT_EQ(table.cell(2, *table.find_column("along_state")), "unreadable");
  EXPECT_NE(table.cell(2, *table.find_column("error")), "");
  const std::string path = text_of(folder.file("m.tum"));
  EXPECT_LE(std::count(path.begin(), path.end(), '\n'), 4);
}

TEST(MotionVerb, OutputsAreNoInputsAndNotEachOther) {
  const Drive drive;
  const TempFolder& folder = drive.folder;
  const std::string frame = folder.file("road/frames/000000.pcd"), before = text_of(frame);
  for (const std::string option : {"--output", "--tum", "--map"}) {
    EXPECT_TRUE(test::says(drive.motion({"-q", option, frame}), 2, option + " " + frame + ": this is an input"));
    EXPECT_EQ(text_of(frame), before);
  }
  const std::string one = folder.file("one");
  EXPECT_EQ(drive.motion({"-q", "-o", one, "--tum", one}).exit_status, 2);
  EXPECT_EQ(drive.motion({"-q", "-o", one, "--map", one}).exit_status, 2);
  EXPECT_EQ(drive.motion({"-q", "-o", one, "--tum", "-"}).exit_status, 2);
  EXPECT_EQ(drive.motion({"-q", "-o", one, "--set", "motion_keyframe=9"}).exit_status, 2);
}

TEST(MotionVerb, AMistypedInputDoesNotCostTheLastTable) {
  const TempFolder folder;
  const std::string table = folder.write("m.csv", "kept\n");
  EXPECT_TRUE(test::says(command({"motion", "-o", table, folder.file("not_there")}), 1, "is left as it was"));
  EXPECT_EQ(text_of(table), "kept\n");
}

TEST(MotionVerb, RowsGoToStandardOutputWithoutAFile) {
  const Drive drive;
  const Ran ran = drive.motion({"-q"});
  EXPECT_EQ(ran.exit_status, 0);
  EXPECT_EQ(std::count(ran.printed.begin(), ran.printed.end(), '\n'), 5);
  EXPECT_EQ(ran.errors, "");
}

// ---- the page of a table

nlohmann::json motion_page_data(const std::string& page) {
  const std::string start = "<script id=\"data\" type=\"application/json\">";
  const std::size_t from = page.find(start) + start.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

TEST(ReportOfMotion, HoldsTheTable) {
  const TempFolder folder;
  const std::string table = folder.write(
      "m.csv", motion_csv({with(placed(0, 0), {{"reason", "first"}, {"source", "</script><b>.pcd"}}), lost_frame(),
                           with(placed(2, 0), {{"reason", "smooth|few_patches"}, {"along_state", "unobservable"}})}));
  const std::string truth = folder.write("t.csv", pose_truth_csv({placed(0, 0), placed(1, 0), placed(2.1, 0)}));
  ASSERT_EQ(command({"report", "-q", "--truth", truth, "-o", folder.file("m.html"), table}).exit_status, 0);
  const nlohmann::json data = motion_page_data(text_of(folder.file("m.html")));
  EXPECT_EQ(data.at("frames"), 3);
  EXPECT_EQ(data.at("source").at(0), "</script><b>.pcd");
  EXPECT_EQ(data.at("state"), "AwAB") << "base64 of 3, 0, 1";
  EXPECT_EQ(data.at("reasons").at("names"), (std::vector<std::string>{"first", "", "smooth|few_patches"}));
  EXPECT_NEAR(data.at("truth").at("error").at("along_m").at("at_end").get<double>(), -0.1, 1e-9);
  EXPECT_EQ(data.at("head").at("truth"), truth);
}

// The page falls back to English, which nobody would notice.
TEST(ReportOfMotion, ChineseHasEveryReasonStateAndDirection) {
  const TempFolder folder;
  const std::string table = folder.write("m.csv", motion_csv({placed(0, 0)}));
  ASSERT_EQ(command({"report", "-q", "-o", folder.file("m.html"), table}).exit_status, 0);
  const std::string page = text_of(folder.file("m.html"));
  const std::string chinese = page.substr(page.find("\n  zh: {"));
  const auto has = [&chinese](const std::string& name) { return contains(chinese, name + ": '"); };
  for (std::uint32_t bit = 0; bit < POSE_WALL_MOTION_REASON_COUNT; ++bit) {
    EXPECT_TRUE(has(pose_wall_motion_reason_name(bit))) << pose_wall_motion_reason_name(bit);
  }
  for (std::uint32_t state = 0; state <= POSE_WALL_ALONG_MEASURED; ++state) {
    EXPECT_TRUE(has(pose_wall_motion_along_state_name(state))) << pose_wall_motion_along_state_name(state);
  }
  for (std::uint32_t d = 0; d < POSE_WALL_MOTION_DIRECTIONS; ++d) {
    EXPECT_TRUE(has(pose_wall_motion_direction_name(d))) << pose_wall_motion_direction_name(d);
  }
}

TEST(ReportOfMotion, OtherTablesAndMixturesAreRefused) {
  const TempFolder folder;
  const std::string good = folder.write("m.csv", motion_csv({placed(0, 0)}));
  const std::string page = folder.file("m.html");
  const auto refused = [&](const std::vector<std::string>& inputs, int status, const char* said) {
    const Ran ran = command({"report", "-q", "-o", page}, inputs);
    EXPECT_EQ(ran.exit_status, status) << said;
    EXPECT_TRUE(contains(ran.errors, said)) << ran.errors;
    EXPECT_FALSE(std::filesystem::exists(page));
  };
  refused({folder.write("other.csv", "frame,roll\n0,1\n")}, 1,
          "other.csv: this is no table of run (with roll, roll_state, ...), motion (along_m, ...)");
  refused({folder.file("none.csv")}, 1, "none.csv: there is no such file or folder");
  refused({folder.write("empty.csv", motion_csv({}))}, 1, "empty.csv: the table has no row");
  refused({good, folder.path()}, 2, "give a table alone");
  const std::string before = text_of(good);
  EXPECT_EQ(command({"report", "-q", "-o", good, good}).exit_status, 2);
  EXPECT_EQ(text_of(good), before);
}

}  // namespace
}  // namespace pose_wall::tools
