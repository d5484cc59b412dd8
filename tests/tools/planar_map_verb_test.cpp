// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: `pose_wall map` keeps its contract: poses of all scans with the log's own stamps, near the truth; map files,
// picture and graph; errors against relations; exit statuses. Does not prove: the accuracy of SLAM on real logs.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "io/planar_files/map_files.hpp"
#include "planar_logs.hpp"
#include "ran_command.hpp"
#include "study/planar/plane_pose.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

struct TumRow {
  std::string time;
  pose_wall_planar_pose pose{};
};

std::vector<TumRow> tum_rows(const std::string& file) {
  std::vector<TumRow> rows;
  std::istringstream lines(text_of(file));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    TumRow row;
    double z = 0.0, qx = 0.0, qy = 0.0, qz = 0.0, qw = 0.0;
    words >> row.time >> row.pose.x_m >> row.pose.y_m >> z >> qx >> qy >> qz >> qw;
    EXPECT_TRUE(words) << line;
    row.pose.yaw_rad = 2.0 * std::atan2(qz, qw);
    rows.push_back(row);
  }
  return rows;
}

TEST(MapVerb, EveryScanHasItsPoseUnderTheStampOfTheLog) {
  constexpr int kDrivenScans = 60;
  constexpr double kNear_m = 0.03, kNear_rad = 0.02;
  const TempFolder folder;
  const std::string log = folder.write("room.clf", DrawnRoom::log(kDrivenScans));
  const Ran ran = command({"map", "-q", "--poses", folder.file("poses.tum"), log});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_EQ(ran.printed, "");
  EXPECT_EQ(ran.errors, "");
  const std::vector<TumRow> rows = tum_rows(folder.file("poses.tum"));
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(kDrivenScans));
  for (int k = 0; k < kDrivenScans; ++k) {
    const TumRow& row = rows[static_cast<std::size_t>(k)];
    EXPECT_EQ(row.time, DrawnRoom::stamp(k));
    const pose_wall_planar_pose error = seen_from(DrawnRoom::pose(k), row.pose);
    EXPECT_LT(std::hypot(error.x_m, error.y_m), kNear_m) << k;
    EXPECT_LT(std::abs(error.yaw_rad), kNear_rad) << k;
  }
}

TEST(MapVerb, ThePoseOfAScanIsThatOfItsScanner) {
  constexpr double kOffset_m = 0.4;
  const TempFolder folder;
  const std::string log = folder.write("room.clf", DrawnRoom::log(40, kOffset_m));
  ASSERT_EQ(command({"map", "-q", "--poses", folder.file("poses.tum"), log}).exit_status, 0);
  const std::vector<TumRow> rows = tum_rows(folder.file("poses.tum"));
  ASSERT_EQ(rows.size(), 40U);
  const pose_wall_planar_pose scanner = combined(DrawnRoom::pose(39), {kOffset_m, 0.0, 0.0});
  EXPECT_LT(distance_m(rows.back().pose, scanner), 0.04);
  EXPECT_LT(distance_m(rows.front().pose, {kOffset_m, 0.0, 0.0}), 1e-6) << "the map begins at base";
}

TEST(MapVerb, WritesMapPictureAndGraph) {
  const TempFolder folder;
  const std::string log = folder.write("room.log", DrawnRoom::log(60));
  const Ran ran = command({"map", "-o", folder.file("map"), "--cell", "0.1", log});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  for (const char* row : {"scans", "keyframes", "loop closures", "processor time a scan, mean", "12."}) {
    EXPECT_TRUE(contains(ran.printed, row)) << row << " in " << ran.printed;
  }
  EXPECT_TRUE(contains(ran.errors, "60 scans, 180 beams from -90.0")) << ran.errors;
  const MapFile map = read_map_files(folder.file("map/map.yaml"));
  EXPECT_EQ(map.resolution_m, 0.1);
  const auto cell = [&map](double x_m, double y_m) {
    const auto column = static_cast<std::size_t>(std::floor((x_m - map.origin_x_m) / map.resolution_m));
    const auto row = static_cast<std::size_t>(std::floor((y_m - map.origin_y_m) / map.resolution_m));
    return static_cast<int>(map.cells.at(row * map.width + column));
  };
  EXPECT_EQ(cell(1.0, 1.0), 0) << "the robot drove round it";
  EXPECT_EQ(cell(3.0, 2.0), -1) << "inside the pillar";
  int things = 0;
  for (const double x_m : {7.85, 7.95, 8.05}) things += cell(x_m, 0.0) == 100 ? 1 : 0;
  EXPECT_GE(things, 1) << "the wall at x 8";
  const std::string picture = text_of(folder.file("map/map.svg"));
  EXPECT_TRUE(contains(picture, "data:image/png;base64,") && contains(picture, "</svg>"));
  EXPECT_GT(std::filesystem::file_size(folder.file("map/trail.pwt")), 1000U);
}

