// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: pose_wall doctor writes a file that loads and measures, never over one that is there and never for frames
// that are of no use; its exit statuses. What it finds: doctor_test.cpp.

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/frames/whole_file.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

struct Road {
  explicit Road(const std::vector<std::string>& more, const std::string& frames = "4") {
    EXPECT_EQ(
        command({"sim", "--quiet", "--sensor", "vlp16", "--frames", frames, "--output", folder.file("road")}, more)
            .exit_status,
        0);
  }
  Ran doctor(std::vector<std::string> more = {}) const {
    return command({"doctor", "--quiet", folder.file("road/frames")}, more);
  }

  TempFolder folder;
};

TEST(DoctorVerb, WritesAFileThatLoadsAndNeverOverTheOneThatIsThere) {
  const Road road({"--set", "face_distance_m=8", "--set", "mount_pitch_deg=4"});
  const std::string file = road.folder.file("out.yaml");
  const Ran first = road.doctor({"-o", file});
  EXPECT_EQ(first.exit_status, 0) << first.printed;
  const std::string text = text_of(file);
  EXPECT_TRUE(contains(text, "\nextrinsic_pitch: 0.0")) << text;
  EXPECT_TRUE(contains(text, "# VLP-16 class: as in config/vlp16.yaml")) << text;
  EXPECT_TRUE(contains(text, "\nrange_bias_max: 0.03\n")) << "of its data sheet, though it is the default: " << text;
  EXPECT_EQ(command({"run", "--quiet", "-c", file, "-o", road.folder.file("o.csv"), road.folder.file("road/frames")})
                .exit_status,
            0);
  EXPECT_TRUE(contains(text_of(road.folder.file("o.csv")), ",valid,"));

  EXPECT_TRUE(test::says(road.doctor({"-o", file}), 2, "--force"));
  EXPECT_EQ(text_of(file), text);
  road.folder.write("out.yaml", "old");
  EXPECT_EQ(road.doctor({"--force", "-o", file}).exit_status, 0);
  EXPECT_EQ(text_of(file), text);
  EXPECT_FALSE(std::filesystem::exists(part_of(file)));

  // A second look with what was written finds nothing more to level.
  const Ran second = road.doctor({"-c", file, "--json"});
  EXPECT_EQ(second.exit_status, 0);
  const nlohmann::json found = nlohmann::json::parse(second.printed);
  for (const auto& change : found.at("changes")) {
    EXPECT_NE(change.at("key"), "extrinsic_pitch");
    EXPECT_NE(change.at("key"), "forward_axis");
  }
}

TEST(DoctorVerb, TellsTheSameInTablesAndJson) {
  const Road road({"--set", "face_distance_m=8"});
  const Ran as_json = road.doctor({"--json"}), as_tables = road.doctor();
  EXPECT_EQ(as_json.exit_status, 0);
  EXPECT_EQ(as_tables.exit_status, 0);
  const nlohmann::json json = nlohmann::json::parse(as_json.printed);
  EXPECT_EQ(json.at("usable"), true);
  EXPECT_EQ(json.at("sensor").at("class"), "vlp16");
  EXPECT_EQ(json.at("road").at("forward_axis"), "+X");
  EXPECT_EQ(json.at("grade"), "in_part") << "0.4 s are no 30 s";
  EXPECT_TRUE(contains(as_tables.printed, "Verdict:\n  usable in part: ")) << as_tables.printed;
  for (const char* step :
       {"pose_wall doctor -o pose_wall.yaml ", "pose_wall check-config pose_wall.yaml\n",
        "pose_wall run -c pose_wall.yaml -o results.csv ", "pose_wall report -c pose_wall.yaml -o report.html "}) {
    EXPECT_TRUE(contains(as_tables.printed, step)) << step << "\n" << as_tables.printed;
  }
}

TEST(DoctorVerb, AGuessedAxisIsCalledAGuessInTheFileAndInTheNextSteps) {
  const Road road({});
  const std::string file = road.folder.file("out.yaml");
  const Ran ran = road.doctor({"-o", file});
  EXPECT_TRUE(contains(text_of(file), "GUESS")) << text_of(file);
  EXPECT_TRUE(contains(ran.printed, "# +X is a GUESS")) << ran.printed;
}

