// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the keys of motion are read from file and --set into the library's units, their ranges are the library's,
// what is wrong is told with what was meant, and commands that run the engine only take them, too.

#include "io/config_file/motion_settings.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "io/config_file/load_config.hpp"
#include "ran_command.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

TEST(MotionSettings, ReachTheLibraryInItsUnits) {
  const TempFolder folder;
  const std::string file = folder.write("c.yaml", "motion_speed_max: 3.5\nmotion_turn_max_deg: 90\n");
  const LoadedConfig loaded = load_config(file, {"motion_range_max=20", "motion_keyframe=0.1"});
  EXPECT_EQ(loaded.motion.speed_max_m_s, 3.5);
  EXPECT_DOUBLE_EQ(loaded.motion.turn_max_rad_s, 1.5707963267948966);
  EXPECT_EQ(loaded.motion.range_max_m, 20.0);
  EXPECT_EQ(loaded.motion.keyframe_m, 0.1);
  EXPECT_EQ(loaded.origin("motion_turn_max_deg"), file + ":2");
  EXPECT_EQ(loaded.origin("motion_keyframe"), "--set");
}

TEST(MotionSettings, WithoutKeysTheyAreTheLibrarysBitForBit) {
  pose_wall_motion_settings defaults{};
  ASSERT_EQ(pose_wall_motion_settings_init(&defaults), POSE_WALL_OK);
  const LoadedConfig loaded = load_config("", {});
  EXPECT_EQ(std::memcmp(&loaded.motion, &defaults, sizeof defaults), 0);
}

// A key that the table lets through must not be refused later, without file and line.
TEST(MotionSettings, BothEndsOfEachRangeAreTakenByTheLibrary) {
  ASSERT_EQ(motion_keys().size(), 4U);
  for (const OutsideKey& key : motion_keys()) {
    for (const double end : {key.minimum, key.maximum}) {
      pose_wall_motion_settings settings = default_motion_settings();
      ASSERT_TRUE(set_motion_value(&settings, key, std::to_string(end))) << key.name;
      EXPECT_EQ(pose_wall_motion_settings_check(&settings, nullptr), POSE_WALL_OK) << key.name << " " << end;
    }
    for (const double beyond : {0.99 * key.minimum, 1.01 * key.maximum}) {
      pose_wall_motion_settings settings = default_motion_settings();
      EXPECT_FALSE(set_motion_value(&settings, key, std::to_string(beyond))) << key.name;
      EXPECT_EQ(motion_value_text(settings, key), motion_value_text(default_motion_settings(), key));
    }
  }
}

TEST(MotionSettings, WhatIsWrongIsToldWithWhatWasMeant) {
  const TempFolder folder;
  const std::string file = folder.write(
      "c.yaml", "motion_sped_max: 1\nmotion_range_max: 2\nmotion_keyframe: [1]\nmotion_turn_max_deg: nan\n");
  const Ran ran = command({"check-config", file, "--set", "motion_speed_max=fast"});
  EXPECT_EQ(ran.exit_status, 2);
  for (const char* part : {"c.yaml:1: unknown key 'motion_sped_max'; did you mean 'motion_speed_max'?",
                           "c.yaml:2: motion_range_max: '2' is refused; allowed: a number from 3 to 100 m",
                           "c.yaml:3: motion_keyframe: ", "c.yaml:4: motion_turn_max_deg: 'nan' is refused",
                           "--set: motion_speed_max: 'fast' is refused; allowed: a number from 0.01 to 30 m/s"}) {
    EXPECT_TRUE(contains(ran.errors, part)) << part << "\nin\n" << ran.errors;
  }
}

TEST(MotionSettings, CheckConfigShowsThemWithTheirOrigin) {
  const Ran ran = command({"check-config", "--set", "motion_keyframe=0.25"});
  EXPECT_EQ(ran.exit_status, 0);
  const std::size_t line = ran.printed.find("motion_keyframe");
  ASSERT_NE(line, std::string::npos);
  const std::string row = ran.printed.substr(line, ran.printed.find('\n', line) - line);
  EXPECT_TRUE(contains(row, "0.25") && contains(row, "0.05 .. 1") && contains(row, "--set")) << row;
}

TEST(MotionSettings, CommandsOfTheEngineAloneTakeThem) {
  const TempFolder folder;
  const std::string file = folder.write("c.yaml", "motion_speed_max: 1\n");
  const std::string frame = folder.write("good.bin", std::string(16 * 50, '\0'));
  EXPECT_EQ(command({"run", "-q", "-c", file, "-o", folder.file("o.csv"), frame}).exit_status, 0);
}

}  // namespace
}  // namespace pose_wall::tools
