// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a person who reads Chinese alone understands what is wrong with a command line, a config or a table, and the
// headings of each help page. Does not prove: that the Chinese is good.

#include <gtest/gtest.h>

#include <cstdlib>
#include <utility>
#include <vector>

#include "english_left.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

class CommandInChinese : public ::testing::Test {
 protected:
  void SetUp() override { setenv("POSE_WALL_LANGUAGE", "zh", 1); }
  void TearDown() override { unsetenv("POSE_WALL_LANGUAGE"); }

  const test::EnglishAfterwards english_afterwards_;
  const TempFolder folder_;

  // Refused with that status, in Chinese, with that part.
  static void expect_fault(const std::vector<std::string>& words, int status, const std::string& part) {
    const Ran ran = command(words);
    EXPECT_EQ(ran.exit_status, status) << part;
    EXPECT_TRUE(contains(ran.errors, part)) << part << " | " << ran.errors;
    EXPECT_EQ(english_in(ran.errors), "") << ran.errors;
  }
};

TEST_F(CommandInChinese, FaultsOfTheCommandLine) {
  const std::string file = folder_.write("a.bin", "");
  const std::pair<std::vector<std::string>, const char*> cases[] = {
      {{}, "缺少子命令"},
      {{"run"}, "缺少 INPUT"},
      {{"run", "--confg", file}, "未知选项 --confg；是否指“--config”？"},
      {{"check-config", file, "more"}, "多余的参数“more”"},
      {{"run", file, "--output"}, "--output 后面缺少值"},
      {{"run", file, "--format", "csv", "--format", "json"}, "--format 给出了 2 次，只允许一次"},
      {{"run", file, "--quiet=perhaps"}, "--quiet 不带值"},
      {{"doctor", file, "--height", "99"}, "--height: 99 无效，应为 0.02 至 20 的数"},
      {{"doctor", file, "--height", "nan"}, "nan 无效"},
      {{"report", file, "--points", "9"}, "9 无效，应为 1000 至 20000000 的整数"},
      {{"explain", file, "--frame", "1", "--stamp", "+1"}, "不能同用"},
      {{"doctor", file, "--write-anyway"}, "使用 --write-anyway 时需同时给出 --output"},
      {{"report", file, "--truth", folder_.file("none.csv")}, "没有这个文件"},
      {{"report", file, "--truth", folder_.path()}, "是文件夹"},
      {{"run", file, "-o", folder_.file("no/folder.csv")}, "没有这个文件或文件夹"},
      {{"run", file, "--language", "xx"}, "“xx”无效；可用 zh（中文）"},
  };
  for (const auto& [words, part] : cases) expect_fault(words, 2, part);
}

TEST_F(CommandInChinese, HelpTellsAFolderFromAFile) {
  for (const char* verb : {"drive", "map", "localise", "run", "sim", "campaign"}) {
    EXPECT_TRUE(contains(command({verb, "--help"}).printed, " FOLDER ")) << verb;
  }
}

TEST_F(CommandInChinese, FaultsOfSettings) {
  const std::pair<std::vector<std::string>, const char*> settings[] = {
      {{"voxel_leaf=99"}, "超出允许范围或不是有限数"},
      {{"voxel_leaf=x"}, "无法按该参数的类型读取"},
      {{"forward_axis=+Z"}, "不在可选值中"},
      {{"range_min=9", "range_max=2"}, "range_min 须小于 range_max"},
  };
  for (const auto& [pairs, part] : settings) {
    std::vector<std::string> words = {"check-config"};
    for (const std::string& pair : pairs) words.insert(words.end(), {"--set", pair});
    expect_fault(words, 2, part);
  }
  const std::pair<const char*, const char*> files[] = {
      {"voxel_leaf: 0.1\nrange_min 1\n", "缺少“: ”（冒号加空格）"},
      {"voxel_leaf: 0.1\n\trange_min: 1\n", "Tab"},
      {"voxel_leaf: range_min: 1\n", "此处不能再出现“: ”"},
      {"# \xC4\xE3\n", "UTF-8"},
  };
  for (const auto& [text, part] : files) expect_fault({"check-config", folder_.write("c.yaml", text)}, 2, part);
}

TEST_F(CommandInChinese, AProblemOfYamlWithoutChineseStandsInBrackets) {
  EXPECT_TRUE(test::says(command({"check-config", folder_.write("c.yaml", "%YAML 9.9\n---\nvoxel_leaf: 0.1\n")}), 2,
                         "格式有误（found incompatible YAML document）"));
}

TEST_F(CommandInChinese, FaultsOfTables) {
  const std::string good = folder_.write("good.csv", "frame,stamp_ns,roll\n0,0,0\n");
  const std::string other = folder_.write("other.csv", "frame,height\n0,0\n");
  const std::string torn = folder_.write("torn.csv", "frame\n0,1\n");
  expect_fault({"eval", good, other}, 1, "真值中没有 roll、pitch、yaw");
  expect_fault({"eval", torn, good}, 1, "第 2 行有 2 个单元格，表头有 1 列");
  expect_fault({"eval", folder_.file("none.csv"), good}, 1, "无法打开读取：没有这个文件或文件夹");
  expect_fault({"eval", good, good}, 1, "结果中没有列“roll_raw”");
}

TEST_F(CommandInChinese, HelpPages) {
  for (const char* verb : {"run", "doctor", "report", "info", "eval", "explain", "check-config"}) {
    const Ran ran = command({verb, "--help"});
    EXPECT_EQ(ran.exit_status, 0) << verb;
    for (const char* part : {"用法:", "\n选项:\n", "显示本帮助后退出"})
      EXPECT_TRUE(contains(ran.printed, part)) << verb;
    for (const char* word : {"Usage", "OPTIONS", "Options", "Positionals", "REQUIRED", "Needs", "Excludes", "Print"}) {
      EXPECT_FALSE(contains(ran.printed, word)) << verb << ": " << word << "\n" << ran.printed;
    }
  }
  const Ran top = command({"--help"});
  for (const char* part : {"掘进机", "\n子命令:\n", "仿真一条巷道", "每个子命令都有自己的 --help。"}) {
    EXPECT_TRUE(contains(top.printed, part)) << top.printed;
  }
}

TEST_F(CommandInChinese, AnUnknownLanguageOfTheEnvironmentGivesOneLine) {
  setenv("POSE_WALL_LANGUAGE", "chn", 1);
  const Ran told = command({"check-config"});
  EXPECT_EQ(told.exit_status, 0);
  EXPECT_EQ(told.errors, "pose_wall: POSE_WALL_LANGUAGE=chn: zh (Chinese, 中文) or en (English) is allowed\n");
  EXPECT_EQ(command({"check-config", "--language", "zh_CN"}).errors, "");
  setenv("POSE_WALL_LANGUAGE", "cn", 1);
  EXPECT_TRUE(contains(command({"run"}).errors, "缺少 INPUT"));
}

}  // namespace
}  // namespace pose_wall::tools
