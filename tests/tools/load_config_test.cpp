// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every fault of a config file is named with file, line, key, value and what is allowed, all in one go; values
// reach the engine as they are written; origins are kept.

#include "io/config_file/load_config.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include "io/config_file/key_table.hpp"
#include "io/config_file/resolved_frames.hpp"
#include "io/config_file/yaml_entries.hpp"
#include "support/said_by.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using test::contains;
using test::TempFolder;
using Settings = std::vector<std::string>;

std::string refusal_of(const std::string& file, const Settings& settings) {
  return test::said_by<ConfigError>([&] { load_config(file, settings); });
}

std::string refusal_of_text(const std::string& yaml, const Settings& settings = {}) {
  const TempFolder folder;
  return refusal_of(folder.write("c.yaml", yaml), settings);
}

TEST(LoadConfig, PlusSignsAndListsReachTheEngineAsText) {
  const TempFolder folder;
  const std::string file = folder.write("c.yaml",
                                        "# comment\nforward_axis: +Y   # ahead\ns_front: +2.5\n"
                                        "body_box_1: [-1, 1.5, -1, 1, -1, 1]\nbody_box_2:\nlidar_frame: 'os 0'\n");
  const LoadedConfig loaded = load_config(file, {"s_back=-3", "range_max=12.5"});
  const auto text = [&loaded](const char* key) {
    return config_value_text(*loaded.config.get(), *find_config_key(key));
  };
  EXPECT_EQ(text("forward_axis"), "+Y");
  EXPECT_EQ(text("s_front"), "2.5");
  EXPECT_EQ(text("s_back"), "-3");
  EXPECT_EQ(text("body_box_1"), "-1 1.5 -1 1 -1 1");
  EXPECT_EQ(text("body_box_2"), "");
  EXPECT_EQ(text("lidar_frame"), "os 0");
  EXPECT_EQ(loaded.origin("s_front"), file + ":3");
  EXPECT_EQ(loaded.origin("s_back"), "--set");
  EXPECT_EQ(loaded.origin("voxel_leaf"), "default");
}

TEST(LoadConfig, WhatCheckConfigPrintsIsTakenAgain) {
  const TempFolder folder;
  std::vector<std::string> settings = {"body_box_1=-1 1.5 -1 1 -1 1"};
  const LoadedConfig loaded = load_config("", settings);
  std::string file;
  for (const pose_wall_key_info& key : config_keys()) {
    const std::string value = config_written_text(*loaded.config.get(), key);
    EXPECT_FALSE(value.empty()) << key.name;
    file += std::string(key.name) + ": " + value + "\n";
    settings.push_back(std::string(key.name) + "=" + value);
  }
  EXPECT_NE(file.find("body_box_2: []\n"), std::string::npos);
  for (const LoadedConfig& again : {load_config(folder.write("c.yaml", file), {}), load_config("", settings)}) {
    EXPECT_EQ(std::memcmp(again.config.get(), loaded.config.get(), sizeof(pose_wall_config)), 0);
  }
}

TEST(LoadConfig, EmptyFilesAndNoFileGiveTheDefaults) {
  EXPECT_EQ(refusal_of_text(""), "");
  EXPECT_EQ(refusal_of_text("# nothing but a comment\n"), "");
  EXPECT_EQ(refusal_of("", {}), "");
}

TEST(LoadConfig, EveryFaultIsNamedAtOnce) {
  const std::string message = refusal_of_text(
      "voxel_leef: 0.05\nrange_min: 50\nrange_max: [1, 2]\nforward_axis: +Z\nrange_min: 0.3\nsome_word: 1\n",
      {"points_max=7.5", "nonsense", "=3", "voxle_leaf=1"});
  for (const char* part :
       {"c.yaml:1: unknown key 'voxel_leef'; did you mean 'voxel_leaf'?", "c.yaml:2: range_min: '50' is refused",
        "allowed: a number from 0.05 to 10 m", "c.yaml:3: range_max: a list is not allowed here",
        "c.yaml:4: forward_axis: '+Z' is refused", "allowed: one of +X, -X, +Y, -Y",
        "c.yaml:5: range_min: set a second time; the first is at line 2", "c.yaml:6: unknown key 'some_word'\n",
        "--set: points_max: '7.5' is refused", "--set nonsense: KEY=VALUE is expected",
        "--set =3: KEY=VALUE is expected", "--set: unknown key 'voxle_leaf'; did you mean 'voxel_leaf'?"}) {
    EXPECT_TRUE(contains(message, part)) << part << "\nin\n" << message;
  }
}

