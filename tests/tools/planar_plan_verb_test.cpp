// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: `pose_wall plan` writes routes that end where they should and names why there is none. Does not prove: that
// routes are short (tests/planar).

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "io/planar_files/map_files.hpp"
#include "ran_command.hpp"
#include "study/planar/map_picture.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

// 40 x 20 m, free within walls; a wall at x 20 leaves `gap_m` free in the middle.
MapFile hall(double gap_m) {
  MapFile map;
  map.width = 400;
  map.height = 200;
  map.resolution_m = 0.1;
  map.cells.assign(std::size_t{map.width} * map.height, 0);
  for (std::size_t row = 0; row < map.height; ++row) {
    for (std::size_t column = 0; column < map.width; ++column) {
      const bool is_rim = row == 0 || column == 0 || row + 1 == map.height || column + 1 == map.width;
      const double from_middle_m = 0.1 * (static_cast<double>(row) + 0.5) - 10.0;
      const bool is_wall = column == 200 && (from_middle_m > 0.5 * gap_m || from_middle_m < -0.5 * gap_m);
      if (is_rim || is_wall) map.cells[row * map.width + column] = 100;
    }
  }
  return map;
}

std::string written(const TempFolder& folder, const MapFile& map) {
  write_map_files(folder.file("hall.yaml"), map.grid());
  return folder.file("hall.yaml");
}

TEST(PlanVerb, WritesARouteFromStartToGoal) {
  const TempFolder folder;
  const std::string map = written(folder, hall(3.0));
  const Ran ran = command({"plan", map, "--from", "8,5,0", "--to", "32,15,90", "-o", folder.file("r.csv"), "--picture",
                           folder.file("r.svg")});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_TRUE(contains(ran.printed, "length")) << ran.printed;
  const CsvTable table = table_of(folder.file("r.csv"));
  ASSERT_GT(table.rows(), 10U);
  const auto number = [&table](std::size_t row, const char* column) {
    return table.number(row, *table.find_column(column));
  };
  EXPECT_NEAR(number(0, "x_m"), 8.0, 1e-6);
  const std::size_t last = table.rows() - 1;
  EXPECT_NEAR(number(last, "x_m"), 32.0, 1e-6);
  EXPECT_NEAR(number(last, "y_m"), 15.0, 1e-6);
  EXPECT_NEAR(number(last, "yaw_rad"), 1.5707963, 1e-6);
  EXPECT_GE(number(last, "along_m"), 26.0 - 1e-6) << "the straight line";
  EXPECT_LT(number(last, "along_m"), 32.0);
  EXPECT_TRUE(contains(text_of(folder.file("r.svg")), "<polyline"));
}

TEST(PlanVerb, NamesWhyThereIsNoRoute) {
  const TempFolder folder;
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"--from", "8,5,0", "--to", "32,10,0"}, "too narrow: at x 20"},
      {{"--from", "8,5,0", "--to", "12,1000,0"},
       "--to 12,1000,0 lies outside the map. The map reaches from x 0.00 to "
       "40.00 m and from y 0.00 to 20.00 m."},
      {{"--start", "8,0.3,0", "--goal", "12,10,0"}, "reaches 2.25 m ahead, 2.25 m back, 0.60 m left and 0.60 m right"},
      {{"--from", "8,0.3,0", "--to", "12,10,0"}, "does not fit at --from 8,0.3,0: a thing at x "},
      {{"--from", "8,5,0", "--to", "39.9,10,0"}, "does not fit at --to 39.9,10,0: a thing at x "},
  };
  const std::string map = written(folder, hall(1.0));
  for (const auto& [words, answer] : cases) {
    const Ran ran = command({"plan", map, "--picture", folder.file("none.svg"), "-o", folder.file("none.csv")}, words);
    EXPECT_EQ(ran.exit_status, 3) << ran.errors;
    EXPECT_TRUE(contains(ran.errors, answer)) << answer << " in: " << ran.errors;
    EXPECT_FALSE(std::filesystem::exists(folder.file("none.csv")));
    EXPECT_TRUE(std::filesystem::exists(folder.file("none.svg")));
  }
}

TEST(PlanVerb, TheFolderOfAMapIsAMap) {
  const TempFolder folder;
  write_map_files(folder.file("map.yaml"), hall(3.0).grid());
  const std::string here = std::filesystem::path(folder.file("map.yaml")).parent_path().string();
  const Ran ran = command({"plan", here, "--from", "8,5,0", "--to", "12,5,0"});
  EXPECT_EQ(ran.exit_status, 0) << ran.errors;
  const std::string log = folder.write("room.clf", "FLASER 2 1 1 0 0 0 0 0 0 1 h 1\n");
  std::filesystem::create_directory(folder.file("empty"));
  const std::pair<std::string, const char*> others[] = {
      {folder.file("map.pgm"), "the YAML file that names it"},
      {log, "this is a log of CARMEN"},
      {folder.file("empty"), "has no map.yaml. `pose_wall map -o FOLDER INPUT` writes it"},
  };
  for (const auto& [map, answer] : others) {
    const Ran refused = command({"plan", map, "--from", "8,5,0", "--to", "12,5,0"});
    EXPECT_EQ(refused.exit_status, 1);
    EXPECT_TRUE(contains(refused.errors, "MAP " + map)) << refused.errors;
    EXPECT_TRUE(contains(refused.errors, answer)) << answer << " in: " << refused.errors;
  }
}

