// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves that the picture of a frame is a well-formed document, the same every time, that it shows figures only where
// there are some, and that walls and feet of the distances lie where the planes say. Its looks are judged by eye.

#include "io/picture/frame_picture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "crafted_value.hpp"
#include "io/picture/drawn_frame.hpp"
#include "pose_wall.hpp"

namespace pose_wall::tools::picture {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kTolerance_m = 1e-9;

struct Scene {
  api::Config config;
  pose_wall_result result = api::make_result();
  pose_wall_points points{};

  Scene() {
    for (pose_wall_value& value : result.quantity) value = test::unmeasured_value();
    for (int i = 0; i < 3; ++i) result.R_level_base[4 * i] = 1.0;
  }

  // A road turned by yaw to the left of the machine's axis (+X), walls 2 m to the left and 3 m to the right.
  void set_road(double yaw_rad) {
    result.quantity[POSE_WALL_YAW].value = result.quantity[POSE_WALL_YAW].raw = yaw_rad;
    result.quantity[POSE_WALL_YAW].state = POSE_WALL_VALID;
    result.left = wall(std::sin(yaw_rad), -std::cos(yaw_rad), 2.0);
    result.right = wall(-std::sin(yaw_rad), std::cos(yaw_rad), 3.0);
  }

  std::string svg() const { return frame_picture({config.get(), &result, &points, "title", "subtitle", nullptr}); }

