// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: run ends with what to do next: the config that fits the sensor, the doctor where no floor is found, the frame
// to look at with a command that works; nothing where all is well. Its head says what signs mean, an invalid value has
// no number, and a level that promises nothing is not shown to the millimetre.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <limits>
#include <sstream>

#include "crafted_value.hpp"
#include "io/config_file/resolved_frames.hpp"
#include "io/language/language.hpp"
#include "io/terminal/whole_lines.hpp"
#include "ran_command.hpp"
#include "study/results/result_json.hpp"
#include "study/results/run_summary.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;
using Words = std::vector<std::string>;

std::string road(const TempFolder& folder, const Words& more) {
  EXPECT_EQ(command({"sim", "-q", "-n", "6", "--sensor", "vlp16", "-o", folder.file("road")}, more).exit_status, 0);
  return folder.file("road/frames");
}

// What follows the closing tables.
std::string next_steps(const Ran& ran) {
  const std::size_t reasons = ran.errors.find("most frequent reasons");
  const std::size_t end = ran.errors.find("\n\n", reasons);
  return end == std::string::npos ? "" : ran.errors.substr(end + 2);
}

TEST(NextSteps, NameTheConfigOfTheSensorAndAFrameToLookAt) {
  const TempFolder folder;
  const std::string frames = road(folder, {"--scene", "no_floor"});
  Ran ran = command({"run", "-s", "forward_axis=+X", "-o", folder.file("o.csv"), frames});
  EXPECT_TRUE(contains(next_steps(ran), "The sensor looks like a VLP-16: try --config vlp16.\n")) << ran.errors;
  ran = command({"run", "-c", "vlp16", "-s", "forward_axis=+X", "-o", folder.file("o.csv"), frames});
  const std::string steps = next_steps(ran);
  EXPECT_FALSE(contains(steps, "--config")) << ran.errors;
  EXPECT_TRUE(contains(steps, "The floor was measured in 0 of 6 frames.")) << ran.errors;
  EXPECT_TRUE(contains(steps, "pose_wall doctor -c vlp16 -s forward_axis=+X " + frames)) << ran.errors;
  EXPECT_LE(std::count(steps.begin(), steps.end(), '\n'), 4);
  const std::size_t at = steps.find("pose_wall explain ");
  ASSERT_NE(at, std::string::npos) << ran.errors;
  std::istringstream proposed(steps.substr(at + 10, steps.find('\n', at) - at - 10));
  Words words;
  for (std::string word; proposed >> word;) words.push_back(word);
  const Ran explained = command(words);
  EXPECT_EQ(explained.exit_status, 0) << steps << explained.errors;
  EXPECT_TRUE(contains(explained.printed, "floor")) << explained.printed;
}

TEST(NextSteps, SayNothingWhereAllIsWellAndNoConfigWhereItIsGiven) {
  const TempFolder folder;
  const std::string frames = road(folder, {"--scene", "clean"});
  const std::string config = folder.file("road/pose_wall.yaml");
  Ran ran = command({"run", "-c", config, "-s", "alert_limit_distance=0.5", "-s", "alert_limit_angle_deg=5", "-o",
                     folder.file("o.csv"), frames});
  EXPECT_FALSE(contains(ran.errors, "pose_wall explain")) << ran.errors;
  EXPECT_FALSE(contains(ran.errors, "--config")) << ran.errors;
  ran = command({"run", "-c", config, "-s", "wall_inlier_min=100000", "-o", folder.file("o.csv"), frames});
  EXPECT_FALSE(contains(ran.errors, "try --config")) << "settings of one's own are not to be replaced: " << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "pose_wall explain")) << ran.errors;
  EXPECT_FALSE(contains(command({"run", "-q", "-o", folder.file("o.csv"), frames}).errors, "pose_wall"));
}

