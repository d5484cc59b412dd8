// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: --config takes the name of a config that comes with pose_wall. A file of that name wins, and a line says so.
// Of several configs the later one wins. A mistyped name is answered with the one that was meant and the list.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "io/config_file/config_place.hpp"
#include "io/config_file/load_config.hpp"
#include "ran_command.hpp"
#include "support/said_by.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

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
  for (const char* words : {"mine, own", " mine ,own", "mine,\town "}) EXPECT_EQ(range_max(words), 8.0) << words;
  EXPECT_THROW(load_config("mine,nothing", {}), ConfigError);
  for (const std::string words : {"mine,", ",mine", "mine,,own", "mine, ,own", " "}) {
    EXPECT_EQ(test::said_by<ConfigError>([&] { load_config(words, {}); }),
              "'" + words +
                  "': a config is missing beside a comma; allowed: names and files with one comma between, "
                  "as vlp16,hand_held");
  }
}

TEST_F(ConfigPlaceTest, ALaterFileSaysWhatItChangesAndOnlyThat) {
  folder.write("here/own.yaml", "# mine\nforward_axis: -Y\nrange_noise: 0.0150\nrange_min: 0.4\n");
  const std::string changed =
      "own.yaml:2: forward_axis: '-Y' instead of '+X' (" + folder.file("shipped/vlp16.yaml") + ":1)";
  EXPECT_EQ(load_config("vlp16,own", {"range_min=0.5"}).notes, changed)
      << "the same number, a key of one file and --set are no surprise";
  EXPECT_EQ(load_config("own", {}).notes, "");
  folder.write("here/last.yaml", "forward_axis: +Y\nplanar_cell: 0.1\n");
  EXPECT_EQ(load_config("vlp16,own,last", {}).notes,
            changed + "\nlast.yaml:1: forward_axis: '+Y' instead of '-Y' (own.yaml:2)");
  folder.write("here/more.yaml", "planar_cell: 0.2\n");
  EXPECT_EQ(load_config("last,more", {}).notes, "more.yaml:1: planar_cell: '0.2' instead of '0.1' (last.yaml:2)");
  const test::Ran shown = command({"check-config", "vlp16,own"});
  EXPECT_EQ(shown.errors, changed + "\n");
  EXPECT_FALSE(contains(shown.printed, "instead of"));
}

TEST_F(ConfigPlaceTest, HelpSaysWhereNamesAreLookedFor) {
  for (const char* verb : {"run", "map", "explain", "doctor", "campaign", "eval", "demo", "check-config"}) {
    EXPECT_TRUE(contains(command({verb, "--help"}).printed, "POSE_WALL_CONFIG_DIR")) << verb;
  }
}

TEST_F(ConfigPlaceTest, AMistypedNameIsAnsweredWithTheListAndAPathIsNoName) {
  const auto refusal = [](const char* word) { return test::said_by<ConfigError>([&] { load_config(word, {}); }); };
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
