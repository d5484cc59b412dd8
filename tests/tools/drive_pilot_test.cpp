// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a machine that the stop holds for good goes back and round what holds it, where there is room; else it waits,
// goes on when the way is clear again, or gives up and says where and why. Does not prove: that the real stop lets it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "english_left.hpp"
#include "lab/drive/pilot.hpp"
#include "lab/sim/network_people.hpp"
#include "study/planar/plane_pose.hpp"
#include "study/planar/stop_reasons.hpp"
#include "test_files.hpp"

namespace pose_wall::tools {
namespace {

using test::contains;

constexpr double kCell_m = 0.05;

// A road along x from -6 to 26 m.
MapFile road(double width_m) {
  MapFile map;
  map.resolution_m = kCell_m;
  map.width = 640;
  map.height = static_cast<std::uint32_t>(width_m / kCell_m + 0.5) + 2;
  map.origin_x_m = -6.0;
  map.origin_y_m = -0.5 * kCell_m * map.height;
  map.cells.assign(std::size_t{map.width} * map.height, 0);
  for (std::uint32_t column = 0; column < map.width; ++column) {
    map.cells[column] = 100;
    map.cells[std::size_t{map.height - 1} * map.width + column] = 100;
  }
  return map;
}

double off_m(const pose_wall_planar_pose& base, const MapPlace& thing) {
  const sim::Footprint footprint{{base.x_m, base.y_m, base.yaw_rad}, kFront_m, kRear_m, kHalfWidth_m};
  return footprint.distance_m({thing.x_m, thing.y_m});
}

// A machine that obeys at once, knows its place, and is held before a thing that its map does not show.
class HeldDrive {
 public:
  HeldDrive(const MapFile& map, double goal_x_m) : pilot_(map, {{goal_x_m, 0.0, 0.0}}, 0.5, kPatience_s) {
    scan_.struct_size = sizeof scan_;
    where_.struct_size = sizeof where_;
    where_.state = POSE_WALL_PLANAR_LOCALISE_UNIQUE;
    where_.covariance[0] = where_.covariance[4] = 1e-4;
  }

  void begin_at(const pose_wall_planar_pose& base) { at_ = base; }
  void run(double most_s) {
    while (time_s_ < most_s && pilot_.phase() != PilotPhase::kArrived && pilot_.phase() != PilotPhase::kGivenUp) step();
  }

  static constexpr double kPatience_s = 60.0, kKeeps_m = 0.5;
  MapPlace thing{10.0, 0.0};
  double leaves_s = 1e9;
  std::uint32_t reasons = POSE_WALL_PLANAR_STOP_R_THING;
  double nearest_m = 1e9;

  const DrivePilot& pilot() const { return pilot_; }
  const pose_wall_planar_pose& at() const { return at_; }
  double time_s() const { return time_s_; }

 private:
  void step() {
    where_.stamp_ns = static_cast<std::int64_t>(1e9 * time_s_);
    where_.pose = at_;
    DrivePilot::View view;
    view.stamp_ns = where_.stamp_ns;
    view.now_ns = where_.stamp_ns + static_cast<std::int64_t>(1e9 * kResult_s);
    view.scan = &scan_;
    view.where = &where_;
    view.measured = command_;
    command_ = pilot_.wish(view);
    const pose_wall_planar_pose next =
        combined(at_, {kFrame_s * command_.speed_m_s, 0.0, kFrame_s * command_.turn_rad_s});
    pose_wall_planar_stop_result stop{};
    stop.nearest_m[0] = stop.nearest_m[1] = stop.nearest_distance_m = std::nan("");
    if (time_s_ < leaves_s && off_m(next, thing) < kKeeps_m && off_m(next, thing) < off_m(at_, thing)) {
      command_ = {};
      stop.reasons = reasons | POSE_WALL_PLANAR_STOP_R_SPEED;
      const pose_wall_planar_pose seen = seen_from(at_, {thing.x_m, thing.y_m, 0.0});
      stop.nearest_m[0] = seen.x_m;
      stop.nearest_m[1] = seen.y_m;
      stop.nearest_distance_m = off_m(at_, thing);
    } else {
      at_ = next;
    }
    pilot_.obeyed(command_, stop);
    if (time_s_ < leaves_s) nearest_m = std::min(nearest_m, off_m(at_, thing));
    time_s_ += kFrame_s;
  }

