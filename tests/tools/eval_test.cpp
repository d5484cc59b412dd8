// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the tables of eval keep the four states apart, never call a value usable that was not valid, say their units,
// and come in both languages. The numbers: comparison_test.cpp.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

// Ten frames of roll: the states that are given, the last ones invalid.
struct Roll {
  explicit Roll(const std::vector<std::string>& states) {
    std::string results = "frame,stamp_ns,roll,roll_raw,roll_sigma,roll_pl,roll_state\n",
                truth = "frame,stamp_ns,roll\n";
    for (std::size_t f = 0; f < 10; ++f) {
      const std::string key = std::to_string(f) + "," + std::to_string(100 * f);
      results += key + ",0.1,0.1,0.01,0.5," + (f < states.size() ? states[f] : "invalid") + "\n";
      truth += key + ",0\n";
    }
    words = {"eval", folder.write("o.csv", results), folder.write("t.csv", truth)};
  }
  Ran eval(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = words;
    all.insert(all.end(), more.begin(), more.end());
    return command(all);
  }

  TempFolder folder;
  std::vector<std::string> words;
};

// The cells of the row that begins so, in the table whose head begins with this word.
std::vector<std::string> row_of(const std::string& printed, const std::string& table, const std::string& name) {
  std::istringstream lines(printed);
  bool is_in_table = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(table + " ", 0) == 0) is_in_table = true;
    if (!is_in_table || line.rfind(name + " ", 0) != 0) continue;
    std::istringstream words(line);
    std::vector<std::string> cells;
    for (std::string word; words >> word;) cells.push_back(word);
    return cells;
  }
  return {};
}

TEST(EvalTables, NothingIsUsableWhereNothingIsValid) {
  const Ran ran = Roll({"degraded", "degraded", "degraded", "degraded", "held", "held"}).eval();
  ASSERT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_FALSE(contains(ran.printed, "usable")) << ran.printed;
  const std::vector<std::string> cells = row_of(ran.printed, "value", "roll");
  ASSERT_GE(cells.size(), 10U) << ran.printed;
  // name, frames, valid, degraded, held, invalid: each share with its sign.
  EXPECT_EQ(cells,
            (std::vector<std::string>{"roll", "10", "0.00", "%", "40.00", "%", "20.00", "%", "40.00", "%", "5.7296°",
                                      "5.7296°", "5.7296°", "5.7296°", "0.00", "%", "none", "valid"}));
}

TEST(EvalTables, CountValidValuesBeyondTheAlertLimit) {
  const Ran ran = Roll({"valid", "valid", "degraded"}).eval();
  EXPECT_TRUE(contains(ran.printed, "2 of 2")) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "valid and > alert limit")) << ran.printed;
}

TEST(EvalTables, SayTheirUnitsBesideThoseOfTheFiles) {
  const Ran ran = Roll({"valid"}).eval();
  EXPECT_TRUE(contains(ran.printed, "Angles in degrees, distances in millimetres")) << ran.printed;
  EXPECT_TRUE(contains(ran.printed, "hold radians and metres")) << ran.printed;
}

TEST(EvalTables, JsonCountsEachState) {
  const nlohmann::json roll = nlohmann::json::parse(
      Roll({"valid", "degraded", "degraded", "held"}).eval({"--json"}).printed)["quantities"]["roll"];
  EXPECT_EQ(roll.at("valid"), 1);
  EXPECT_EQ(roll.at("degraded"), 2);
  EXPECT_EQ(roll.at("held"), 1);
  EXPECT_EQ(roll.at("invalid"), 6);
}

// A folder of the simulator's: what is right by one truth is wrong by the other, and each says its name.
TEST(EvalTables, AFolderHasTwoTruths) {
  const Roll roll({"valid", "valid"});
  std::string road = "frame,stamp_ns,roll\n", surveyed = road;
  for (int f = 0; f < 10; ++f) {
    road += fmt::format("{},{},0\n", f, 100 * f);
    surveyed += fmt::format("{},{},0.1\n", f, 100 * f);
  }
  roll.folder.write("truth.csv", road);
  const std::string folder = roll.folder.path(), results = roll.folder.file("o.csv");
  const Ran one = command({"eval", results, folder});
  EXPECT_TRUE(contains(one.printed, "2 of 2")) << one.printed;
  EXPECT_FALSE(contains(one.printed, "truth.csv: "))
      << "a real road has the truth of its rock alone, under no other name";
  roll.folder.write("surveyed_truth.csv", surveyed);
  const Ran both = command({"eval", results, folder});
  EXPECT_TRUE(contains(both.printed, "truth.csv: the road as a whole")) << both.printed;
  EXPECT_TRUE(contains(both.printed, "2 of 2") && contains(both.printed, "0 of 2")) << both.printed;
  EXPECT_TRUE(contains(both.printed, "surveyed_truth.csv: planes of the rock")) << both.printed;
  const nlohmann::json page = nlohmann::json::parse(command({"eval", results, folder, "--json"}).printed);
  EXPECT_EQ(page.at("truth.csv").at("quantities").at("roll").at("valid_beyond_alert"), 2);
  EXPECT_EQ(page.at("surveyed_truth.csv").at("quantities").at("roll").at("valid_beyond_alert"), 0);
}

TEST(EvalTables, ComeInChinese) {
  const Ran ran = Roll({"degraded"}).eval({"--language", "zh"});
  for (const char* part : {"按 stamp_ns 匹配 10 帧", "有效但超告警限", "无有效值", "仅当状态为有效时才可用于控制"}) {
    EXPECT_TRUE(contains(ran.printed, part)) << part << " | " << ran.printed;
  }
  const Ran help = command({"eval", "--language", "zh", "--help"});
  EXPECT_TRUE(contains(help.printed, "克拉美-罗下界")) << help.printed;
  EXPECT_FALSE(contains(help.printed, "Exit status")) << help.printed;
}

}  // namespace
}  // namespace pose_wall::tools
