// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a value may steer if it is valid and not otherwise, and what may not has one cause, by its reasons and by the
// largest part of its level. Every cause has a name that no other has, words in both languages, and a remedy where
// there is one. The line tells values with one cause together, of a frame and of a recording.

#include "study/steer/steering.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "crafted_value.hpp"
#include "io/numbers/angles.hpp"
#include "pose_wall.hpp"
#include "study/results/steer_tally.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
const AlertLimits kLimits = {1.0 * kRadPerDeg, 0.1};

pose_wall_value valid() {
  return crafted_value(POSE_WALL_VALID, 0.01, 0.01, {0.005, 0, 0, 0, 0, 0, 0});
}

// Measured, and its level of this part is beyond the limit.
pose_wall_value beyond(std::uint32_t part, double level, std::uint32_t reasons = 0) {
  Parts parts{};
  parts[part] = level;
  pose_wall_value value = crafted_value(POSE_WALL_DEGRADED, 0.5, 0.5, parts);
  value.reasons = reasons | POSE_WALL_R_ALERT_LIMIT;
  return value;
}

pose_wall_value unmeasured(std::uint32_t reasons, std::uint32_t state = POSE_WALL_INVALID) {
  pose_wall_value value = unmeasured_value();
  value.state = state;
  value.reasons = reasons;
  return value;
}

pose_wall_result all_valid() {
  pose_wall_result result = api::make_result();
  for (pose_wall_value& value : result.quantity) value = valid();
  return result;
}

std::string english(const pose_wall_result& result) {
  return steer_line(Language::kEnglish, steering_of(result, kLimits));
}

std::string cause_of(const pose_wall_value& value) {
  return steer_cause_name(steer_cause(value));
}

TEST(Steering, ValidValuesMaySteerAndNoOthers) {
  EXPECT_EQ(steer_cause(valid()), kMaySteer);
  for (const std::uint32_t state : {POSE_WALL_INVALID, POSE_WALL_HELD, POSE_WALL_DEGRADED}) {
    pose_wall_value value = valid();
    value.state = state;
    value.reasons = POSE_WALL_R_ALERT_LIMIT;
    EXPECT_LT(steer_cause(value), kSteerCauses) << state;
    value.reasons = 0;
    EXPECT_LT(steer_cause(value), kSteerCauses) << "whatever the engine forgot to say: " << state;
  }
  EXPECT_EQ(cause_of(pose_wall_value{}), "never_measured") << "before the first frame";
}

TEST(Steering, EachReasonOfAnUnmeasuredValueIsItsCause) {
  for (std::uint32_t bit = 0; bit < POSE_WALL_REASON_COUNT; ++bit) {
    EXPECT_EQ(cause_of(unmeasured(1U << bit)), pose_wall_reason_name(bit));
    EXPECT_EQ(cause_of(unmeasured(1U << bit, POSE_WALL_HELD)), pose_wall_reason_name(bit));
  }
}

TEST(Steering, WhatSaysMoreIsTheCause) {
  const std::uint32_t little = POSE_WALL_R_HOLD_EXPIRED | POSE_WALL_R_NEVER_MEASURED | POSE_WALL_R_ALERT_LIMIT;
  EXPECT_EQ(cause_of(unmeasured(little | POSE_WALL_R_WALL_NOT_FOUND)), "wall_not_found");
  EXPECT_EQ(cause_of(unmeasured(POSE_WALL_R_WALL_NOT_FOUND | POSE_WALL_R_WALL_SHORT)), "wall_short");
  EXPECT_EQ(cause_of(unmeasured(POSE_WALL_R_WALL_NOT_FOUND | POSE_WALL_R_WALL_TOO_NEAR)), "wall_too_near");
  EXPECT_EQ(cause_of(unmeasured(POSE_WALL_R_FLOOR_NOT_FOUND | POSE_WALL_R_FLOOR_THIN)), "floor_thin");
  EXPECT_EQ(cause_of(unmeasured(POSE_WALL_R_NO_FRAME | POSE_WALL_R_WALL_SHORT, POSE_WALL_HELD)), "no_frame");
}