  DrivePilot pilot_;
  pose_wall_planar_scan scan_{};
  pose_wall_planar_localise_result where_{};
  pose_wall_planar_pose at_{0.0, 0.0, 0.0};
  Motion command_;
  double time_s_ = 0.0;
};

TEST(DrivePilot, GoesBackAndRoundWhatHoldsIt) {
  const MapFile map = road(9.0);
  HeldDrive drive(map, 20.0);
  drive.run(400.0);
  EXPECT_EQ(drive.pilot().phase(), PilotPhase::kArrived) << drive.pilot().reason();
  EXPECT_GE(drive.pilot().plans(), 3U) << "to the goal, back, and round it";
  EXPECT_GT(drive.nearest_m, 0.4);
  EXPECT_NEAR(drive.at().x_m, 20.0, 0.2);
}

TEST(DrivePilot, WhereNoWayLeadsRoundItGivesUpAndSaysWhereItIsHeld) {
  const MapFile map = road(4.0);
  HeldDrive drive(map, 20.0);
  drive.run(400.0);
  EXPECT_EQ(drive.pilot().phase(), PilotPhase::kGivenUp);
  EXPECT_EQ(drive.pilot().reason(),
            "the stop held it for 60 s: a thing in the way, at x 10.0 m, y 0.0 m of the map. No other way was found");
  EXPECT_EQ(drive.pilot().plans(), 1U) << "it goes back only where that helps";
}

TEST(DrivePilot, WaitsForWhoLeavesAndGoesOn) {
  const MapFile map = road(4.0);
  HeldDrive drive(map, 20.0);
  drive.reasons |= POSE_WALL_PLANAR_STOP_R_NEARING;
  drive.leaves_s = 60.0;
  drive.run(400.0);
  EXPECT_EQ(drive.pilot().phase(), PilotPhase::kArrived) << drive.pilot().reason();
  EXPECT_EQ(drive.pilot().plans(), 1U);
  EXPECT_GT(drive.time_s(), 60.0);
}

TEST(DrivePilot, LeavesAPlaceTooNearToRock) {
  MapFile map = road(9.0);
  // A ledge beside the machine, up to x = 3 m; it stands 0.2 m from it.
  for (std::uint32_t row = map.height - 10; row < map.height; ++row) {
    for (std::uint32_t column = 0; column < 180; ++column) map.cells[std::size_t{row} * map.width + column] = 100;
  }
  HeldDrive drive(map, 20.0);
  drive.thing = {-100.0, 0.0};
  drive.begin_at({0.0, 3.25, 0.0});
  drive.run(400.0);
  EXPECT_EQ(drive.pilot().phase(), PilotPhase::kArrived) << drive.pilot().reason();
  EXPECT_EQ(drive.pilot().plans(), 2U) << "out, and to the goal";
}

// What a scanner in base sees of a road along x with walls at these places, and of a post ahead.
class SeenRoad {
 public:
  SeenRoad(double left_m, double right_m, double post_m = 100.0) {
    for (int k = 0; k < kBeams; ++k) {
      const double s = std::sin(2.0 * M_PI * k / kBeams);
      ranges_[k] = static_cast<float>(s > 0.0 ? left_m / s : right_m / std::min(s, -1e-9));
    }
    for (int k = 0; k < 10; ++k) ranges_[k] = static_cast<float>(post_m);
    scan_.struct_size = sizeof scan_;
    scan_.beams = kBeams;
    scan_.angle_step_rad = 2.0 * M_PI / kBeams;
    scan_.range_min_m = 0.3;
    scan_.range_m = ranges_;
  }
  const pose_wall_planar_scan& scan() const { return scan_; }