 private:
  static pose_wall_plane wall(double normal_x, double normal_y, double d_m) {
    pose_wall_plane plane{};
    plane.normal[0] = normal_x;
    plane.normal[1] = normal_y;
    plane.d_m = d_m;
    plane.found = 1;
    return plane;
  }
};

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST(FramePicture, IsOneClosedDocument) {
  Scene scene;
  scene.set_road(0.1);
  const std::string svg = scene.svg();
  EXPECT_EQ(svg.rfind("<svg ", 0), 0u);
  EXPECT_EQ(svg.substr(svg.size() - 7), "</svg>\n");
  EXPECT_EQ(occurrences(svg, "<g "), occurrences(svg, "</g>"));
  EXPECT_EQ(occurrences(svg, "<text "), occurrences(svg, "</text>"));
}

TEST(FramePicture, SameSceneGivesSameText) {
  Scene scene;
  scene.set_road(-0.2);
  EXPECT_EQ(scene.svg(), scene.svg());
}

TEST(FramePicture, ShowsNoFigureWhereNothingWasMeasured) {
  const std::string svg = Scene().svg();
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  for (const char* name : {"d_LF", "d_LB", "d_RF", "d_RB"}) {
    EXPECT_NE(svg.find(std::string(name) + " not measured"), std::string::npos) << name;
  }
}

TEST(FramePicture, ShowsValuesInDegreesAndMetres) {
  Scene scene;
  scene.set_road(0.1);
  scene.result.quantity[POSE_WALL_D_LF] = test::crafted_value(POSE_WALL_HELD, 1.2345, kNone, {0.05});
  const std::string svg = scene.svg();
  EXPECT_NE(svg.find("yaw +5.73°"), std::string::npos);
  EXPECT_NE(svg.find("d_LF 1.234 m"), std::string::npos);
  EXPECT_NE(svg.find(">held<"), std::string::npos);
}

// Machine and lines are drawn by raw, while the table's first figures are those to act on.
TEST(FramePicture, TellsRawFromWhatIsSmoothedOrHeld) {
  Scene scene;
  scene.set_road(0.1);
  scene.result.quantity[POSE_WALL_YAW] =
      test::crafted_value(POSE_WALL_VALID, 0.09, 0.1, {0.01, 0.0, 0.0, 0.02, 0.0, 0.01, 0.0});
  scene.result.quantity[POSE_WALL_D_LF] = test::crafted_value(POSE_WALL_HELD, 1.2345, kNone, {0.05});
  scene.result.quantity[POSE_WALL_D_RF] =
      test::crafted_value(POSE_WALL_VALID, 3.1, 3.0, {0.2, 0.0, 0.0, 0.0, 0.0, 0.1, 0.0});
  const std::string svg = scene.svg();
  for (const char* shown :
       {"raw yaw +5.73°", ">+5.16°<", ">raw +5.73°<", ">2.29°<", ">1.72°<", "held d_LF 1.234 m", "raw d_RF 3.000 m",
        "± 0.200", ">3.100 m<", "level mostly: rival", "level mostly: random"}) {
    EXPECT_NE(svg.find(shown), std::string::npos) << shown;
  }
}

TEST(FramePicture, AValueThatIsNotValidIsGrey) {
  const auto row_of = [](std::uint32_t state) {
    Scene scene;
    scene.result.quantity[POSE_WALL_D_LF] = test::crafted_value(state, 1.2345, kNone, {0.05});
    const std::string svg = scene.svg();
    const std::size_t at = svg.find(">1.234 m<");
    return svg.substr(svg.rfind("<text", at), at - svg.rfind("<text", at));
  };
  EXPECT_NE(row_of(POSE_WALL_VALID).find("#22282e"), std::string::npos);
  EXPECT_NE(row_of(POSE_WALL_DEGRADED).find("#737b83"), std::string::npos);
}

TEST(FramePicture, SaysWhatAPositiveAngleMeans) {
  Scene scene;
  EXPECT_EQ(scene.svg().find("side down"), std::string::npos) << "an unknown sign is not made up";
  scene.result.positive_means[POSE_WALL_ROLL] = POSE_WALL_SENSE_LEFT_DOWN;
  scene.result.positive_means[POSE_WALL_YAW] = POSE_WALL_SENSE_TURNED_RIGHT;
  const std::string svg = scene.svg();
  EXPECT_NE(svg.find("+ left side down"), std::string::npos);
  EXPECT_NE(svg.find("+ turned right"), std::string::npos);
}

TEST(FramePicture, EscapesWhatTheCallerWrites) {
  Scene scene;
  const std::string svg =
      frame_picture({scene.config.get(), &scene.result, &scene.points, "a < b & \"c\"", "", nullptr});
  EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
}

TEST(DrawnFrame, RoadRunsAlongItsFirstAxis) {
  for (const double yaw_rad : {0.0, 0.3, -0.5}) {
    Scene scene;
    scene.set_road(yaw_rad);
    const DrawnFrame frame(*scene.config.get(), scene.result);
    EXPECT_NEAR(frame.wall(scene.result.left).left_at(7.0, 0.0), 2.0, kTolerance_m);
    EXPECT_NEAR(frame.wall(scene.result.right).left_at(-7.0, 0.0), -3.0, kTolerance_m);
    // A road to the left of the machine's axis: the machine points to the right of the road.
    const Drawn nose = frame.from_machine(2.0, 0.0, 0.0);
    EXPECT_NEAR(nose.along, 2.0 * std::cos(yaw_rad), kTolerance_m);
    EXPECT_NEAR(nose.left, -2.0 * std::sin(yaw_rad), kTolerance_m);
  }
}

TEST(DrawnFrame, FollowsForwardAxis) {
  Scene scene;
  ASSERT_EQ(scene.config.set("forward_axis", "-Y"), POSE_WALL_OK);
  const DrawnFrame frame(*scene.config.get(), scene.result);
  const Drawn ahead = frame.from_base(0.0, -1.0, 0.0);
  EXPECT_NEAR(ahead.along, 1.0, kTolerance_m);
  EXPECT_NEAR(ahead.left, 0.0, kTolerance_m);
  // left = Z x forward, which for -Y is +X.
  EXPECT_NEAR(frame.from_base(1.0, 0.0, 0.0).left, 1.0, kTolerance_m);
}

}  // namespace
}  // namespace pose_wall::tools::picture
