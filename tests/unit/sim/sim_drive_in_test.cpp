// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a machine that drives in comes along the road at its speed and stands at the scene's start as the scene
// begins. From there on the scene and its faults come as they would have come without.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "lab/sim/pose.hpp"
#include "lab/sim/simulator.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools::sim {
namespace {

constexpr std::int64_t kPeriod_ns = 100'000'000;

SceneSetup sparse_setup() {
  SceneSetup setup;
  setup.sensor.rings = 16.0;
  setup.sensor.columns = 64.0;
  setup.sensor.range_noise_m = 0.0;
  return setup;
}

SceneSetup driven(SceneSetup setup, double metres) {
  setup.machine.drive_in_m = metres;
  return setup;
}

std::size_t count_of(const Frame& frame, Label label) {
  return static_cast<std::size_t>(std::count(frame.labels.begin(), frame.labels.end(), label));
}

// From the first frame of the scene on: poses, and stamps but for the time on the way.
void expect_same_scene(const SceneSetup& setup) {
  const Simulator at_once(setup, 1), after_way(driven(setup, 2.0), 1);
  const std::uint32_t first = drive_in_frames(after_way.setup());
  ASSERT_EQ(first, 25U);
  for (std::uint32_t i = 0; i < 30; ++i) {
    const TruthRow expected = at_once.truth(i), row = after_way.truth(first + i);
    EXPECT_EQ(row.stamp_ns - expected.stamp_ns, first * kPeriod_ns) << i;
    EXPECT_EQ(row.pose, expected.pose) << i;
  }
}

TEST(SimDriveIn, TheMachineComesAlongTheRoadAndStandsAtTheStartAsTheSceneBegins) {
  SceneSetup setup = driven(sparse_setup(), 2.0);
  setup.machine.lateral_m = 0.4;
  setup.machine.turned_left_deg = 5.0;
  setup.machine.speed_mps = 0.5;
  setup.machine.drift_mps = 0.2;
  setup.machine.turn_rate_dps = 3.0;
  ASSERT_EQ(drive_in_frames(setup), 25U);
  const Simulator simulator(setup, 1);
  for (std::uint32_t i = 0; i <= 25; ++i) {
    const MachinePose pose = simulator.pose(i);
    EXPECT_NEAR(pose.along_m, -0.08 * (25.0 - i), 1e-12) << i;
    EXPECT_EQ(pose.lateral_m, 0.4) << i;
    EXPECT_EQ(pose.turned_left_rad, 5.0 * kRadPerDeg) << i;
  }
  EXPECT_NEAR(simulator.pose(35).along_m, 0.5, 1e-12) << "a second later, at the scene's own speed";
  EXPECT_NEAR(simulator.pose(35).lateral_m, 0.6, 1e-12);
}

TEST(SimDriveIn, AWayOfNoWholeFramesIsALittleLonger) {
  const SceneSetup setup = driven(sparse_setup(), 1.0);
  ASSERT_EQ(drive_in_frames(setup), 13U);
  const Simulator simulator(setup, 1);
  EXPECT_NEAR(simulator.pose(0).along_m, -1.04, 1e-12);
  EXPECT_EQ(simulator.pose(13).along_m, 0.0);
}

TEST(SimDriveIn, StampsGoOnSteadily) {
  SceneSetup setup = driven(sparse_setup(), 2.0);
  const Simulator simulator(setup, 1);
  for (std::uint32_t i = 0; i < 40; ++i) {
    EXPECT_EQ(simulator.truth(i).stamp_ns, 1000 * 10 * kPeriod_ns + i * kPeriod_ns) << i;
  }
  setup.machine.drive_in_m = 1000.0;
  EXPECT_EQ(Simulator(setup, 1).truth(0).stamp_ns, 10'000 * kPeriod_ns) << "not before zero, however long the way is";
}

TEST(SimDriveIn, ALostWallIsLostAtItsTimeInTheScene) {
  SceneSetup setup = sparse_setup();
  setup.faults.lost_side = kSideLeft;
  setup.faults.lost_from_s = 0.3;
  setup.faults.lost_to_s = 0.6;
  const Simulator simulator(driven(setup, 0.8), 1);
  const std::uint32_t first = drive_in_frames(simulator.setup());
  for (std::uint32_t i = 0; i < first + 9; ++i) {
    const bool is_lost = i >= first + 3 && i < first + 6;
    EXPECT_EQ(count_of(simulator.render(i), Label::kWallLeft) == 0, is_lost) << i;
  }
}

TEST(SimDriveIn, AFrozenSensorRepeatsTheFrameOfTheScene) {
  SceneSetup setup = sparse_setup();
  setup.sensor.range_noise_m = 0.01;
  setup.sequence.freeze_from_s = 0.3;
  setup.sequence.freeze_to_s = 0.6;
  const Simulator simulator(driven(setup, 0.8), 1);
  const std::uint32_t first = drive_in_frames(simulator.setup());
  const auto points = [&](std::uint32_t i) { return simulator.render(i).xyz_intensity; };
  for (std::uint32_t i = 1; i < first + 9; ++i) {
    const bool repeats = i == first + 4 || i == first + 5;
    EXPECT_EQ(points(i) == points(i - 1), repeats) << i;
  }
}

TEST(SimDriveIn, StampsJumpAndStandStillAtTheirTimesInTheScene) {
  SceneSetup setup = sparse_setup();
  setup.sequence.stamp_jump_s = -5.0;
  setup.sequence.stamp_jump_at_s = 1.2;
  setup.sequence.stamp_still_from_s = 0.4;
  setup.sequence.stamp_still_to_s = 0.8;
  expect_same_scene(setup);
}

// Else the scene would begin earlier or later than in the frame that the way in says.
TEST(SimDriveIn, FramesAreDroppedAndSentTwiceInTheSceneAlone) {
  SceneSetup setup = sparse_setup();
  setup.machine.speed_mps = 0.7;
  setup.sequence.duplicate_every = 3.0;
  expect_same_scene(setup);
  setup.sequence.duplicate_every = 0.0;
  setup.sequence.drop_every = 4.0;
  setup.sequence.drop_length = 2.0;
  expect_same_scene(setup);
}

TEST(SimDriveIn, WithoutAWayItsSpeedChangesNothing) {
  SceneSetup setup = sparse_setup();
  setup.machine.speed_mps = 0.3;
  setup.sequence.scan_s = 0.1;
  const Simulator as_it_is(setup, 1);
  setup.machine.drive_in_mps = 7.0;
  const Simulator other(setup, 1);
  EXPECT_EQ(drive_in_frames(setup), 0U);
  for (const std::uint32_t i : {0U, 1U, 7U}) {
    EXPECT_EQ(other.render(i).xyz_intensity, as_it_is.render(i).xyz_intensity) << i;
    EXPECT_EQ(other.truth(i).stamp_ns, as_it_is.truth(i).stamp_ns) << i;
    EXPECT_EQ(other.truth(i).pose, as_it_is.truth(i).pose) << i;
  }
}

std::string fault_of(const SceneSetup& setup) {
  return test::said_by<std::invalid_argument>([&] { const Simulator simulator(setup, 1); });
}

TEST(SimDriveIn, TheWayMustNotBeginBehindTheRoadsEnd) {
  SceneSetup setup = driven(sparse_setup(), 3.0);
  setup.road.rear_distance_m = 2.5;
  EXPECT_NE(fault_of(setup).find("drive_in_m, in whole frames, must be below rear_distance_m"), std::string::npos)
      << fault_of(setup);
  setup.road.rear_distance_m = 3.02;
  EXPECT_NE(fault_of(setup), "") << "38 frames begin 3.04 m before the start";
  setup.road.rear_distance_m = 3.05;
  EXPECT_EQ(fault_of(setup), "");
  setup.road.rear_distance_m = 0.0;
  EXPECT_EQ(fault_of(setup), "") << "open behind";
}

}  // namespace
}  // namespace pose_wall::tools::sim
