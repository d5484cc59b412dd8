// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: --config takes the name of a config that comes with pose_wall. A file of that name wins, and a line says so.
// Of several configs the later one wins. A mistyped name is answered with the one that was meant and the list.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "config_file/config_place.hpp"
#include "config_file/load_config.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using test::command;
using test::contains;
using test::TempFolder;

// Works in a folder of its own, with configs that only the variable names.
class ConfigPlaceTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder.write("shipped/vlp16.yaml", "forward_axis: +X\nrange_noise: 0.015\n");
    folder.write("shipped/mine.yaml", "range_max: 17\n");
    std::filesystem::create_directories(folder.file("here"));
    std::filesystem::current_path(folder.file("here"));
    setenv("POSE_WALL_CONFIG_DIR", folder.file("shipped").c_str(), 1);
  }
  void TearDown() override {
    std::filesystem::current_path(before);
    unsetenv("POSE_WALL_CONFIG_DIR");
  }
  const TempFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
};

TEST_F(ConfigPlaceTest, ANameIsFoundWithAndWithoutItsEnding) {
  for (const char* word : {"mine", "mine.yaml"}) {
    const ConfigPlace place = find_config(word);
    EXPECT_EQ(place.file, folder.file("shipped/mine.yaml")) << word;
    EXPECT_EQ(place.note + place.error, "") << word;
  }
  EXPECT_EQ(load_config("mine", {}).config.number("range_max"), 17.0);
  EXPECT_EQ(load_config("mine", {}).origin("range_max"), folder.file("shipped/mine.yaml") + ":1");
  EXPECT_EQ(find_config("").file, "");
}

TEST_F(ConfigPlaceTest, AFileOfThisFolderWinsAndALineSaysSo) {
  folder.write("here/mine.yaml", "range_max: 9\n");
  const LoadedConfig loaded = load_config("mine", {});
  EXPECT_EQ(loaded.config.number("range_max"), 9.0);
  EXPECT_EQ(loaded.notes, "--config: mine.yaml of this folder is taken, not " + folder.file("shipped/mine.yaml"));
  folder.write("here/own.yaml", "range_max: 8\n");
  EXPECT_EQ(load_config("own.yaml", {}).notes, "") << "nothing else is called so";
  folder.write("a.bin", "");
  EXPECT_TRUE(contains(command({"run", "-c", "mine", folder.file("a.bin")}).errors, "of this folder is taken"));
  EXPECT_FALSE(contains(command({"run", "-q", "-c", "mine", folder.file("a.bin")}).errors, "of this folder is taken"));
}

TEST_F(ConfigPlaceTest, SeveralStandOverEachOtherInTheirOrder) {
  folder.write("here/own.yaml", "range_max: 8\nrange_min: 0.4\n");
  const auto range_max = [](const char* words) { return load_config(words, {}).config.number("range_max"); };
  EXPECT_EQ(range_max("mine,own"), 8.0);
  EXPECT_EQ(range_max("own,mine"), 17.0);
  const LoadedConfig both = load_config("own,mine", {"range_min=0.5"});
  EXPECT_EQ(both.origin("range_max"), folder.file("shipped/mine.yaml") + ":1");
  EXPECT_EQ(both.origin("range_min"), "--set");
  EXPECT_EQ(both.file, "own.yaml," + folder.file("shipped/mine.yaml"));
  folder.write("here/a,b.yaml", "range_max: 6\n");
  EXPECT_EQ(range_max("a,b.yaml"), 6.0) << "a name with a comma";
  for (const char* words : {"mine,", ",mine", "mine,,own", "mine,nothing"}) {
    EXPECT_THROW(load_config(words, {}), ConfigError) << words;
  }
}

TEST_F(ConfigPlaceTest, AMistypedNameIsAnsweredWithTheListAndAPathIsNoName) {
  const auto refusal = [](const char* word) {
    try {
      load_config(word, {});
      return std::string();
    } catch (const ConfigError& error) {
      return std::string(error.what());
    }
  };
  EXPECT_TRUE(contains(refusal("vpl16"), "did you mean 'vlp16'?")) << refusal("vpl16");
  EXPECT_TRUE(contains(refusal("vpl16"), "Configs that are found by name: ")) << refusal("vpl16");
  EXPECT_TRUE(contains(refusal("config/mine.yaml"), "no such file; did you mean 'mine'?"))
      << refusal("config/mine.yaml");
  EXPECT_FALSE(contains(refusal("quite_another_thing"), "did you mean")) << refusal("quite_another_thing");
}

// The tests' program lies in the build folder of the source tree, as the command does.
TEST(ConfigPlace, ThoseOfTheSourceTreeAreFoundFromItsBuild) {
  const std::vector<std::string> names = config_names();
  for (const char* name : {"vlp16", "os1-64", "mid360", "pose_wall", "hand_held"}) {
    EXPECT_NE(std::find(names.begin(), names.end(), name), names.end()) << name;
  }
}

}  // namespace
}  // namespace pose_wall::tools
