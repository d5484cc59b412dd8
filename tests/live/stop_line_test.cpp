// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: every reason alone has its line in both languages, and all together have that of the first cause. Places are
// told from the machine's own ends, along forward_axis. Whatever numbers are missing, none is printed that is none.

#include "study/planar/stop_line.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "io/config_file/planar_settings.hpp"

namespace pose_wall::tools {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr Language kBoth[] = {Language::kEnglish, Language::kChinese};

// As the library begins one.
pose_wall_planar_stop_result stopped(std::uint32_t reasons) {
  pose_wall_planar_stop_result result{};
  result.struct_size = sizeof result;
  result.state = POSE_WALL_PLANAR_STOP_STOP;
  result.reasons = reasons;
  result.frames = 9;
  result.stamp_ns = 1'000'000'000;
  result.now_ns = 1'450'000'000;
  result.rim_speed_m_s = result.nearest_m[0] = result.nearest_m[1] = result.nearest_distance_m = kNone;
  result.nearest_size_m = result.nearest_age_s = kNone;
  return result;
}

pose_wall_planar_stop_result stopped_by(double x_m, double y_m, std::uint32_t height, std::uint32_t more = 0) {
  const bool is_blind = height == POSE_WALL_PLANAR_STOP_UNSEEN;
  pose_wall_planar_stop_result result =
      stopped((is_blind ? POSE_WALL_PLANAR_STOP_R_BLIND : POSE_WALL_PLANAR_STOP_R_THING) | more);
  result.nearest_m[0] = x_m, result.nearest_m[1] = y_m;
  result.nearest_height = height;
  return result;
}

// A machine of 4.5 x 1.2 m, or with ±Y as its forward axis of 1.2 x 4.5 m.
StopLine line_of(const std::string& forward_axis = "+X") {
  PlanarSettings settings;
  if (forward_axis.back() == 'Y') {
    std::swap(settings.x_min_m, settings.y_min_m), std::swap(settings.x_max_m, settings.y_max_m);
  }
  return StopLine(stop_settings_of(settings), forward_axis);
}

std::string english(const pose_wall_planar_stop_result& result, double for_s = kNone) {
  return line_of().text(Language::kEnglish, result, for_s);
}
std::string chinese(const pose_wall_planar_stop_result& result, double for_s = kNone) {
  return line_of().text(Language::kChinese, result, for_s);
}

bool is_of_numbers(const std::string& text) {
  return text.find("nan") == std::string::npos && text.find("inf") == std::string::npos &&
         text.find('{') == std::string::npos;
}

TEST(StopLine, AThingIsToldWithHeightPlaceTimeAndRemedy) {
  pose_wall_planar_stop_result result = stopped_by(4.35, 0.9, POSE_WALL_PLANAR_STOP_STANDING);
  result.nearest_size_m = 0.46;
  EXPECT_EQ(english(result, 1.24),
            "A thing higher than 0.3 m, 0.5 m across, 2.1 m ahead, 30 cm left of the track, for 1.2 s. Remove it, or "
            "steer clear of it.");
  EXPECT_EQ(
      chinese(result, 1.24),
      "底板上有高于 0.3 米的物体，宽 0.5 米，前方 2.1 米，行驶带左侧 30 厘米，已 1.2 秒。请将其移开，或绕开行驶。");
  EXPECT_NE(english(result, 345.6).find("for 346 s."), std::string::npos);
  result.nearest_age_s = 7.04;
  result.reasons |= POSE_WALL_PLANAR_STOP_R_MISSING;
  EXPECT_EQ(english(result, 1.24),
            "A thing higher than 0.3 m, 0.5 m across, 2.1 m ahead, 30 cm left of the track, for 7.0 s. Remove it, or "
            "steer clear of it. While the motion is not known, all directions count (planar_motion).");
}

TEST(StopLine, PlacesAreToldFromTheMachinesEndsAlongItsForwardAxis) {
  struct Case {
    const char* axis;
    double x_m, y_m;
    const char* place;
  };
  for (const Case& one : {Case{"+X", 3.25, -0.7, ", 1.0 m ahead, 10 cm right of the track. "},
                          {"+X", -3.25, 0.0, ", 1.0 m behind, in the track. "},
                          {"+X", 1.0, 1.6, ", beside the machine, 100 cm left of the track. "},
                          {"-X", 3.25, -0.7, ", 1.0 m behind, 10 cm left of the track. "},
                          {"-X", -3.25, -0.7, ", 1.0 m ahead, 10 cm left of the track. "},
                          {"+Y", 0.7, 3.25, ", 1.0 m ahead, 10 cm right of the track. "},
                          {"-Y", 0.7, -3.25, ", 1.0 m ahead, 10 cm left of the track. "}}) {
    const std::string text =
        line_of(one.axis).text(Language::kEnglish, stopped_by(one.x_m, one.y_m, POSE_WALL_PLANAR_STOP_UNSEEN), kNone);
    EXPECT_EQ(text.find(std::string("A place that was not seen free") + one.place), 0U) << one.axis << ": " << text;
  }
}

TEST(StopLine, EveryReasonAloneHasItsOwnLineInBothLanguages) {
  for (const Language language : kBoth) {
    std::set<std::string> lines;
    for (std::uint32_t bit = 0; bit < POSE_WALL_PLANAR_STOP_REASON_COUNT; ++bit) {
      if (1U << bit == POSE_WALL_PLANAR_STOP_R_LOW || 1U << bit == POSE_WALL_PLANAR_STOP_R_NEARING) continue;
      const std::string text = line_of().text(language, stopped(1U << bit), 1.2);
      EXPECT_NE(text, "") << bit;
      EXPECT_TRUE(is_of_numbers(text)) << text;
      EXPECT_TRUE(lines.insert(text).second) << text;
      EXPECT_NE(english(stopped(1U << bit), 1.2), chinese(stopped(1U << bit), 1.2)) << bit;
    }
    for (const std::uint32_t height : {POSE_WALL_PLANAR_STOP_LOW, POSE_WALL_PLANAR_STOP_HIGH,
                                       POSE_WALL_PLANAR_STOP_STANDING, POSE_WALL_PLANAR_STOP_UNSEEN}) {
      EXPECT_TRUE(lines.insert(line_of().text(language, stopped_by(3.0, 0.0, height), 1.2)).second) << height;
    }
    EXPECT_TRUE(
        lines
            .insert(line_of().text(
                language, stopped_by(3.0, 0.0, POSE_WALL_PLANAR_STOP_STANDING, POSE_WALL_PLANAR_STOP_R_NEARING), 1.2))
            .second);
  }
}

TEST(StopLine, OfSeveralReasonsTheFirstCauseIsTold) {
  constexpr std::uint32_t kAll = (1U << POSE_WALL_PLANAR_STOP_REASON_COUNT) - 1;
  constexpr std::uint32_t kFirstOnes[] = {POSE_WALL_PLANAR_STOP_R_STALE,   POSE_WALL_PLANAR_STOP_R_INVALID,
                                          POSE_WALL_PLANAR_STOP_R_FROZEN,  POSE_WALL_PLANAR_STOP_R_RESTART,
                                          POSE_WALL_PLANAR_STOP_R_THING,   POSE_WALL_PLANAR_STOP_R_NO_FLOOR,
                                          POSE_WALL_PLANAR_STOP_R_BLIND,   POSE_WALL_PLANAR_STOP_R_SPEED,
                                          POSE_WALL_PLANAR_STOP_R_MISSING, POSE_WALL_PLANAR_STOP_R_DUST};
  std::uint32_t left = kAll & ~std::uint32_t{POSE_WALL_PLANAR_STOP_R_NEARING};
  for (const std::uint32_t first : kFirstOnes) {
    EXPECT_EQ(stop_cause(stopped(left)), stop_cause(stopped(first))) << first;
    left &= ~first;
  }
  EXPECT_EQ(stop_cause(stopped(left)), StopCause::kNothing);
  EXPECT_EQ(english(stopped(kAll)),
            "The newest frame of the sensor is 0.5 s old. Look after the sensor, its power and its cable.");
  pose_wall_planar_stop_result first_frame = stopped(POSE_WALL_PLANAR_STOP_R_STALE);
  first_frame.frames = 0;
  EXPECT_EQ(english(first_frame, 3.0),
            "No frame of the sensor has come yet, for 3.0 s. Look after the sensor, its power and its cable.");
}

TEST(StopLine, WhoMayDriveIsToldNothingAndWhoIsSlowedIs) {
  pose_wall_planar_stop_result result =
      stopped_by(9.0, 0.0, POSE_WALL_PLANAR_STOP_HIGH, POSE_WALL_PLANAR_STOP_R_MISSING | POSE_WALL_PLANAR_STOP_R_DUST);
  result.state = POSE_WALL_PLANAR_STOP_GO;
  EXPECT_EQ(english(result, 1.0), "");
  EXPECT_EQ(chinese(result, 1.0), "");
  result.state = POSE_WALL_PLANAR_STOP_SLOW;
  EXPECT_EQ(english(result).find("A thing above 0.3 m, perhaps hanging, 6.8 m ahead, in the track. "), 0U);
}

// Every member that can be no number is none, with each reason and height.
TEST(StopLine, NoNumberThatIsNoneIsPrinted) {
  for (const Language language : kBoth) {
    for (std::uint32_t reasons = 0; reasons < 1U << POSE_WALL_PLANAR_STOP_REASON_COUNT; ++reasons) {
      pose_wall_planar_stop_result result = stopped(reasons);
      result.nearest_height = reasons % 6;
      const double wrong = reasons % 2 == 0 ? kNone : std::numeric_limits<double>::infinity();
      result.nearest_m[0] = result.nearest_size_m = result.rim_speed_m_s = wrong;
      result.nearest_m[1] = reasons % 3 == 0 ? 0.0 : wrong;
      const std::string text = line_of().text(language, result, wrong);
      ASSERT_TRUE(is_of_numbers(text)) << reasons << ": " << text;
    }
  }
}

}  // namespace
}  // namespace pose_wall::tools