 private:
  static constexpr int kBeams = 1440;
  float ranges_[kBeams] = {};
  pose_wall_planar_scan scan_{};
};

TEST(RoadFeeler, SwingsNoEndIntoAWallBesideIt) {
  RoadFeeler feeler;
  const SeenRoad in_the_middle(5.0, -5.0, 5.0), at_the_left_wall(1.05, -3.75, 5.0);
  EXPECT_GT(std::abs(feeler.creep(in_the_middle.scan()).turn_rad_s), 0.006) << "past the post";
  const Motion motion = feeler.creep(at_the_left_wall.scan());
  EXPECT_GT(motion.speed_m_s, 0.0);
  EXPECT_NEAR(motion.turn_rad_s, 0.0, 0.006) << "a turn away from the wall swings the tail into it";
}

TEST(RoadFeeler, TurnsBackWhenTold) {
  RoadFeeler feeler;
  const SeenRoad road(2.4, -2.4);
  EXPECT_GT(feeler.creep(road.scan()).speed_m_s, 0.0);
  feeler.turn_back();
  EXPECT_LT(feeler.creep(road.scan()).speed_m_s, 0.0);
}

TEST(WayFinder, TakesTheGoalThatTheMachineCanFace) {
  const MapFile map = road(4.0);  // too narrow to turn
  WayFinder finder(map);
  const pose_wall_planar_pose start{0.0, 0.0, 0.0}, back{10.0, 0.0, M_PI}, ahead{10.0, 0.0, 0.0};
  EXPECT_FALSE(finder.to_goal(start, {back}).is_found());
  const PlannedRoute route = finder.to_goal(start, {back, ahead});
  ASSERT_TRUE(route.is_found());
  EXPECT_NEAR(route.poses.back().pose.yaw_rad, 0.0, 1e-6);
}

TEST(WayFinder, PlansNoTurnThatTheStopWouldNotLetPass) {
  // The tail's corner reaches 2.47 m from base, so a turn in the middle leaves a quarter of a metre in this road.
  const MapFile map = road(5.4);
  WayFinder finder(map);
  EXPECT_FALSE(finder.to_goal({0.0, 0.0, 0.0}, {{5.0, 0.0, M_PI}}).is_found());
  const MapFile wide = road(6.2);
  WayFinder in_wide(wide);
  EXPECT_TRUE(in_wide.to_goal({0.0, 0.0, 0.0}, {{5.0, 0.0, M_PI}}).is_found());
}

TEST(WayFinder, KeepsFurtherFromWhatHeldItThanItWasHeld) {
  const MapFile map = road(9.0);
  WayFinder finder(map);
  const MapPlace thing{5.0, 0.3};
  finder.hold({thing, 1.2, false});
  const PlannedRoute route = finder.to_goal({0.0, 0.0, 0.0}, {{12.0, 0.0, 0.0}});
  ASSERT_TRUE(route.is_found());
  for (const pose_wall_planar_path_pose& at : route.poses) EXPECT_GT(off_m(at.pose, thing), 1.2);
}

TEST(WayFinder, ForgetsWhoMayHaveLeft) {
  const MapFile map = road(4.0);
  WayFinder finder(map);
  const pose_wall_planar_pose start{0.0, 0.0, 0.0}, goal{12.0, 0.0, 0.0};
  finder.hold({{6.0, 0.0}, 1.0, true});
  EXPECT_FALSE(finder.to_goal(start, {goal}).is_found());
  finder.hold({{20.0, 0.0}, 1.0, true});
  EXPECT_TRUE(finder.to_goal(start, {goal}).is_found());
  finder.hold({{6.0, 0.0}, 1.0, false});
  finder.hold({{20.0, 0.0}, 1.0, true});
  EXPECT_FALSE(finder.to_goal(start, {goal}).is_found()) << "a thing that stands stays";
}

TEST(StopReasons, AreWordsInTheReadersLanguage) {
  const test::EnglishAfterwards english_afterwards;
  EXPECT_EQ(stop_reasons_text(POSE_WALL_PLANAR_STOP_R_THING | POSE_WALL_PLANAR_STOP_R_LOW), "a thing in the way, low");
  EXPECT_EQ(stop_reasons_text(0), "");
  choose_language(Language::kChinese);
  for (std::uint32_t bit = 0; bit < POSE_WALL_PLANAR_STOP_REASON_COUNT; ++bit) {
    const std::string text = stop_reasons_text(1U << bit);
    EXPECT_TRUE(std::none_of(text.begin(), text.end(), [](char c) { return c >= 'a' && c <= 'z'; })) << text;
  }
}

}  // namespace
}  // namespace pose_wall::tools