TEST(LoadConfig, AnOldFactorIsSentToTheRiskThatItWas) {
  const std::string message = refusal_of_text("range_min: 0.5\nprotection_factor: 5.0\n", {"protection_factor=4"});
  EXPECT_TRUE(contains(message,
                       "c.yaml:2: unknown key 'protection_factor'; integrity_risk replaced it: leave it out, or write "
                       "integrity_risk: 5.73e-07\n"))
      << message;
  EXPECT_TRUE(contains(message, "or write integrity_risk: 6.33e-05")) << message;
  EXPECT_TRUE(contains(refusal_of_text("protection_factor: 9\n"), "write integrity_risk: 1e-09")) << "as allowed";
  EXPECT_EQ(refusal_of_text("integrity_risk: 5.73e-07\n"), "");
  for (const char* risk : {"0", "1", "nan", "5.0"}) {
    const std::string refusal = refusal_of_text(std::string("integrity_risk: ") + risk + "\n");
    EXPECT_TRUE(contains(refusal, "integrity_risk: '") && contains(refusal, "allowed: a number from 1e-09 to 0.01"))
        << refusal;
  }
}

TEST(LoadConfig, BrokenRulesNameTheLinesOfBothKeys) {
  const std::string message = refusal_of_text("voxel_leaf: 0.1\nrange_min: 5\n", {"range_max=4"});
  EXPECT_TRUE(contains(message, "c.yaml:2)")) << message;
  EXPECT_TRUE(contains(message, "range_max (--set)")) << message;
}

TEST(LoadConfig, AnUpsideDownSensorIsSentToTheExtrinsic) {
  const std::string message = refusal_of_text("z_axis: -Z\n");
  EXPECT_TRUE(contains(message, "only +Z") && contains(message, "extrinsic_roll")) << message;
}

TEST(LoadConfig, FilesThatAreNoConfig) {
  const std::pair<const char*, const char*> cases[] = {
      {"a: [1\n", "c.yaml:2: not YAML"},        {"- 1\n- 2\n", "'key: value'"},
      {"just words\n", "'key: value'"},         {"a:\n  b: 3\n", "c.yaml:2: a: one value is expected"},
      {"a: [[1]]\n", "nothing nested"},         {"a: &x 1\nb: *x\n", "aliases"},
      {"a: 1\n---\nb: 2\n", "second document"}, {"[1, 2]: 3\n", "a key is expected"},
      {"a: \"x\\0y\"\n", "zero byte"},          {"\x01\x02\x03", "not YAML"},
  };
  for (const auto& [yaml, part] : cases) {
    const std::string message = refusal_of_text(yaml);
    EXPECT_TRUE(contains(message, part)) << yaml << " | " << message;
  }
  const TempFolder folder;
  EXPECT_TRUE(contains(refusal_of(folder.file("missing.yaml"), {}), "no such file"));
  EXPECT_TRUE(contains(refusal_of(folder.path(), {}), "this is a folder"));
  EXPECT_TRUE(contains(refusal_of(folder.write("big.yaml", std::string(2000000, '#')), {}), "at most"));
}

// As a shell's <(...) gives it.
TEST(LoadConfig, APipeIsReadLikeAFile) {
  const auto piped = [](const std::string& yaml) {
    std::array<int, 2> ends{};
    EXPECT_EQ(pipe(ends.data()), 0);
    EXPECT_EQ(write(ends[1], yaml.data(), yaml.size()), static_cast<ssize_t>(yaml.size()));
    close(ends[1]);
    const std::string refusal = refusal_of("/dev/fd/" + std::to_string(ends[0]), {});
    close(ends[0]);
    return refusal;
  };
  EXPECT_EQ(piped("range_min: 0.5\n"), "");
  EXPECT_TRUE(contains(piped("range_min: 50\n"), ":1: range_min: '50' is refused"));
  EXPECT_EQ(refusal_of("/dev/null", {}), "");
  EXPECT_TRUE(contains(refusal_of("/dev/zero", {}), "at most 1048576 bytes; this has more"));
  EXPECT_TRUE(contains(refusal_of("-", {}), "standard input is /dev/stdin"));
}

TEST(ResolvedFrames, LeftIsUpCrossForwardForAllFourAxes) {
  struct Case {
    const char* axis;
    Vector3 forward, left;
  };
  for (const Case& c : {Case{"+X", {1, 0, 0}, {0, 1, 0}}, Case{"-X", {-1, 0, 0}, {0, -1, 0}},
                        Case{"+Y", {0, 1, 0}, {-1, 0, 0}}, Case{"-Y", {0, -1, 0}, {1, 0, 0}}}) {
    api::Config config;
    ASSERT_EQ(config.set("forward_axis", c.axis), POSE_WALL_OK);
    ASSERT_EQ(config.set("lateral_offset_left", 0.5), POSE_WALL_OK);
    const ResolvedFrames frames = resolve_frames(config);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(frames.forward_base[i], c.forward[i]);
      EXPECT_EQ(frames.left_base[i], c.left[i]);
      EXPECT_EQ(frames.sampling_points_base_m[0][i], 2.0 * c.forward[i] + 0.5 * c.left[i]);
      EXPECT_EQ(frames.sampling_points_base_m[3][i], -2.0 * c.forward[i]);
    }
  }
}

}  // namespace
}  // namespace pose_wall::tools
