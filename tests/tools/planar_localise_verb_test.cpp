// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: `pose_wall localise` keeps its contract: states, poses, restarts, candidates, errors against a truth, faults
// of maps by name; exit statuses. Does not prove: that a place is found, and never wrongly (tests/planar).

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "io/language/language.hpp"
#include "planar_logs.hpp"
#include "ran_command.hpp"
#include "study/planar/localised_rows.hpp"
#include "study/planar/plane_pose.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr int kScans = 126;  // once round

// The map begins where base stood at first.
pose_wall_planar_pose in_map(int scan) {
  return seen_from(DrawnChamber::pose(0), DrawnChamber::pose(scan));
}

// A map of a chamber, the log that it is of, and the poses of its scans.
struct MappedChamber {
  TempFolder folder;
  std::string log = folder.write("room.clf", DrawnChamber::log(kScans));
  std::string map = folder.file("map");
  std::string poses = folder.file("poses.tum");

  MappedChamber() {
    const Ran ran = command({"map", "-q", "-o", map, "--poses", poses, log});
    EXPECT_EQ(ran.exit_status, 0) << ran.errors;
  }
  std::vector<LocalisedRow> rows(const std::string& output) const {
    return read_localised_rows(table_of(folder.file(output + "/localise.csv")));
  }
};

// The chamber has smooth walls: only a machine that cannot be elsewhere is there for sure.
const std::vector<std::string> kInside = {"-s", "map_is_whole=1", "-s", "work=1000000000"};

std::vector<std::string> with(std::vector<std::string> words, const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

TEST(LocaliseVerb, ScansAreFoundInTheirMap) {
  const MappedChamber room;
  const Ran ran = command(with({"localise", room.map, room.log, "--truth", room.poses, "--poses",
                                room.folder.file("found.tum"), "-o", room.folder.file("found")},
                               kInside));
  ASSERT_EQ(ran.exit_status, 0) << ran.errors << ran.printed;
  for (const char* words :
       {"unique", "travel until unique", "unique and wrong (0.5 m or 5.7°)", "keyframes", "error, worst"}) {
    EXPECT_TRUE(contains(ran.printed, words)) << words << " in " << ran.printed;
  }
  const std::vector<LocalisedRow> rows = room.rows("found");
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(kScans));
  std::size_t unique = 0;
  for (const LocalisedRow& row : rows) {
    if (!row.is_unique()) continue;
    ++unique;
    EXPECT_LT(row.error_m, 0.1) << row.scan;
    EXPECT_GT(row.covariance[0], 0.0);
    EXPECT_EQ(row.reason, 0U);
  }
  EXPECT_GT(unique, rows.size() / 2);
  EXPECT_TRUE(rows.front().is_restart);
  EXPECT_NEAR(rows.back().travel_m, 0.075 * (kScans - 1), 0.05);
  const std::string picture = text_of(room.folder.file("found/localise.svg"));
  EXPECT_TRUE(contains(picture, "data:image/png;base64,") && contains(picture, "<polyline"));
  EXPECT_FALSE(contains(text_of(room.folder.file("found.tum")), "nan"));
}

TEST(LocaliseVerb, WhatIsNotUniqueHasAReasonAndCandidates) {
  const MappedChamber room;
  const Ran ran = command({"localise", room.map, room.log, "-o", room.folder.file("found"), "-s", "work=1000000000"});
  EXPECT_EQ(ran.exit_status, 3) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "candidates of the last answer")) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "last place")) << ran.printed;
  EXPECT_TRUE(contains(ran.errors, "one candidate is left")) << ran.errors;
  std::set<std::uint32_t> reasons;
  for (const LocalisedRow& row : room.rows("found")) {
    EXPECT_FALSE(row.is_unique()) << "smooth walls prove nothing where the map may lack a chamber like this one";
    EXPECT_TRUE(std::isnan(row.base.x_m));
    reasons.insert(row.reason);
  }
  EXPECT_EQ(reasons.count(0), 0U);
  const CsvTable candidates = table_of(room.folder.file("found/candidates.csv"));
  ASSERT_GT(candidates.rows(), 0U);
  EXPECT_EQ(candidates.cell(0, *candidates.find_column("candidate")), "1");
}

TEST(LocaliseVerb, AGivenStartIsTrackedAtOnce) {
  const MappedChamber room;
  const Ran ran = command({"localise", room.map, room.log, "--start", "0.1,0.1,3", "-o", room.folder.file("found")});
  ASSERT_EQ(ran.exit_status, 0) << ran.errors << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "°, by ± 0.0")) << ran.printed;
  const std::vector<LocalisedRow> rows = room.rows("found");
  EXPECT_FALSE(rows.front().is_restart);
  for (const LocalisedRow& row : rows) EXPECT_TRUE(row.has_pose()) << row.scan;
  EXPECT_LT(distance_m(rows[40].base, in_map(40)), 0.1);
  EXPECT_EQ(rows.back().searches, 0U);
}

