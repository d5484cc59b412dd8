// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: info ends with commands that fit the sensor and the input; an input that is not there is one error; nothing
// it prints stays English when Chinese is chosen. What it finds out about sensors: info_sensor_test.cpp.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "io/language/language.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

std::string road(const TempFolder& folder, const std::string& name, const std::string& sensor) {
  EXPECT_EQ(command({"sim", "-q", "--sensor", sensor, "--frames", "2", "--output", folder.file(name)}).exit_status, 0);
  return folder.file(name + "/frames");
}

TEST(InfoVerb, EndsWithCommandsThatFitTheSensor) {
  const TempFolder folder;
  const std::string frames = road(folder, "a road", "vlp16");
  const std::string text = command({"info", "-q", frames}).printed;
  EXPECT_TRUE(contains(text, "pose_wall doctor -o pose_wall.yaml '" + frames + "'\n")) << text;
  EXPECT_TRUE(contains(text, "pose_wall run --config vlp16 -o results.csv '" + frames + "'\n")) << text;
  const std::string other = road(folder, "other", "os1-64");
  EXPECT_FALSE(contains(command({"info", "-q", frames, other}).printed, "pose_wall run")) << "two sensors, two configs";
  EXPECT_TRUE(contains(command({"info", "-q", other, other}).printed, "--config os1-64 -o results.csv " + other + " "));
}

TEST(InfoVerb, WhatIsNotThereIsOneError) {
  const TempFolder folder;
  const std::string nowhere = folder.file("nowhere");
  const Ran ran = command({"info", nowhere});
  EXPECT_EQ(ran.exit_status, 1);
  EXPECT_EQ(ran.printed, "");
  EXPECT_EQ(ran.errors, "pose_wall info: " + nowhere + ": there is no such file or folder\n");
  EXPECT_EQ(command({"info", "--json", nowhere}).printed, "[]\n");
  const Ran broken = command({"info", folder.write("a.pcd", "no cloud")});
  EXPECT_EQ(broken.exit_status, 1);
  EXPECT_EQ(broken.printed, "") << "nothing could be read: no table of it";
  EXPECT_TRUE(contains(broken.errors, "a.pcd: ")) << broken.errors;
}

TEST(InfoVerb, SpeaksChinese) {
  const TempFolder folder;
  const std::string frames = road(folder, "road", "vlp16");
  const std::string english = command({"info", "-q", frames}).printed;
  const std::string chinese = command({"info", "-q", "--language", "zh", frames}).printed;
  choose_language(Language::kEnglish);
  for (const char* word : {"elevation", "looks like", "median", "Next:", "no return", "passed over", "understood"}) {
    EXPECT_FALSE(contains(chinese, word)) << word << "\n" << chinese;
  }
  EXPECT_TRUE(contains(chinese, "下一步")) << chinese;
  EXPECT_TRUE(contains(english, "Next:"));
  const Ran json = command({"info", "-q", "--language", "zh", "--json", frames});
  choose_language(Language::kEnglish);
  EXPECT_EQ(json.printed, command({"info", "-q", "--json", frames}).printed) << "JSON has no language";
}

}  // namespace
}  // namespace pose_wall::tools