TEST(PlanVerb, AllRefusedSettingsAreNamedAtOnce) {
  const TempFolder folder;
  const std::string map = written(folder, hall(3.0));
  const auto plan = [&map](const std::vector<std::string>& settings) {
    std::vector<std::string> words = {"plan", map, "--from", "8,5,0", "--to", "12,5,0"};
    for (const std::string& setting : settings) words.insert(words.end(), {"-s", setting});
    return command(words);
  };
  for (const char* name : {"'weight'", "'front_m'"}) EXPECT_TRUE(test::says(plan({"weigt=2", "fornt_m=1"}), 2, name));
  const Ran refused = plan({"front_m=99", "rear_m=x", "left_m", "margin_m=0.2"});
  EXPECT_EQ(refused.exit_status, 2);
  for (const char* answer : {"--set front_m=99: front_m must be from 0.1 to 20", "--set rear_m: 'x' is no number",
                             "--set left_m: KEY=VALUE is expected"}) {
    EXPECT_TRUE(contains(refused.errors, answer)) << answer << " in: " << refused.errors;
  }
  EXPECT_FALSE(contains(refused.errors, "--set margin_m")) << refused.errors;
  // The limits of one depend on the other; their order does not count.
  EXPECT_EQ(plan({"radius_min_m=9", "radius_max_m=20"}).exit_status, 0);
  EXPECT_EQ(plan({"radius_max_m=20", "radius_min_m=9"}).exit_status, 0);
  const Ran both = plan({"radius_min_m=9", "radius_max_m=8.5"});
  EXPECT_EQ(both.exit_status, 2);
  EXPECT_TRUE(contains(both.errors, "--set radius_max_m=8.5: ") && contains(both.errors, "; radius_min_m is 9"))
      << both.errors;
  EXPECT_FALSE(contains(both.errors, "--set radius_min_m")) << "one rule, one line: " << both.errors;
}

TEST(PlanVerb, SpecksCountAsFreeOnlyIfToldSo) {
  const TempFolder folder;
  MapFile map = hall(3.0);
  map.cells[std::size_t{50} * map.width + 80] = -1;  // x 8 m, y 5 m
  const std::string file = written(folder, map);
  EXPECT_TRUE(test::says(command({"plan", file, "--from", "8,5,0", "--to", "14,5,0"}), 3,
                         "an unknown cell at x 8.05 m, y 5.05 m"));
  EXPECT_TRUE(test::says(command({"plan", file, "--from", "8,5,0", "--to", "14,5,0", "--free-specks"}), 0,
                         "1 specks count as free"));
}

TEST(PlanVerb, FaultsOfUsage) {
  const TempFolder folder;
  const std::string map = written(folder, hall(3.0));
  const std::pair<std::vector<std::string>, const char*> usage[] = {
      {{"plan", map, "--to", "1,1,0"}, "--from"},
      {{"plan", map, "--from", "1,1", "--to", "1,1,0"}, "--from: '1,1' is refused; allowed: x,y,yaw"},
      {{"plan", map, "--from", "1,1,nan", "--to", "1,1,0"}, "'1,1,nan' is refused"},
      {{"plan", map, "--from", "1,1,0", "--to", "5,5,0", "-s", "frnt_m=2"}, "did you mean 'front_m'"},
      {{"plan", map, "--from", "1,1,0", "--to", "5,5,0", "-s", "front_m=99"}, "front_m must be from 0.1 to 20"},
      {{"plan", map, "--from", "1,1,0", "--to", "5,5,0", "-s", "radius_min_m=9"}, "radius_max_m is 8"},
      {{"plan", map, "--from", "1,1,0", "--to", "5,5,0", "--picture", "r.png"}, "ending in .svg"},
      {{"plan", folder.file("none.yaml"), "--from", "1,1,0", "--to", "5,5,0"},
       "none.yaml: there is no such file or folder"},
  };
  for (const auto& [words, answer] : usage) EXPECT_TRUE(test::says(command(words), 2, answer));
  EXPECT_TRUE(
      test::says(command({"plan", folder.write("bad.yaml", "image: x.pgm\n"), "--from", "1,1,0", "--to", "5,5,0"}), 1,
                 "bad.yaml"));
}

}  // namespace
}  // namespace pose_wall::tools
