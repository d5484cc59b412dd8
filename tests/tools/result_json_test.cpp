// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a line of JSON holds every cell of the frame's CSV row, the same for good and unreadable frames; each line is
// JSON by itself, whatever the file's name. That Python reads it, too: checks/check_run_json.py.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "io/frames/file_source.hpp"
#include "ran_command.hpp"
#include "study/results/frame_runner.hpp"
#include "study/results/result_json.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using nlohmann::json;
using test::command;
using test::TempFolder;

bool takes(std::string& name, const std::string& beginning) {
  if (name.rfind(beginning, 0) != 0) return false;
  name.erase(0, beginning.size());
  return true;
}

// Where a column of the CSV stands in JSON.
std::string place_of(std::string column) {
  for (const std::string q : {"roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"}) {
    if (column != q && column.rfind(q + "_", 0) != 0) continue;
    const std::string unit = q[1] == '_' ? "_m" : "_rad", place = "/values/" + q + "/";
    const std::string what = column == q ? "value" : column.substr(q.size() + 1);
    if (what == "value" || what == "raw" || what == "sigma") return place + what + unit;
    if (what == "raw_pl") return place + "raw_protection_level" + unit;
    if (what.rfind("pl_", 0) == 0) return place + "protection_level_parts" + unit + "/" + what.substr(3);
    if (what == "pl") return place + "protection_level" + unit;
    return place + (what == "reason" ? "reasons" : what);
  }
  if (column == "total_ms") return "/times_ms/engine";
  if (column == "load_ms") return "/times_ms/load";
  if (column == "processor_ms") return "/times_ms/engine_processor";
  const std::size_t ms = column.rfind("_ms");
  if (ms != std::string::npos) return "/times_ms/stages/" + column.substr(0, ms);  // "floor" is a stage, too
  for (const std::string plane : {"floor", "left_wall", "right_wall"}) {
    if (takes(column, plane + "_")) return "/planes/" + plane + "/" + (column == "reason" ? "reasons" : column);
  }
  if (column == "alert_limit_angle") return "/steer/0/limit_rad";
  if (column == "alert_limit_distance") return "/steer/3/limit_m";
  if (column == "left_right_yaw_difference") return "/" + column + "_rad";
  if (column == "reason" || column == "frame_reason") return "/" + column + "s";
  if (column == "points_in") return "/points/in";
  for (const char* alone : {"frame", "source", "stamp_ns", "confidence", "status", "error", "voxel_leaf_m", "work"}) {
    if (column == alone) return "/" + column;
  }
  return "/points/" + column;
}

std::string cell_of(const json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value;
  if (value.is_number_float()) return csv_number(value);
  if (!value.is_array()) return value.dump();
  std::string names;
  for (const std::string name : value) names += (names.empty() ? "" : "|") + name;
  return names;
}

// Of a frame that could not be read whole branches are null.
const json& at(const json& line, const std::string& place) {
  static const json none;
  const json* here = &line;
  for (const std::string& part : [&place] {
         std::vector<std::string> parts;
         for (std::size_t from = 1, to = 0; to != std::string::npos; from = to + 1) {
           to = place.find('/', from);
           parts.push_back(place.substr(from, to == std::string::npos ? to : to - from));
         }
         return parts;
       }()) {
    if (here->is_null()) return none;
    here = here->is_array() ? &here->at(std::stoul(part)) : &here->at(part);
  }
  return *here;
}

FrameOutcome outcome_of(FrameRunner& runner, const std::string& file) {
  return runner.run(*FileSource({file}).next());
}

void expect_same(const FrameOutcome& outcome) {
  const std::string text = result_json_line(outcome);
  ASSERT_EQ(text.find('\n'), text.size() - 1) << "one line";
  const json line = json::parse(text);
  EXPECT_EQ(line.at("schema"), 1);
  const std::vector<std::string> head = result_head(PartColumns::kAll),
                                 cells = result_cells(outcome, PartColumns::kAll);
  ASSERT_EQ(head.size(), cells.size());
  for (std::size_t i = 0; i < head.size(); ++i) {
    EXPECT_EQ(cell_of(at(line, place_of(head[i]))), cells[i]) << head[i] << " at " << place_of(head[i]);
  }
}

