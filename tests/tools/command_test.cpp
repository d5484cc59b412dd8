// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the command keeps its contract: columns, rows for unreadable frames, exit statuses. Does not prove: that the
// values are right.

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "io/csv/csv_table.hpp"
#include "ran_command.hpp"
#include "study/results/result_csv.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

std::string kitti_point(float x) {
  return raw(x) + raw(2.0F) + raw(3.0F) + raw(0.5F);
}

TEST(ResultCsv, StartsWithTheColumnsOfTheContract) {
  std::vector<std::string> expected = {"frame", "source", "stamp_ns", "confidence", "status", "reason", "total_ms"};
  for (const std::string q : {"roll", "pitch", "yaw", "d_lf", "d_lb", "d_rf", "d_rb"}) {
    for (const char* ending : {"", "_raw", "_sigma", "_pl", "_state"}) expected.push_back(q + ending);
  }
  std::vector<std::string> head = result_head();
  head.resize(expected.size());
  EXPECT_EQ(head, expected);
}

TEST(RunVerb, OneRowPerFrameAndStampsByRate) {
  const TempFolder folder;
  for (const char* name : {"f/a.bin", "f/b.bin", "f/c.bin"}) folder.write(name, kitti_point(1) + kitti_point(2));
  const Ran ran = command({"run", "--rate", "20", "--output", folder.file("o.csv"), folder.file("f")});
  EXPECT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "forward_axis +X")) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "3 frames in ")) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "\nelapsed ") && contains(ran.errors, "\nprocessor ")) << ran.errors;
  const CsvTable table = table_of(folder.file("o.csv"));
  ASSERT_EQ(table.rows(), 3U);
  EXPECT_GT(table.number(0, *table.find_column("processor_ms")), 0.0);
  EXPECT_EQ(table.number(2, *table.find_column("stamp_ns")), 100000000.0);
  EXPECT_EQ(table.number(2, *table.find_column("points_in")), 2.0);
  EXPECT_EQ(table.cell(1, *table.find_column("source")), folder.file("f/b.bin"));
}

TEST(RunVerb, WithoutAnyInputThereIsNoResult) {
  const TempFolder folder;
  EXPECT_TRUE(test::says(command({"run", "-o", folder.file("o.csv"), folder.file("framez")}), 1,
                         "framez: no such file or folder"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("o.csv")));
}

TEST(RunVerb, UnreadableFramesKeepTheirRowAndTheOthersAreProcessed) {
  const TempFolder folder;
  const std::string good = folder.write("good.bin", kitti_point(1));
  const std::string torn = folder.write("torn.bin", "abc");
  const Ran ran = command(
      {"run", "-q", "-o", folder.file("o.csv"), torn, good, folder.file("missing.pcd"), folder.write("notes.txt", "")});
  EXPECT_EQ(ran.exit_status, 1);
  EXPECT_TRUE(contains(ran.errors, torn + ": no header is known, and 3 bytes do not look like bare points"))
      << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "missing.pcd: not there")) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "notes.txt: the file is empty")) << ran.errors;
  const CsvTable table = table_of(folder.file("o.csv"));
  ASSERT_EQ(table.rows(), 4U);
  const std::size_t status = *table.find_column("status");
  EXPECT_EQ(table.cell(0, status), "unreadable");
  EXPECT_NE(table.cell(1, status), "unreadable");
  EXPECT_EQ(table.cell(2, status), "unreadable");
  const std::vector<std::string> filled = {"frame", "source", "stamp_ns", "status", "reason", "error"};
  for (const std::string& name : table.head()) {
    const bool is_filled = std::find(filled.begin(), filled.end(), name) != filled.end();
    EXPECT_EQ(!table.cell(0, *table.find_column(name)).empty(), is_filled) << name;
  }
  EXPECT_EQ(table.cell(1, *table.find_column("frame")), "1");
}

TEST(RunVerb, WithoutAnyReadableFrameItSaysSoAndShowsNoFigures) {
  const TempFolder folder;
  const Ran ran = command({"run", "-o", folder.file("o.csv"), folder.write("torn.bin", "abc")});
  EXPECT_EQ(ran.exit_status, 1);
  EXPECT_TRUE(contains(ran.errors, "1 frame, none processed")) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "unreadable: 1 of 1 frame")) << ran.errors;
  EXPECT_FALSE(contains(ran.errors, "median value")) << ran.errors;
  EXPECT_FALSE(contains(ran.errors, "verdict")) << ran.errors;
}