TEST(DoctorVerb, WhatCannotBeUsedIsRefusedAndNothingIsWritten) {
  struct {
    std::vector<std::string> words;
    const char* frames;
    const char* reason;
  } const cases[] = {
      {{}, "1", "too few frames (1;"},
      {{"--scene", "no_floor"}, "4", "floor"},
      {{"--set", "walls=none"}, "4", "walls"},
      {{"--set", "unit_scale=1000"}, "4", "millimetres?"},
      {{"--set", "sway_roll_deg=8", "--set", "sway_period_s=0.4"}, "5", "the sensor moved"},
  };
  for (const auto& [words, frames, reason] : cases) {
    const Road road(words, frames);
    const Ran ran = road.doctor({"-o", road.folder.file("out.yaml")});
    EXPECT_EQ(ran.exit_status, 3) << reason;
    EXPECT_TRUE(contains(ran.printed, "not usable because")) << reason;
    EXPECT_TRUE(contains(ran.printed, reason)) << ran.printed;
    EXPECT_FALSE(std::filesystem::exists(road.folder.file("out.yaml"))) << reason;
    EXPECT_FALSE(std::filesystem::exists(part_of(road.folder.file("out.yaml")))) << reason;
    EXPECT_TRUE(contains(ran.errors, "--write-anyway")) << ran.errors;
    const std::size_t again = ran.printed.find("# record 30 s again"), anyway = ran.printed.find("never to control");
    EXPECT_LT(again, anyway) << ran.printed;
    EXPECT_FALSE(contains(ran.printed, "pose_wall run -c")) << "there is no file to run with";
  }
}

TEST(DoctorVerb, WritesAnUnusableProposalOnDemandWithItsDoubts) {
  const Road road({"--set", "sway_roll_deg=8", "--set", "sway_period_s=0.4"}, "5");
  const std::string file = road.folder.file("out.yaml");
  EXPECT_EQ(road.doctor({"--write-anyway"}).exit_status, 2) << "there is no file to write";
  const Ran ran = road.doctor({"-o", file, "--write-anyway"});
  EXPECT_EQ(ran.exit_status, 3);
  const std::string text = text_of(file);
  EXPECT_TRUE(contains(text, "# Verdict: not usable because the sensor moved")) << text;
  EXPECT_TRUE(contains(text, "# Doubt: the recording has 0.5 s")) << text;
  EXPECT_EQ(command({"check-config", file}).exit_status, 0);
}

// What `run` prints for the same frames and the written file, by quantity and state.
std::map<std::string, double> shares_of_run(const Road& road, const std::string& config, std::size_t* frames) {
  const std::string file = road.folder.file("run.csv");
  EXPECT_EQ(command({"run", "-q", "-c", config, "-o", file, road.folder.file("road/frames")}).exit_status, 0);
  const CsvTable table = test::table_of(file);
  std::map<std::string, double> shares;
  *frames = table.rows();
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    const std::string name = pose_wall_quantity_name(q);
    const std::size_t column = *table.find_column(name + "_state");
    for (std::size_t row = 0; row < table.rows(); ++row) {
      shares[name + "/" + table.cell(row, column)] += 1.0 / static_cast<double>(table.rows());
    }
  }
  return shares;
}

TEST(DoctorVerb, ItsPreviewIsWhatRunThenGives) {
  // A wall that ends, and a machine that turns: values are held, smoothed and refused along the way.
  const Road roads[] = {Road({"--set", "face_distance_m=8", "--set", "base_height_m=1.4"}, "12"),
                        Road({"--set", "walls=left", "--set", "base_height_m=1.4"}, "8"),
                        Road({"--set", "sway_roll_deg=8", "--set", "sway_period_s=0.4"}, "8")};
  for (const Road& road : roads) {
    const std::string file = road.folder.file("out.yaml");
    const nlohmann::json check =
        nlohmann::json::parse(road.doctor({"-o", file, "--write-anyway", "--json"}).printed).at("check");
    std::size_t frames = 0;
    std::map<std::string, double> run = shares_of_run(road, file, &frames);
    EXPECT_EQ(check.at("frames"), frames);
    for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
      const std::string name = pose_wall_quantity_name(q);
      for (const char* state : {"valid", "degraded", "held"}) {
        EXPECT_NEAR(check.at(name).at(state), run[name + "/" + state], 1e-9) << name << " " << state;
      }
    }
  }
}

TEST(DoctorVerb, EmptyAndBrokenFramesAreNamed) {
  const TempFolder folder;
  folder.write("f/a.bin", "");
  folder.write("f/b.bin", "");
  folder.write("f/c.bin", "");
  const Ran empty = command({"doctor", "-q", folder.file("f")});
  EXPECT_EQ(empty.exit_status, 3);
  EXPECT_TRUE(contains(empty.printed, "3 of 3 frames have no return")) << empty.printed;
  folder.write("g/a.pcd", "no cloud");
  const Ran ran = command({"doctor", "-q", folder.file("g")});
  EXPECT_EQ(ran.exit_status, 1);
  EXPECT_TRUE(contains(ran.errors, "a.pcd")) << ran.errors;
  EXPECT_EQ(ran.printed, "") << "nothing could be read: no tables of it";
  EXPECT_EQ(command({"doctor", folder.file("f"), "--height", "99"}).exit_status, 2);
}

}  // namespace
}  // namespace pose_wall::tools