TEST(MapVerb, PrintsTheErrorsAgainstRelations) {
  const TempFolder folder;
  const std::string log = folder.write("room.clf", DrawnRoom::log(30));
  const pose_wall_planar_pose step = seen_from(DrawnRoom::pose(0), DrawnRoom::pose(20));
  const std::string relations = folder.write("r", fmt::format("{} {} {} {} 0 0 0 {}\n", DrawnRoom::stamp(0),
                                                              DrawnRoom::stamp(20), step.x_m, step.y_m, step.yaw_rad) +
                                                      "5 6 0 0 0 0 0 0\n");
  const Ran ran = command({"map", "--relations", relations, log});
  EXPECT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_TRUE(contains(ran.printed, "near (< 20 s)") && contains(ran.printed, "all")) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "1 relations have no pose")) << ran.printed;
}

TEST(MapVerb, WhatIsNoRelationIsRefused) {
  const TempFolder folder;
  const std::string log = folder.write("room.clf", DrawnRoom::log(5));
  ASSERT_EQ(command({"map", "-q", "--poses", folder.file("poses.tum"), log}).exit_status, 0);
  const std::pair<std::string, const char*> files[] = {
      {folder.file("poses.tum"), "these are poses"},
      {folder.write("none", "# nothing\n"), "no line holds numbers"},
      {log, "line 2: 'FLASER' is no finite number"},
  };
  for (const auto& [file, answer] : files) {
    const Ran ran = command({"map", "--relations", file, log});
    EXPECT_EQ(ran.exit_status, 1);
    EXPECT_EQ(ran.printed, "") << "known before the work";
    EXPECT_TRUE(contains(ran.errors, file) && contains(ran.errors, answer)) << answer << " in: " << ran.errors;
    EXPECT_TRUE(contains(ran.errors, "t1 t2 x y z roll pitch yaw")) << ran.errors;
  }
  const std::string other = folder.write("other", "5 6 0 0 0 0 0 0\n");
  EXPECT_TRUE(test::says(command({"map", "-q", "--relations", other, "-o", folder.file("map"), log}), 1,
                         "--relations " + other + ": no relation"));
  EXPECT_TRUE(std::filesystem::exists(folder.file("map/map.yaml")));
}

TEST(MapVerb, WorksWithoutOdometry) {
  const TempFolder folder;
  const std::string log = folder.write("room.clf", DrawnRoom::log(40));
  const Ran ran = command({"map", "--no-odometry", "--poses", folder.file("poses.tum"), log});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_TRUE(contains(ran.printed, "none")) << ran.printed;
  EXPECT_LT(distance_m(tum_rows(folder.file("poses.tum")).back().pose, DrawnRoom::pose(39)), 0.05);
}

TEST(MapVerb, FramesBecomeScans) {
  const TempFolder folder;
  ASSERT_EQ(command({"sim", "-q", "--scene", "rough", "--sensor", "vlp16", "-n", "12", "--set", "speed_mps=1", "--set",
                     "rock_repeats=no", "-o", folder.file("road")})
                .exit_status,
            0);
  const Ran ran = command({"map", "-c", folder.file("road/pose_wall.yaml"), "--poses", folder.file("poses.tum"), "-o",
                           folder.file("map"), folder.file("road/frames")});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "12 frames become scans")) << ran.errors;
  const std::vector<TumRow> rows = tum_rows(folder.file("poses.tum"));
  ASSERT_EQ(rows.size(), 12U);
  EXPECT_NEAR(rows.back().pose.x_m, 1.1, 0.1);
  EXPECT_NEAR(rows.back().pose.y_m, 0.0, 0.05);
}