TEST(RunVerb, UsageAndConfigFaultsEndBeforeAnyWork) {
  const TempFolder folder;
  const std::string good = folder.write("good.bin", kitti_point(1));
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{"run"}, "INPUT"},
      {{"run", "--set", "voxel_leef=1", good}, "did you mean 'voxel_leaf'"},
      {{"run", "--config", folder.file("none.yaml"), good}, "none.yaml"},
      {{"run", "--rate", "nan", good}, "'nan' is refused"},
      {{"run", "--rate", "0", good}, "'0' is refused"},
      {{"run", "--output", folder.file("no/folder/o.csv"), good}, "cannot be written"},
      {{"run", "--output", good, good}, "this is an input"},
      {{"run", "--outptu", "x", good}, "did you mean '--output'"},
      {{"rum", good}, "did you mean 'run'"},
      {{"eval", good, good, "-5"}, "unexpected number -5"},
      {{"eval", good, good, "-x"}, "unknown option -x"},
      {{"eval", good, good, "5m"}, "unexpected word '5m'"},
      {{"run", "--metadata", good, good}, "no input is a capture of packets"},
      {{"explain", "--frame", "0", "--picture", folder.file("why.png"), good}, "a file ending in .svg is allowed"},
      {{"check-config", "--set", "range_min=9", "--set", "range_max=2"}, "range_min"},
      {{"check-config", "--keys", folder.file("none.yaml")}, "without FILE and --set"},
      {{"check-config", "--keys", "--set", "range_min=1"}, "without FILE and --set"},
      {{"sim", "--seed", "-1", "--output", folder.file("road")}, "--seed: '-1' is refused; a whole number from 0"},
      {{"demo", "--seed", "-1", "--output", folder.file("road")}, "--seed: '-1' is refused"},
      {{"campaign", "--seed", "-1", "--output", folder.file("road")}, "--seed: '-1' is refused"},
      {{"campaign", "--events", "-1", "--output", folder.file("road")}, "--events: '-1' is refused"},
  };
  for (const auto& [words, part] : cases) EXPECT_TRUE(test::says(command(words), 2, part));
  EXPECT_EQ(table_of(folder.write("kept.csv", "a\n1\n")).rows(), 1U);
  EXPECT_EQ(command({"run", "-q", "-o", folder.file("kept.csv"), "--set", "range_min=x", good}).exit_status, 2);
  EXPECT_EQ(table_of(folder.file("kept.csv")).rows(), 1U) << "a refused config must not empty an older result";
}

TEST(Verbs, AFolderWithoutFramesIsAnInputThatCannotBeRead) {
  const TempFolder folder;
  folder.write("f/notes.txt", "");
  const std::string empty = folder.file("f"), out = folder.file("out");
  const std::vector<std::vector<std::string>> calls = {{"run", "-o", out, empty},
                                                       {"doctor", empty},
                                                       {"info", empty},
                                                       {"explain", "--frame", "0", empty},
                                                       {"report", "-o", out, empty}};
  for (const std::vector<std::string>& call : calls) {
    EXPECT_TRUE(test::says(command(call), 1, empty + ": no frame in this folder"));
  }
}

TEST(EvalVerb, ResultsOfRunCanBeCompared) {
  const TempFolder folder;
  folder.write("f/a.bin", kitti_point(1));
  ASSERT_EQ(command({"run", "-q", "-o", folder.file("o.csv"), folder.file("f")}).exit_status, 0);
  const std::string truth =
      folder.write("truth.csv", "frame,stamp_ns,roll,pitch,yaw,d_lf,d_lb,d_rf,d_rb\n0,0,0,0,0,2,2,2,\n");
  const Ran ran = command({"eval", folder.file("o.csv"), truth, "--json"});
  EXPECT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_TRUE(contains(ran.printed, "\"valid_beyond_alert\"")) << ran.printed;
  EXPECT_TRUE(
      test::says(command({"eval", folder.file("o.csv"), truth, "--frames", folder.file("f"), "--range-noise", "0.01"}),
                 2, "--frames needs --config"));
  EXPECT_EQ(command({"eval", folder.file("none.csv"), truth}).exit_status, 1);
  EXPECT_EQ(command({"eval", truth, truth}).exit_status, 1) << "the truth has no roll_raw";
  ASSERT_EQ(command({"run", "-q", "--format", "json", "-o", folder.file("o.jsonl"), folder.file("f")}).exit_status, 0);
  const std::pair<std::string, const char*> cases[] = {
      {folder.file("o.jsonl"), "line 1: this is JSON"}, {folder.path(), "this is a folder"}, {"-", "is /dev/stdin"}};
  for (const auto& [file, part] : cases) {
    const Ran refused = command({"eval", file, truth});
    EXPECT_TRUE(test::says(refused, 1, file + ": ")) << file;
    EXPECT_TRUE(test::says(refused, 1, part)) << file;
  }
}

TEST(EvalVerb, SaysThatRowsWithTheSameNumberHaveOtherStamps) {
  const TempFolder folder;
  folder.write("f/a.bin", kitti_point(1));
  ASSERT_EQ(command({"run", "-q", "-o", folder.file("o.csv"), folder.file("f")}).exit_status, 0);
  const std::string truth = folder.write("truth.csv", "frame,stamp_ns,roll\n0,17,0\n");
  const Ran ran = command({"eval", folder.file("o.csv"), truth, "--json"});
  EXPECT_EQ(ran.exit_status, 0) << ran.errors;
  EXPECT_TRUE(contains(ran.errors, "matched by frame number, but the stamps differ in 1 of 1 pairs")) << ran.errors;
  EXPECT_TRUE(contains(ran.printed, "\"other_stamps\": 1")) << ran.printed;
}

}  // namespace
}  // namespace pose_wall::tools
