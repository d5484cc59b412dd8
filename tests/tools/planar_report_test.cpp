// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: `pose_wall report` makes a page of what map, localise and plan wrote, in both languages, and `pose_wall info`
// describes a log of CARMEN.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "planar_logs.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

nlohmann::json data_of(const std::string& page) {
  const std::string begin = "<script id=\"data\" type=\"application/json\">";
  const std::size_t from = page.find(begin) + begin.size();
  return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
}

// "keyframes" of a table whose head begins with `title`.
std::string figure(const nlohmann::json& section, const std::string& title, const std::string& name) {
  for (const auto& table : section.at("tables")) {
    if (table.at("head").at(0) != title) continue;
    for (const auto& row : table.at("rows")) {
      if (row.at(0) == name) return row.at(1);
    }
  }
  return "none";
}

TEST(MapReport, HoldsPicturesAndFiguresInBothLanguages) {
  const TempFolder folder;
  const std::string log = folder.write("room.clf", DrawnRoom::log(60)), map = folder.file("map"),
                    page = folder.file("r.html");
  ASSERT_EQ(command({"map", "-q", "-o", map, log}).exit_status, 0);
  ASSERT_NE(command({"localise", "-q", "--start", "0,0,0", "-o", folder.file("found"), map, log}).exit_status, 1);
  const std::string head = "pose,x_m,y_m,yaw_rad,curvature_1_m,along_m,drive,stop,cusp,turn\n";
  const std::string route =
      folder.write("route.csv", head + "0,0,0,0,0,0,1,0,0,\n1,1,0,0,0,1,0,0,1,left\n2,1,0,1,0,2.5,1,1,0,\n");
  const std::string picture = folder.write("route.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
  const Ran ran = command({"report", map, folder.file("found"), route, picture, "-o", page});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "3 pictures")) << ran.errors;
  const nlohmann::json data = data_of(text_of(page));
  EXPECT_EQ(data.at("pictures").at(0).at(0).at("name"), "map.svg");
  EXPECT_EQ(data.at("pictures").at(1).at(0).at("name"), "localise.svg");
  const auto& english = data.at("texts").at("en").at("sections");
  EXPECT_EQ(data.at("pictures").at(3).at(0).at("name"), "route.svg");
  ASSERT_EQ(english.size(), 4U);
  EXPECT_NE(figure(english.at(0), "map", "keyframes"), "none");
  EXPECT_EQ(figure(english.at(1), "localisation", "scans"), "60");
  EXPECT_EQ(figure(english.at(2), "route: route.csv", "length"), "2.50 m");
  EXPECT_EQ(figure(english.at(2), "route: route.csv", "changes of direction"), "1");
  EXPECT_EQ(figure(english.at(2), "route: route.csv", "turns on the spot"), "1");
  EXPECT_NE(figure(data.at("texts").at("zh").at("sections").at(0), "地图", "关键帧"), "none");
}

TEST(MapReport, RefusesWhatItCannotShow) {
  const TempFolder folder;
  const std::string log = folder.write("room.clf", DrawnRoom::log(10)), map = folder.file("map");
  ASSERT_EQ(command({"map", "-q", "-o", map, log}).exit_status, 0);
  EXPECT_TRUE(test::says(command({"report", map, log, "-o", folder.file("r.html")}), 2,
                         "this is no result of map, localise or plan"));
  const Ran onto = command({"report", map, "-o", map + "/map.svg"});
  EXPECT_EQ(onto.exit_status, 2) << "an input is not overwritten";
  folder.write("map/trail.pwt", "damaged");
  EXPECT_TRUE(test::says(command({"report", map, "-o", folder.file("r.html")}), 1, "trail.pwt"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("r.html")));
}

TEST(MapReport, NamesWhatIsNotThere) {
  const TempFolder folder;
  const std::string map = folder.file("map"), none = folder.file("none.csv");
  ASSERT_EQ(command({"map", "-q", "-o", map, folder.write("room.clf", DrawnRoom::log(5))}).exit_status, 0);
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"report", none},
        std::vector<std::string>{"report", map, none, "-o", folder.file("r")}}) {
    EXPECT_TRUE(test::says(command(words), 1, "INPUT " + none + ": there is no such file or folder. Give "));
  }
}