TEST(Steering, EachPartOfALevelBeyondItsLimitIsACause) {
  for (std::uint32_t part = 0; part < POSE_WALL_PARTS; ++part) {
    EXPECT_EQ(cause_of(beyond(part, 0.2)), pose_wall_part_name(part));
  }
  EXPECT_EQ(cause_of(beyond(POSE_WALL_PART_EXTRAPOLATION, 0.2, POSE_WALL_R_EXTRAPOLATED)), "extrapolated");
  EXPECT_EQ(cause_of(beyond(POSE_WALL_PART_RIVAL, 0.2, POSE_WALL_R_WALL_SEEN_THROUGH)), "wall_seen_through");
  EXPECT_EQ(cause_of(beyond(POSE_WALL_PART_RANDOM, 0.2, POSE_WALL_R_WALL_SEEN_THROUGH)), "random")
      << "a doubt that widens another part is not the cause";
}

TEST(Steering, ADoubtWithinTheLimitIsACause) {
  pose_wall_value value = valid();
  value.state = POSE_WALL_DEGRADED;
  value.reasons = POSE_WALL_R_WALL_AMBIGUOUS | POSE_WALL_R_INNOVATION;
  EXPECT_EQ(cause_of(value), "innovation") << "the rival stands in the level, which is within its limit";
  value.reasons = POSE_WALL_R_FROZEN;
  EXPECT_EQ(cause_of(value), "frozen");
}

TEST(Steering, EachCauseHasItsNameAndWords) {
  std::set<std::string> names;
  for (std::uint32_t cause = 0; cause < kSteerCauses; ++cause) {
    names.insert(steer_cause_name(cause));
    const std::string words = steer_cause_words(Language::kEnglish, cause);
    EXPECT_FALSE(words.empty());
    EXPECT_LE(std::count(words.begin(), words.end(), ' '), 9) << "short enough for a tile: " << words;
    EXPECT_NE(steer_cause_words(Language::kChinese, cause), words);
    const std::string help = steer_remedy(Language::kEnglish, cause);
    EXPECT_EQ(help.find_first_of("{}"), std::string::npos) << "a figure of a frame is missing: " << help;
    EXPECT_EQ(help.empty(), steer_remedy(Language::kChinese, cause).empty()) << help;
    EXPECT_TRUE(help.empty() || steer_remedy(Language::kChinese, cause) != help) << help;
  }
  EXPECT_EQ(names.size(), kSteerCauses);
  EXPECT_TRUE(contains(steer_remedy(Language::kEnglish, 12), "wall_length_min")) << "the key stands in it";
}

TEST(SteerLine, OfAllSomeAndNone) {
  pose_wall_result result = all_valid();
  EXPECT_EQ(english(result), "may steer: roll, pitch, yaw, d_lf, d_lb, d_rf, d_rb.");
  result.quantity[POSE_WALL_D_LF] = beyond(POSE_WALL_PART_EXTRAPOLATION, 0.14, POSE_WALL_R_EXTRAPOLATED);
  EXPECT_EQ(
      english(result),
      "may steer: roll, pitch, yaw, d_lb, d_rf, d_rb; may not: d_lf (level 0.140 m, limit 0.100 m: the wall is "
      "unseen beside the machine). To look at: mount the sensor where nothing hides the wall at the sampling point, "
      "or set s_front and s_back to where it is seen.");
  EXPECT_EQ(steer_line(Language::kChinese, steering_of(result, kLimits)),
            "可用于控制：横滚、俯仰、航向、左后、右前、右后；不可用：左前（保护级 0.140 m，限值 0.100 "
            "m：机器旁的巷帮不可见）。"
            "处理：改变传感器安装位置以免采样点处的巷帮被遮挡，或把 s_front 和 s_back "
            "设到能看到巷帮之处。");
  for (pose_wall_value& value : result.quantity) value = unmeasured(POSE_WALL_R_NO_FRAME, POSE_WALL_HELD);
  EXPECT_EQ(english(result),
            "may steer: none; may not: roll, pitch, yaw, d_lf, d_lb, d_rf, d_rb (not measured: no frame has come "
            "since). To look at: look after the sensor, its power and its cable.");
}