TEST(RunVerb, ItsHeadSaysWhatSignsMeanAsTheEngineDoes) {
  for (const char* axis : {"+X", "-X", "+Y", "-Y"}) {
    api::Config config;
    ASSERT_EQ(config.set("forward_axis", axis), POSE_WALL_OK);
    api::Engine engine;
    ASSERT_EQ(engine.open(config), POSE_WALL_OK);
    pose_wall_cloud cloud{};
    cloud.struct_size = sizeof cloud;
    cloud.x = cloud.y = cloud.z = {0, POSE_WALL_FIELD_FLOAT32};
    cloud.point_step = 12;
    pose_wall_result result = api::make_result();
    ASSERT_EQ(engine.process(cloud, result), POSE_WALL_OK);
    const std::string text = signs_text(resolve_frames(config), "");
    for (const std::uint32_t q : {POSE_WALL_ROLL, POSE_WALL_PITCH, POSE_WALL_YAW}) {
      const std::string sign =
          std::string(pose_wall_quantity_name(q)) + ": + " + pose_wall_sense_name(result.positive_means[q]);
      EXPECT_TRUE(contains(text, sign)) << axis << ": " << text;
    }
    EXPECT_TRUE(contains(text, "in ROS yaw is + to the left")) << text;
    EXPECT_EQ(contains(text, "roll is the nose"), axis[1] == 'Y') << text;
  }
}

TEST(RunVerb, ItsHeadNamesTheUnits) {
  const TempFolder folder;
  const std::string file = folder.write("a.csv", "1 2 3\n");
  EXPECT_TRUE(contains(command({"run", "-o", folder.file("o"), file}).errors, "radians in the CSV, degrees in"));
  EXPECT_TRUE(
      contains(command({"run", "--format", "json", "-o", folder.file("o"), file}).errors, "radians in the JSON"));
}

TEST(RunVerb, SpeaksChinese) {
  const TempFolder folder;
  const std::string file = folder.write("a.csv", "1 2 3\n"), broken = folder.write("b.csv", "1 2\n");
  const Ran ran = command({"run", "--language", "zh", "-o", folder.file("o.csv"), file, broken});
  for (const char* part :
       {"2 帧，配置 默认值", "角度：CSV 中为弧度", "保护级", "最常见的原因及其帧数", "第 1 行：有 2 个值"}) {
    EXPECT_TRUE(contains(ran.errors, part)) << part << "\n" << ran.errors;
  }
  EXPECT_TRUE(contains(table_of(folder.file("o.csv")).head().front(), "frame")) << "columns have no language";
  EXPECT_TRUE(contains(command({"run", "--language", "zh", "--help"}).printed, "坐标单位"));
  EXPECT_TRUE(contains(command({"run", "--language", "zh", "-c", "vpl16", file}).errors, "是否指“vlp16”"));
  choose_language(Language::kEnglish);
}

pose_wall_value expired_value() {
  pose_wall_value value = test::crafted_value(POSE_WALL_DEGRADED, 2.5, 2.4, {0.1, 0.2, 0.0, 0.0, 0.0, 0.0, 0.0});
  value.sigma = 0.01;
  value.state = POSE_WALL_INVALID;
  return value;
}

TEST(ResultRows, AnInvalidValueHasNoNumberInCsvAndJson) {
  FrameOutcome outcome;
  outcome.result = api::make_result();
  for (pose_wall_value& value : outcome.result->quantity) value = expired_value();
  const std::vector<std::string> head = result_head(PartColumns::kAll),
                                 cells = result_cells(outcome, PartColumns::kAll);
  const auto cell = [&](const char* name) {
    return cells.at(static_cast<std::size_t>(std::find(head.begin(), head.end(), name) - head.begin()));
  };
  for (const char* name : {"d_lf", "d_lf_sigma", "d_lf_pl", "d_lf_cause", "d_lf_pl_random"}) EXPECT_EQ(cell(name), "");
  EXPECT_EQ(cell("d_lf_raw"), "2.4") << "what this frame measured stays";
  EXPECT_EQ(cell("d_lf_state"), "invalid");
  EXPECT_TRUE(contains(result_json_line(outcome), "\"value_m\":null")) << result_json_line(outcome);
}