TEST(LocaliseVerb, RestartsComeEveryFewMetres) {
  const MappedChamber room;
  const Ran ran = command(with(
      {"localise", room.map, room.log, "--restart", "2", "-o", room.folder.file("found"), "--no-odometry"}, kInside));
  EXPECT_TRUE(contains(ran.printed, "restarts")) << ran.printed;
  std::vector<double> at_m;
  for (const LocalisedRow& row : room.rows("found")) {
    if (row.is_restart) at_m.push_back(row.travel_m);
  }
  ASSERT_EQ(at_m.size(), 5U) << "the first scan, and after 2, 4, 6 and 8 m";
  for (std::size_t k = 1; k < at_m.size(); ++k) EXPECT_NEAR(at_m[k] - at_m[k - 1], 2.1, 0.1);
}

TEST(LocaliseVerb, UniqueAndWrongIsCounted) {
  const MappedChamber room;
  std::string shifted;
  for (int k = 0; k < kScans; ++k) {
    pose_wall_planar_pose elsewhere = in_map(k);
    elsewhere.x_m += 1.0;
    shifted += tum_line(DrawnRoom::stamp(k), elsewhere);
  }
  const Ran ran = command(with({"localise", room.map, room.log, "--truth", room.folder.write("shifted.tum", shifted),
                                "-o", room.folder.file("found")},
                               kInside));
  const LocaliseFigures figures = figures_of(room.rows("found"));
  EXPECT_GT(figures.compared, 0U);
  EXPECT_EQ(figures.wrong, figures.compared) << "a truth a metre beside it";
  EXPECT_NEAR(figures.error_mean_m, 1.0, 0.1);
  EXPECT_TRUE(contains(ran.printed, "unique and wrong")) << ran.printed;
}

TEST(LocaliseVerb, CellsAreAMapToo) {
  const MappedChamber room;
  const Ran ran = command(with(
      {"localise", room.map + "/map.yaml", room.log, "--truth", room.poses, "-o", room.folder.file("found")}, kInside));
  EXPECT_TRUE(contains(ran.printed, "cells alone")) << ran.printed;
  EXPECT_TRUE(contains(ran.errors, "cells hold less")) << ran.errors;
  const LocaliseFigures figures = figures_of(room.rows("found"));
  EXPECT_EQ(figures.wrong, 0U);
}

TEST(LocaliseVerb, FramesAreFoundByTheRelief) {
  const TempFolder folder;
  ASSERT_EQ(command({"sim", "-q", "--scene", "rough", "--sensor", "vlp16", "-n", "14", "--set", "speed_mps=1", "--set",
                     "rock_repeats=no", "-o", folder.file("road")})
                .exit_status,
            0);
  const std::string config = folder.file("road/pose_wall.yaml"), frames = folder.file("road/frames");
  ASSERT_EQ(command({"map", "-q", "-c", config, "-o", folder.file("map"), "--poses", folder.file("p.tum"), frames})
                .exit_status,
            0);
  const Ran ran = command({"localise", folder.file("map"), "-c", config, frames, "--truth", folder.file("p.tum"), "-o",
                           folder.file("found"), "-s", "work=1000000000"});
  EXPECT_NE(ran.exit_status, 1) << ran.errors;
  const LocaliseFigures figures = figures_of(read_localised_rows(table_of(folder.file("found/localise.csv"))));
  EXPECT_EQ(figures.scans, 14U);
  EXPECT_EQ(figures.wrong, 0U);
  EXPECT_GT(figures.compared, 0U) << ran.printed;
}

TEST(LocaliseVerb, FaultsOfTheMapAreNamed) {
  const MappedChamber room;
  const std::string trail = text_of(room.map + "/trail.pwt");
  std::string other_version = trail, damaged = trail;
  other_version[4] = 9;
  damaged[trail.size() / 2] = static_cast<char>(damaged[trail.size() / 2] ^ 1);
  std::filesystem::create_directory(room.folder.file("empty"));
  const std::pair<std::string, const char*> cases[] = {
      {room.folder.write("a.pwt", "no trail at all"), "a.pwt: this is no map for localisation"},
      {room.folder.write("e.pwt", ""), "e.pwt: this is no map for localisation"},
      {room.folder.write("b.pwt", other_version), "a trail of version 9; this program reads version 1"},
      {room.folder.write("c.pwt", damaged), "c.pwt: the trail is cut off or damaged"},
      {room.folder.write("d.pwt", trail.substr(0, trail.size() - 7)), "d.pwt: the trail is cut off or damaged"},
      {room.log, "this is a log of scans, no map. Make one first: pose_wall map -o map"},
      {room.folder.file("empty"), "neither trail.pwt nor map.yaml"},
      {room.map + "/map.pgm", "give the map's YAML file"},
      {room.folder.file("not_there"), "cannot be read"},
  };
  for (const auto& [map, answer] : cases) {
    const Ran ran = command({"localise", map, room.log, "-o", room.folder.file("none")});
    EXPECT_EQ(ran.exit_status, 1) << map;
    EXPECT_TRUE(contains(ran.errors, answer)) << answer << " in: " << ran.errors;
    EXPECT_FALSE(std::filesystem::exists(room.folder.file("none")));
  }
}

