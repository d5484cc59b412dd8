// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: check-config tells of mounts with which the stop never lets the machine go, for each axis ahead, and that
// what it says would help does help. That other mounts drive on real roads it does not prove.

#include "lab/drive/stop_prospect.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/language/language.hpp"
#include "ran_command.hpp"

namespace pose_wall::tools {
namespace {

using test::command;
using test::contains;

using Words = std::vector<std::string>;

std::string prospect_with(const Words& settings) {
  Words all = {"planar=map", "planar_motion=measured", "motion=on", "range_max=100"};
  all.insert(all.end(), settings.begin(), settings.end());
  return stop_prospect_text(load_config("", all));
}

const Words kLevel = {"sensor=vlp16", "extrinsic_x=2", "extrinsic_z=1.35"};

Words with(Words settings, const std::string& more) {
  settings.push_back(more);
  return settings;
}

// A level VLP-16 sees no floor near the machine.
TEST(StopProspect, TellsAMountThatNeverDrivesAndWhatHelps) {
  const std::string text = prospect_with(kLevel);
  EXPECT_TRUE(contains(text, "never permits driving")) << text;
  EXPECT_TRUE(contains(text, "There it would drive with: the sensor 10 deg further nose down.")) << text;
  EXPECT_EQ(prospect_with(with(kLevel, "extrinsic_pitch=0.1745")), "");
}

TEST(StopProspect, HoldsForEachAxisAhead) {
  const struct {
    const char *axis, *x, *y, *box_x, *box_y, *tilt;
  } cases[] = {{"-X", "-2", "0", "2.25", "0.6", "extrinsic_pitch=-0.1745"},
               {"+Y", "0", "2", "0.6", "2.25", "extrinsic_roll=-0.1745"},
               {"-Y", "0", "-2", "0.6", "2.25", "extrinsic_roll=0.1745"}};
  for (const auto& c : cases) {
    const auto key = [](const char* name, const char* sign, const char* value) {
      return std::string(name) + "=" + sign + value;
    };
    const Words level = {"sensor=vlp16",
                         "extrinsic_z=1.35",
                         key("forward_axis", "", c.axis),
                         key("extrinsic_x", "", c.x),
                         key("extrinsic_y", "", c.y),
                         key("planar_x_min", "-", c.box_x),
                         key("planar_x_max", "", c.box_x),
                         key("planar_y_min", "-", c.box_y),
                         key("planar_y_max", "", c.box_y)};
    EXPECT_TRUE(contains(prospect_with(level), "10 deg further nose down")) << c.axis;
    EXPECT_EQ(prospect_with(with(level, c.tilt)), "") << c.axis;
  }
}

// The roof hides the floor from a sensor in its middle; the same sensor without a body sees it.
TEST(StopProspect, HeedsTheMachinesBody) {
  const Words middle = {"sensor=robosense_helios32", "extrinsic_z=1.35"};
  EXPECT_EQ(prospect_with(middle), "");
  const std::string shaded = prospect_with(with(middle, "body_box_1=-2.25 2.25 -0.6 0.6 0 1.2"));
  EXPECT_TRUE(contains(shaded, "never permits driving")) << shaded;
  EXPECT_TRUE(contains(shaded, "0.25 m behind the machine's front edge")) << shaded;
}

// With assumed motion the machine may turn at once, so its tail has to be seen.
TEST(StopProspect, TellsThatMotionMustBeKnown) {
  const std::string text = prospect_with(with(with(kLevel, "extrinsic_pitch=0.1745"), "planar_motion=assumed"));
  EXPECT_TRUE(contains(text, "There it would drive with: a motion that is known instead of assumed")) << text;
}

TEST(StopProspect, IsSilentWithoutAStopOrAKnownSensor) {
  EXPECT_EQ(prospect_with(with(kLevel, "planar=off")), "");
  EXPECT_EQ(prospect_with({"sensor=auto"}), "");
  EXPECT_EQ(prospect_with({"sensor=ouster"}), "");
  EXPECT_EQ(prospect_with({"sensor=robosense_m1"}), "");
}

TEST(StopProspect, CheckConfigPrintsItInBothLanguages) {
  const Words words = {"check-config",           "-s", "planar=map",       "-s",
                       "sensor=vlp16",           "-s", "motion=on",        "-s",
                       "planar_motion=measured", "-s", "extrinsic_z=1.35", "-s",
                       "extrinsic_x=2"};  // at the front, where its rays come low 3.8 m ahead
  const std::string english = command(words).printed;
  EXPECT_TRUE(contains(english, "never permits driving")) << english;
  Words chinese_words = words;
  chinese_words.insert(chinese_words.begin() + 1, {"--language", "zh"});
  const std::string chinese = command(chinese_words).printed;
  choose_language(Language::kEnglish);
  EXPECT_TRUE(contains(chinese, "永远不会允许行驶")) << chinese;
  EXPECT_FALSE(contains(chinese, "nose down")) << chinese;
}

}  // namespace
}  // namespace pose_wall::tools
