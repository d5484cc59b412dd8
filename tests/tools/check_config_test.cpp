// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: check-config tells for each axis ahead what a positive angle means, that yaw counts against ROS, and units;
// no line is wider than a terminal; every key has its meaning in Chinese.

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "io/config_file/key_table.hpp"
#include "io/config_file/live_settings.hpp"
#include "io/config_file/motion_settings.hpp"
#include "io/config_file/planar_settings.hpp"
#include "io/language/language.hpp"
#include "io/terminal/text_table.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using test::command;
using test::contains;

std::string line_of(const std::string& text, const std::string& name) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind(name + " ", 0) == 0) return line;
  }
  return "";
}

TEST(CheckConfig, TellsTheSignsForEachAxisAhead) {
  const struct {
    const char* axis;
    const char* roll;
    const char* pitch;
    const char* left_front;
  } cases[] = {{"+X", "the right side is down", "the nose is down", "(+2.000, +0.000, +0.000)"},
               {"-X", "the left side is down", "the nose is up", "(-2.000, +0.000, +0.000)"},
               {"+Y", "the nose is up", "the right side is down", "(+0.000, +2.000, +0.000)"},
               {"-Y", "the nose is down", "the left side is down", "(+0.000, -2.000, +0.000)"}};
  for (const auto& [axis, roll, pitch, left_front] : cases) {
    const std::string text = command({"check-config", "-s", std::string("forward_axis=") + axis}).printed;
    EXPECT_TRUE(contains(line_of(text, "roll"), std::string("rad   positive: ") + roll)) << axis << "\n" << text;
    EXPECT_TRUE(contains(line_of(text, "pitch"), std::string("rad   positive: ") + pitch)) << axis;
    EXPECT_TRUE(contains(line_of(text, "yaw"), "Turned left is negative, unlike in ROS")) << axis;
    EXPECT_TRUE(contains(line_of(text, "d_lf"), std::string(left_front) + " in base to the left wall")) << axis;
  }
}

// Whatever verb reads them: who runs first and checks later has steered by then.
TEST(CheckConfig, DegreesInAKeyOfRadiansAreDoubted) {
  const auto told_of = [](const char* verb, const std::string& value) {
    return command({verb, "-s", "extrinsic_roll=" + value, "nowhere.pcd"}).errors;
  };
  for (const char* value : {"5", "1.5"}) {
    EXPECT_TRUE(contains(command({"check-config", "-s", std::string("extrinsic_roll=") + value}).errors,
                         "warning: extrinsic_roll is in radians"));
    for (const char* verb : {"run", "doctor"}) {
      EXPECT_TRUE(contains(told_of(verb, value), "warning: extrinsic_roll is in radians")) << verb;
    }
  }
  EXPECT_TRUE(contains(told_of("run", "5"), "For 5 deg write 0.0873"));
  for (const char* value : {"0.1", "3.14159265", "1.5708"}) {
    EXPECT_FALSE(contains(told_of("run", value), "warning:")) << value;
  }
}

TEST(CheckConfig, AnUnknownKeyIsAnsweredWithItsUnit) {
  const std::string roll = command({"check-config", "-s", "extrinsic_roll_deg=5"}).errors;
  EXPECT_TRUE(contains(roll, "did you mean 'extrinsic_roll'? (in radians: write 0.0873 for 5 deg)")) << roll;
  const std::string yaw = command({"check-config", "-s", "yaw_max=30"}).errors;
  EXPECT_TRUE(contains(yaw, "did you mean 'yaw_max_deg'?")) << yaw;
}

TEST(CheckConfig, NoLineIsWiderThanATerminal) {
  for (const char* language : {"en", "zh"}) {
    for (const char* option : {"--set=motion=on", "--keys"}) {
      const std::string text = command({"check-config", "--language", language, option}).printed;
      choose_language(Language::kEnglish);
      EXPECT_GT(text.size(), 2000U);
      std::istringstream lines(text);
      for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(shown_width(line), 120U) << language << " " << option << ": " << line;
      }
    }
  }
}

TEST(CheckConfig, EveryKeyHasItsMeaningInChinese) {
  choose_language(Language::kChinese);
  for (const pose_wall_key_info& key : config_keys()) EXPECT_STRNE(tr(key.help), key.help) << key.name;
  for (const OutsideKey& key : motion_keys()) EXPECT_STRNE(tr(key.help), key.help) << key.name;
  for (const OutsideKey& key : live_keys()) EXPECT_STRNE(tr(key.help), key.help) << key.name;
  for (const OutsideKey& key : planar_keys()) EXPECT_STRNE(tr(key.help), key.help) << key.name;
  choose_language(Language::kEnglish);
}

}  // namespace
}  // namespace pose_wall::tools