TEST(LocaliseVerb, FaultsOfUsage) {
  const MappedChamber room;
  const std::pair<std::vector<std::string>, const char*> usage[] = {
      {{"localise"}, "MAP"},
      {{"localise", room.map}, "INPUT"},
      {{"localise", room.map, room.log, "-s", "map_is_hole=1"}, "did you mean 'map_is_whole'"},
      {{"localise", room.map, room.log, "-s", "map_is_whole=2"}, "map_is_whole must be 0 or 1"},
      {{"localise", room.map, room.log, "--start", "1,2"}, "x,y,yaw"},
      {{"localise", room.map, room.log, "--start", "1200,3,90"},
       "--start 1200,3,90 lies outside the map. The map reaches from x"},
      {{"localise", room.map, room.log, "--restart", "0"}, "0.5 to 1e+06"},
      {{"localise", room.map, room.log, "--truth", "none"}, "there is no file"},
      {{"localise", room.map, room.log, "--poses", room.log}, "this is an input"},
      {{"localise", room.map, room.log, "--poses", room.map + "/trail.pwt"}, "this is an input"},
      {{"localize", room.map, room.log}, "did you mean 'localise'"},
  };
  for (const auto& [words, answer] : usage) EXPECT_TRUE(test::says(command(words), 2, answer));
}

TEST(LocaliseVerb, SpeaksChinese) {
  const MappedChamber room;
  const Ran ran = command({"localise", "--language", "zh", room.map, room.log});
  EXPECT_TRUE(contains(ran.printed, "状态") && contains(ran.printed, "候选")) << ran.printed;
  EXPECT_FALSE(contains(ran.printed, "searching")) << ran.printed;
  choose_language(Language::kEnglish);
}

TEST(LocalisedRows, TheirTableReadsBack) {
  LocalisedRow row;
  row.scan = 7;
  row.time = "12.50";
  row.state = POSE_WALL_PLANAR_LOCALISE_DOUBTFUL;
  row.reason = POSE_WALL_PLANAR_LOCALISE_SLIDES;
  row.base = {1.5, -2.0, 0.25};
  row.covariance = {1, 2, 3, 4, 5, 6};
  row.fits = 0.5;
  row.searches = 3;
  row.is_restart = true;
  std::istringstream csv(localised_csv({row}));
  const std::vector<LocalisedRow> read = read_localised_rows(CsvTable::parse(csv));
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].scan, 7U);
  EXPECT_EQ(read[0].time, "12.50");
  EXPECT_EQ(read[0].state, row.state);
  EXPECT_EQ(read[0].reason, row.reason);
  EXPECT_EQ(read[0].base.y_m, -2.0);
  EXPECT_EQ(read[0].covariance, row.covariance);
  EXPECT_TRUE(read[0].is_restart);
  EXPECT_TRUE(std::isnan(read[0].error_m));
  std::string text = localised_csv({row});
  text.replace(text.find("doubtful"), 8, "certain!");
  std::istringstream bad(text);
  const CsvTable table = CsvTable::parse(bad);
  EXPECT_THROW(read_localised_rows(table), CsvError);
}

TEST(LocalisedRows, FiguresCountRestartsAndTheirWay) {
  std::vector<LocalisedRow> rows(6);
  const std::uint32_t states[] = {0, 3, 3, 2, 2, 2};
  for (std::size_t k = 0; k < rows.size(); ++k) {
    rows[k].state = states[k];
    rows[k].travel_m = static_cast<double>(k);
    rows[k].is_restart = k == 0 || k == 3;
  }
  const LocaliseFigures figures = figures_of(rows);
  ASSERT_EQ(figures.restarts.size(), 2U);
  EXPECT_TRUE(figures.restarts[0].is_found);
  EXPECT_EQ(figures.restarts[0].after_m, 1.0);
  EXPECT_EQ(figures.restarts[0].after_scans, 2U);
  EXPECT_FALSE(figures.restarts[1].is_found);
  EXPECT_EQ(figures.restarts[1].after_m, 2.0);
  EXPECT_EQ(figures.of_state[2], 3U);
}

}  // namespace
}  // namespace pose_wall::tools