TEST(ResultJson, HoldsEveryCellOfTheRow) {
  const TempFolder folder;
  for (const char* scene : {"clean", "props"}) {
    ASSERT_EQ(
        command({"sim", "--scene", scene, "--sensor", "vlp16", "-n", "2", "-q", "-o", folder.file(scene)}).exit_status,
        0);
    FrameRunner runner(api::Config(), 10.0);
    for (const char* frame : {"/frames/000000.pcd", "/frames/000001.pcd"}) {
      const FrameOutcome outcome = outcome_of(runner, folder.file(scene + std::string(frame)));
      ASSERT_TRUE(outcome.result) << outcome.error;
      expect_same(outcome);
    }
  }
}

TEST(ResultJson, AFrameThatNobodyCanReadHasTheSameMembers) {
  const TempFolder folder;
  FrameRunner runner(api::Config(), 10.0);
  const FrameOutcome good = outcome_of(runner, folder.write("a.bin", test::raw(1.0F) + std::string(12, '\0')));
  ASSERT_TRUE(good.result);
  expect_same(good);
  // A byte that is no UTF-8, and what JSON must write otherwise.
  const FrameOutcome bad = outcome_of(runner, folder.write("b\xff\"\n.bin", "torn"));
  ASSERT_FALSE(bad.result);
  const json line = json::parse(result_json_line(bad)), whole = json::parse(result_json_line(good));
  EXPECT_EQ(line.at("status"), "unreadable");
  EXPECT_NE(line.at("error"), "");
  EXPECT_TRUE(line.at("values").is_null());
  std::vector<std::string> names, names_of_whole;
  for (const auto& [name, value] : line.items()) names.push_back(name);
  for (const auto& [name, value] : whole.items()) names_of_whole.push_back(name);
  EXPECT_EQ(names, names_of_whole);
}

TEST(ResultJson, SaysWhatMaySteer) {
  FrameOutcome outcome;
  outcome.result = api::make_result();
  for (pose_wall_value& value : outcome.result->quantity) value.state = POSE_WALL_VALID;
  outcome.result->quantity[POSE_WALL_D_LF].state = POSE_WALL_INVALID;
  outcome.result->quantity[POSE_WALL_D_LF].reasons = POSE_WALL_R_WALL_SHORT;
  outcome.limits = {0.01, 0.1};
  const json line = json::parse(result_json_line(outcome));
  EXPECT_EQ(line.at("steer").size(), 7U);
  EXPECT_EQ(line.at("steer").at(3).at("cause"), "wall_short");
  EXPECT_EQ(line.at("steer").at(3).at("limit_m"), 0.1);
  EXPECT_EQ(line.at("steer").at(0).at("limit_rad"), 0.01);
  EXPECT_EQ(
      line.at("steer_line").at("en").get<std::string>().rfind("may steer: roll, pitch, yaw, d_lb, d_rf, d_rb; ", 0),
      0U);
  outcome.limits = {0.02, 3.0};
  const std::string loose = json::parse(result_json_line(outcome)).at("steer_line").at("en");
  EXPECT_EQ(
      loose.rfind("may steer: roll (limit 1.146°), pitch (limit 1.146°), yaw (limit 1.146°), d_lb (limit 3.000 m),", 0),
      0U)
      << "whoever widened a limit is told of it: " << loose;
}

TEST(ResultJson, WhatIsNoNumberIsNull) {
  FrameOutcome outcome;
  outcome.result = api::make_result();
  outcome.result->quantity[POSE_WALL_YAW].state = POSE_WALL_DEGRADED;
  outcome.result->quantity[POSE_WALL_YAW].raw = std::numeric_limits<double>::quiet_NaN();
  outcome.result->quantity[POSE_WALL_YAW].protection_level = std::numeric_limits<double>::infinity();
  const json yaw = json::parse(result_json_line(outcome)).at("values").at("yaw");
  EXPECT_TRUE(yaw.at("raw_rad").is_null());
  EXPECT_TRUE(yaw.at("protection_level_rad").is_null());
  EXPECT_EQ(yaw.at("value_rad"), 0.0);
}

}  // namespace
}  // namespace pose_wall::tools