TEST(PlanarInput, IsNamedToVerbsThatMeasureFrames) {
  const TempFolder folder;
  const std::string log = folder.write("room.clf", DrawnRoom::log(30)), map = folder.file("map");
  ASSERT_EQ(command({"map", "-q", "-o", map, log}).exit_status, 0);
  ASSERT_NE(command({"localise", "-q", "--start", "0,0,0", "-o", folder.file("found"), map, log}).exit_status, 1);
  const std::pair<std::string, const char*> inputs[] = {
      {log, "this is a log of CARMEN: scans of a planar laser scanner. info, scan, map and localise take it"},
      {map, "this is a map, as `pose_wall map -o` writes it. localise, plan and report take it"},
      {map + "/map.yaml", "this is the YAML file of a map. plan and localise take it"},
      {map + "/map.pgm", "this is the image of a map's cells. plan and localise take the YAML file"},
      {map + "/trail.pwt", "this is the trail of a map. localise takes it"},
      {folder.file("found"), "this is what `pose_wall localise -o` wrote. report takes it"},
  };
  for (const auto& [input, words] : inputs) {
    for (const char* verb : {"run", "info", "motion", "map"}) {
      const bool takes_logs = std::string(verb) == "info" || std::string(verb) == "map";
      if (input == log && takes_logs) continue;
      const Ran ran = command({verb, input});
      EXPECT_EQ(ran.exit_status, 1) << verb;
      EXPECT_TRUE(contains(ran.errors, input + ": " + words)) << verb << ": " << ran.errors;
      EXPECT_EQ(ran.printed, "") << verb;
    }
  }
  // Texts and archives of other kinds keep their own words.
  EXPECT_FALSE(contains(command({"run", folder.write("a.xyz", "1 2 3\n")}).errors, "CARMEN"));
  EXPECT_FALSE(contains(command({"run", folder.write("a.log", "1 2 3\n")}).errors, "CARMEN"));
  EXPECT_TRUE(contains(command({"run", folder.write("a.tar.gz", "\x1F\x8B\x08 and so on")}).errors, "gunzip"));
}

TEST(InfoVerb, TheRestartsThatItProposesFitTheLog) {
  const TempFolder folder;
  const auto proposed = [&folder](int scans) {
    return command({"info", folder.write("room.clf", DrawnRoom::long_log(scans))}).printed;
  };
  EXPECT_TRUE(contains(proposed(20), "--restart 5 --truth poses.tum -o found\n")) << "2 m";
  EXPECT_TRUE(contains(proposed(500), "--restart 9 ")) << "50 m, five restarts";
  EXPECT_TRUE(contains(proposed(3700), "--restart 60 ")) << "370 m";
}

TEST(InfoVerb, DescribesALogOfCarmen) {
  const TempFolder folder;
  const std::string text =
      DrawnRoom::log(20) + "ODOM 1 2 3\nFLASER 3 1\nSYNC x\n" + DrawnRoom::line("976052899.0", DrawnRoom::pose(20));
  const std::string log = folder.write("room.clf", text);
  const Ran ran = command({"info", log});
  EXPECT_EQ(ran.exit_status, 1) << "a line is bad";
  for (const char* words : {"a log of CARMEN", "180 a scan, from -90.0° in steps of 1.00°: 179° of view",
                            "2.0 m of travel", "longest step 97.600 s", "1, the first in line 23",
                            "2, the first in line 22: ODOM 1, SYNC 1", "1, the first in line 1"}) {
    EXPECT_TRUE(contains(ran.printed, words)) << words << " in " << ran.printed;
  }
  EXPECT_TRUE(contains(ran.printed, "pose_wall map -o map --poses poses.tum")) << ran.printed;
  const auto page = nlohmann::json::parse(command({"info", "--json", log}).printed);
  EXPECT_EQ(page.at(0).at("scans"), 21);
  EXPECT_EQ(page.at(0).at("skipped").at("bad_line").at("lines"), 1);
  EXPECT_NEAR(page.at(0).at("odometry").at("travel_m"), 2.0, 0.01);
  EXPECT_EQ(command({"info", folder.write("good.clf", DrawnRoom::log(5))}).exit_status, 0);
  EXPECT_TRUE(test::says(command({"info", folder.write("none.clf", "# empty\n")}), 1, "none.clf"));
}

}  // namespace
}  // namespace pose_wall::tools