TEST(ClosingTable, ALevelBeyondTenAlertLimitsIsNoTolerance) {
  RunSummary summary;
  FrameOutcome outcome;
  outcome.limits = {1.0 * kRadPerDeg, 0.1};
  outcome.result = api::make_result();
  for (pose_wall_value& value : outcome.result->quantity) value = test::unmeasured_value();
  outcome.result->quantity[POSE_WALL_D_LF] =
      test::crafted_value(POSE_WALL_DEGRADED, 2.5, 2.5, {20.862, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  outcome.result->quantity[POSE_WALL_D_RF] =
      test::crafted_value(POSE_WALL_DEGRADED, 2.5, 2.5, {0.9, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  outcome.result->quantity[POSE_WALL_ROLL] =
      test::crafted_value(POSE_WALL_DEGRADED, 0.1, 0.1, {1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  summary.add(outcome);
  const std::string text = summary.text(1.0);
  EXPECT_FALSE(contains(text, "20.862")) << text;
  EXPECT_TRUE(contains(text, "> 1 m") && contains(text, "> 10°") && contains(text, "0.900 m")) << text;
}

// Both streams into one place, as a terminal or `> log 2>&1`.
TEST(WholeLines, RowsAndMessagesDoNotTearEachOther) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[1], 1);
    dup2(ends[1], 2);
    close(ends[0]);
    write_whole_lines();
    for (int i = 0; i < 400; ++i) {
      std::fprintf(stdout, "row %s\n", std::string(97, 'r').c_str());
      if (i % 10 == 0) std::fprintf(stderr, "message\n");
    }
    std::fflush(stdout);
    _exit(0);
  }
  close(ends[1]);
  std::string all;
  std::array<char, 4096> part{};
  for (ssize_t count = 0; (count = read(ends[0], part.data(), part.size())) > 0;) {
    all.append(part.data(), static_cast<std::size_t>(count));
  }
  close(ends[0]);
  waitpid(child, nullptr, 0);
  std::istringstream lines(all);
  const std::string row = "row " + std::string(97, 'r');
  std::size_t rows = 0, messages = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line == row) ++rows;
    if (line == "message") {
      EXPECT_EQ(rows, messages * 10 + 1) << "behind the row before which it was written";
      ++messages;
    }
  }
  EXPECT_EQ(rows, 400U);
  EXPECT_EQ(messages, 40U);
}

TEST(NextSteps, NameNoConfigThatHoldsTheDefaultsAndTheProgramAsItWasCalled) {
  const TempFolder folder;
  ASSERT_EQ(command({"sim", "-q", "-n", "4", "--sensor", "os0-128", "-o", folder.file("road")}).exit_status, 0);
  const std::string frames = folder.file("road/frames"), out = folder.file("o.csv");
  const char* const low = "ground_height_max=0.5";  // no floor is so near
  Ran ran = command({"run", "-s", low, "-o", out, frames});
  EXPECT_FALSE(contains(ran.errors, "--config")) << ran.errors;
  EXPECT_TRUE(contains(next_steps(ran), "by: pose_wall doctor ")) << ran.errors;
  ran = command({"run", "-c", "vlp16", "-s", low, "-o", out, frames});
  EXPECT_TRUE(contains(ran.errors, "OS0-128, for which the defaults are made: try without --config.")) << ran.errors;

  const char* const words[] = {"build/release/pose_wall", "run", "-s", low, "-o", out.c_str(), frames.c_str()};
  ::testing::internal::CaptureStderr();
  run_command(7, words);
  const std::string errors = ::testing::internal::GetCapturedStderr();
  EXPECT_TRUE(contains(errors, "by: build/release/pose_wall doctor ")) << errors;
  EXPECT_TRUE(contains(errors, "build/release/pose_wall explain --frame ")) << errors;
}

}  // namespace
}  // namespace pose_wall::tools