TEST(MapVerb, FaultsAreNamedBeforeAnyWork) {
  const TempFolder folder;
  const std::string log = folder.write("room.clf", DrawnRoom::log(3));
  const std::pair<std::vector<std::string>, const char*> usage[] = {
      {{"map"}, "INPUT"},
      {{"map", "--set", "keyfame_m=1", log}, "did you mean 'keyframe_m'"},
      {{"map", "--set", "keyframe_m=9", log}, "keyframe_m must be from 0.05 to 2"},
      {{"map", "--set", "keyframe_m=x", log}, "'x' is no number"},
      {{"map", "--set", "keyframe_m=9", "--set", "odometry_m=-1", log}, "odometry_m must be from 0 to 1"},
      {{"map", "--set", "voxel_leaf=1", "--set", "odd=1", log},
       "--set odd: no setting for scans of a log; settings: key"},
      {{"map", "--cell", "0.001", log}, "0.02 to 0.5"},
      {{"map", "--poses", log, log}, "this is an input"},
      {{"map", "--relations", folder.file("none"), log}, "there is no file"},
      {{"map", "-o", log, log}, "is a file"},
      {{"map", log, log}, "give a log of CARMEN alone"},
      {{"map", "-c", "vlp16", log}, "--config is for frames"},
  };
  for (const auto& [words, answer] : usage) EXPECT_TRUE(test::says(command(words), 2, answer));
  EXPECT_EQ(text_of(log), DrawnRoom::log(3));
}

TEST(MapVerb, BadInputsLeaveNoResult) {
  const TempFolder folder;
  const std::string bad = folder.write("bad.clf", "FLASER 2 1\n");
  EXPECT_TRUE(test::says(command({"map", "-o", folder.file("map"), "--poses", folder.file("p.tum"), bad}), 1,
                         "bad.clf: no scan can be read"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("p.tum")));
  EXPECT_FALSE(std::filesystem::exists(folder.file("map/map.yaml")));
  const Ran missing = command({"map", "-o", folder.file("map"), folder.file("not_there")});
  EXPECT_EQ(missing.exit_status, 1);
  EXPECT_TRUE(contains(missing.errors, "not_there: there is no such file or folder. Give frames, a bag"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("map/map.yaml"))) << missing.errors;
}

// Of a drive, scans whose ranges no surface explains: each beam ends at a place of its own.
std::string log_of_noise(int scans, int good_of_ten) {
  std::string text;
  for (int k = 0; k < scans; ++k) {
    const auto noise = [k](const pose_wall_planar_pose& /*at*/, double angle_rad) {
      const double mixed = std::sin(1234.5 * angle_rad + 77.7 * k) * 43758.5;
      return 1.5 + 12.0 * (mixed - std::floor(mixed));
    };
    const bool is_good = k < 10 || k % 10 < good_of_ten;
    text += is_good ? DrawnRoom::line(DrawnRoom::stamp(k), DrawnRoom::pose(k))
                    : flaser_line(noise, DrawnRoom::stamp(k), DrawnRoom::pose(k));
  }
  return text;
}

TEST(MapVerb, AMapOfScansThatFitBadlySaysSoFirst) {
  const TempFolder folder;
  const auto map_of = [&folder](const char* name, int good_of_ten) {
    return command({"map", "-o", folder.file(name), folder.write("a.clf", log_of_noise(60, good_of_ten))});
  };
  const Ran good = map_of("good", 10), fair = map_of("fair", 7), bad = map_of("bad", 2);
  EXPECT_EQ(good.exit_status, 0);
  EXPECT_EQ(good.printed.rfind("verdict: the scans fit: of 60, 0 (0.0 %) fit badly", 0), 0U) << good.printed;
  EXPECT_EQ(fair.exit_status, 0);
  EXPECT_EQ(fair.printed.rfind("verdict: doubtful: of 60 scans, ", 0), 0U) << fair.printed;
  EXPECT_EQ(bad.exit_status, 3) << "most scans fit badly";
  EXPECT_EQ(bad.printed.rfind("verdict: not usable: of 60 scans, ", 0), 0U) << bad.printed;
  EXPECT_TRUE(contains(bad.errors, "many scans fit badly")) << bad.errors;
  EXPECT_TRUE(contains(text_of(folder.file("bad/map.svg")), "not usable: of 60 scans"));
  EXPECT_FALSE(contains(text_of(folder.file("good/map.svg")), "the scans fit"));

  for (const auto& [name, verdict] :
       {std::pair("bad", "not usable: of 60 scans"), std::pair("good", "the scans fit")}) {
    const std::string page = folder.file("page.html");
    ASSERT_EQ(command({"report", "-q", "-o", page, folder.file(name)}).exit_status, 0);
    EXPECT_TRUE(contains(text_of(page), verdict)) << name;
    EXPECT_TRUE(contains(text_of(page), "scans that fit badly")) << name;
  }
  folder.write("bad/map.json", "{\"scans\": -1}");
  EXPECT_EQ(command({"report", "-q", "-o", folder.file("page.html"), folder.file("bad")}).exit_status, 0)
      << "a page without the figure, as of a map of a version before it";
}

}  // namespace
}  // namespace pose_wall::tools