TEST(SteerLine, TellsWhatIsAlikeTogetherAndARemedyOnce) {
  pose_wall_result result = all_valid();
  result.quantity[POSE_WALL_YAW] = beyond(POSE_WALL_PART_RIVAL, 2.0 * kRadPerDeg, POSE_WALL_R_WALL_AMBIGUOUS);
  result.quantity[POSE_WALL_D_LF] = beyond(POSE_WALL_PART_RIVAL, 0.2, POSE_WALL_R_WALL_AMBIGUOUS);
  result.quantity[POSE_WALL_D_LB] = beyond(POSE_WALL_PART_RIVAL, 0.3, POSE_WALL_R_WALL_AMBIGUOUS);
  EXPECT_EQ(english(result),
            "may steer: roll, pitch, d_rf, d_rb; may not: yaw (level 2.000°, limit 1.000°: another surface may be the "
            "wall); d_lf, d_lb (level 0.200 m, 0.300 m, limit 0.100 m: another surface may be the wall). To look at: "
            "clear the view to the surface, or show more of it.");
}

TEST(SteerLine, ALevelThatPromisesNothingHasNoFigure) {
  pose_wall_result result = all_valid();
  for (const double level : {1.1, 1e9, std::numeric_limits<double>::infinity()}) {
    result.quantity[POSE_WALL_D_LF] = beyond(POSE_WALL_PART_RANDOM, level);
    EXPECT_TRUE(contains(english(result), "d_lf (level > 1 m, limit 0.100 m: ")) << english(result);
  }
  result.quantity[POSE_WALL_D_LF].protection_level = kNaN;
  EXPECT_TRUE(contains(english(result), "d_lf (no bound: ")) << english(result);
}

TEST(SteerJson, HoldsCauseAndRemedyOfWhatMayNot) {
  pose_wall_result result = all_valid();
  result.quantity[POSE_WALL_D_LF] = beyond(POSE_WALL_PART_EXTRAPOLATION, 0.14, POSE_WALL_R_EXTRAPOLATED);
  result.quantity[POSE_WALL_YAW] = unmeasured(POSE_WALL_R_NEVER_MEASURED);
  const Json list = steer_json(steering_of(result, kLimits));
  ASSERT_EQ(list.size(), 7U);
  EXPECT_EQ(list.at(0).at("value"), "roll");
  EXPECT_EQ(list.at(0).at("may_steer"), true);
  EXPECT_TRUE(list.at(0).at("cause").is_null() && list.at(0).at("remedy").is_null());
  EXPECT_EQ(list.at(2).at("measured"), false);
  EXPECT_TRUE(list.at(2).at("level_rad").is_null() && list.at(2).at("remedy").is_null());
  EXPECT_NEAR(list.at(2).at("limit_rad"), 0.01745, 1e-5);
  EXPECT_EQ(list.at(3).at("may_steer"), false);
  EXPECT_EQ(list.at(3).at("cause"), "extrapolated");
  EXPECT_EQ(list.at(3).at("level_m"), 0.14);
  const std::string english = list.at(3).at("remedy").at("en"), chinese = list.at(3).at("remedy").at("zh");
  EXPECT_EQ(english.find("mount the sensor where nothing hides the wall at the sampling point"), 0U) << english;
  EXPECT_EQ(chinese.find("改变传感器安装位置"), 0U) << chinese;
}

TEST(SteerTally, TellsARecordingByItsMostFrequentCause) {
  SteerTally tally;
  pose_wall_result result = all_valid();
  for (int frame = 0; frame < 20; ++frame) {
    result.quantity[POSE_WALL_ROLL] = frame == 0 ? beyond(POSE_WALL_PART_AGE, 0.1) : valid();
    result.quantity[POSE_WALL_D_LF] = frame < 5   ? valid()
                                      : frame < 8 ? unmeasured(POSE_WALL_R_WALL_SHORT)
                                                  : beyond(POSE_WALL_PART_BEND, 0.01 * frame);
    result.quantity[POSE_WALL_D_RF] = unmeasured(POSE_WALL_R_WALL_SHORT);
    result.quantity[POSE_WALL_D_RB] = unmeasured(POSE_WALL_R_WALL_SHORT);
    tally.add(steering_of(result, kLimits));
  }
  const std::string line = steer_line(Language::kEnglish, tally.steering());
  EXPECT_EQ(
      line.find("may steer: roll, pitch, yaw, d_lb; may not: d_lf (valid in 25 % of the frames, else mostly level "
                "0.140 m, limit 0.100 m: the surface is no plane); d_rf, d_rb (valid in 0 % of the frames, else "
                "mostly not measured: too little of the wall is seen along the road). To look at: "),
      0U)
      << line;
}

}  // namespace
}  // namespace pose_wall::tools
