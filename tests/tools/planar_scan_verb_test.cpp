// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: `pose_wall scan` writes a row a beam or an object a scan, of frames and of logs, and its picture; its faults
// are named. Does not prove: that the scans are right (tests/planar).

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "planar_logs.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

TEST(ScanVerb, FramesOfARoadShowItsWalls) {
  const TempFolder folder;
  ASSERT_EQ(
      command({"sim", "-q", "--scene", "clean", "--sensor", "vlp16", "-n", "2", "-o", folder.file("road")}).exit_status,
      0);
  const Ran ran = command({"scan", "-c", folder.file("road/pose_wall.yaml"), "-s", "angle_step_rad=0.01", "-o",
                           folder.file("s.csv"), "--picture", folder.file("s.svg"), folder.file("road/frames")});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "things from 0.15 to 1.90 m above the floor")) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "beams with a range")) << ran.errors;
  const CsvTable table = table_of(folder.file("s.csv"));
  const std::size_t angle = *table.find_column("angle_rad"), range = *table.find_column("range_m");
  std::size_t across = 0;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (!(std::abs(std::abs(table.number(row, angle)) - 1.5708) < 0.02)) continue;
    EXPECT_NEAR(table.number(row, range), 2.5, 0.05) << "the walls of `clean` stand 2.5 m to either side";
    ++across;
  }
  EXPECT_GE(across, 8U);
  EXPECT_TRUE(contains(text_of(folder.file("s.svg")), "low things"));
}

TEST(ScanVerb, AScanOfALogIsALineOfJson) {
  const TempFolder folder;
  const std::string log = folder.write("room.clf", DrawnRoom::log(3, 0.25));
  const Ran ran = command({"scan", "-q", "--format", "json", log});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_EQ(ran.errors, "");
  std::istringstream lines(ran.printed);
  int scans = 0;
  for (std::string line; std::getline(lines, line); ++scans) {
    const nlohmann::json row = nlohmann::json::parse(line);
    EXPECT_EQ(row.at("time_s"), DrawnRoom::stamp(scans));
    ASSERT_EQ(row.at("ranges_m").size(), 180U);
    EXPECT_NEAR(row.at("sensor").at(0).get<double>(), 0.25, 1e-3);
    EXPECT_NEAR(row.at("odometry").at(0).get<double>(), DrawnRoom::pose(scans).x_m, 1e-5);
    EXPECT_FALSE(row.contains("beams")) << "only of clouds";
  }
  EXPECT_EQ(scans, 3);
}

TEST(ScanVerb, FaultsAreNamed) {
  const TempFolder folder;
  const std::string log = folder.write("room.clf", DrawnRoom::log(3));
  const std::string frame = folder.write("good.bin", std::string(16, '\0'));
  const std::pair<std::vector<std::string>, const char*> usage[] = {
      {{"scan", "-s", "machine_heigt_m=2", frame}, "did you mean 'machine_height_m'"},
      {{"scan", "-s", "machine_height_m=99", frame}, "machine_height_m"},
      {{"scan", "-s", "voxel_leef=1", frame}, "did you mean 'voxel_leaf'"},
      {{"scan", "-s", "ground_clearance_m=0.1", frame}, "--set ground_clearance_m=0.1: floor_tolerance_m must be from"},
      {{"scan", "-s", "voxel_leaf=1", log}, "no setting for scans of a log"},
      {{"scan", "--picture", "x.png", log}, "ending in .svg"},
      {{"scan", "--format", "jsn", log}, "did you mean 'json'"},
  };
  for (const auto& [words, answer] : usage) EXPECT_TRUE(test::says(command(words), 2, answer));
  EXPECT_TRUE(test::says(command({"scan", "-q", "--picture", folder.file("s.svg"), "--drawn", "9", log}), 1,
                         "--drawn 9: there is no scan from this number on"));
  EXPECT_TRUE(test::says(command({"scan", "-q", "-o", folder.file("s.csv"), frame}), 1, "no floor was measured"));
}

TEST(ScanVerb, AFloorThatIsNotKnownWellIsNoFloorThatWasNotMeasured) {
  const TempFolder folder;
  ASSERT_EQ(
      command({"sim", "-q", "--scene", "rough", "--sensor", "vlp16", "-n", "3", "-o", folder.file("road")}).exit_status,
      0);
  const std::vector<std::string> words = {"-c", folder.file("road/pose_wall.yaml"), "-o", folder.file("o"),
                                          folder.file("road/frames")};
  for (const char* verb : {"scan", "map"}) {
    std::vector<std::string> all = {verb, "-q", "-s", "tilt_level_max_rad=0.001"};
    all.insert(all.end(), words.begin(), words.end());
    const Ran ran = command(all);
    EXPECT_EQ(ran.exit_status, 1) << verb;
    EXPECT_TRUE(contains(ran.errors, "the floor was measured, but its tilt only within ")) << ran.errors;
    EXPECT_TRUE(contains(ran.errors, "and 0.1° is the most (tilt_level_max_rad)")) << ran.errors;
    EXPECT_FALSE(contains(ran.errors, "no floor was measured")) << ran.errors;
    std::filesystem::remove_all(folder.file("o"));
  }
}

}  // namespace
}  // namespace pose_wall::tools
