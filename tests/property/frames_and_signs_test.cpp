// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: on a clean road, for all four forward axes, with a sensor that is displaced and tilted in base, and for roll
// to 10, pitch to 15 and yaw to 30 degrees either way, the seven numbers are the truth's within the accuracy that the
// project promises for clean roads; a machine turned left reports negative yaw; and what the walls' lean says of the
// level counts for roll or pitch by the road's direction. Does not prove anything about rough rock; tests/scenario
// does.

#include <gtest/gtest.h>

#include <cmath>

#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

constexpr const char* kAxisNames[] = {"PlusX", "MinusX", "PlusY", "MinusY"};
// The promise is on the root mean square over frames; single frames may lie three times as far off (27 poses of two
// frames each: a Gaussian error passes three sigma once in 370).
constexpr double kPromise[POSE_WALL_QUANTITIES] = {
    0.05 * kRadPerDeg, 0.05 * kRadPerDeg, 0.02 * kRadPerDeg, 0.002, 0.002, 0.002, 0.002};
constexpr double kSingleFrame = 3.0;

sim::SceneSetup clean_road(int axis) {
  sim::SceneSetup setup = sim::make_setup("clean", "os0-128", false, 1);
  setup.machine.forward_axis = axis;
  setup.machine.lateral_m = 0.3;
  setup.machine.speed_mps = 0.1;
  setup.mount.mount_x_m = 0.4;
  setup.mount.mount_y_m = -0.25;
  setup.mount.mount_z_m = 0.3;
  setup.mount.mount_roll_deg = 4.0;
  setup.mount.mount_pitch_deg = -6.0;
  setup.mount.mount_yaw_deg = 35.0;
  return setup;
}

class FramesAndSigns : public ::testing::TestWithParam<int> {};

TEST_P(FramesAndSigns, SevenNumbersAreTheTruths) {
  double squares[POSE_WALL_QUANTITIES] = {};
  int frames = 0;
  for (const double roll : {-10.0, 0.0, 10.0}) {
    for (const double pitch : {-15.0, 0.0, 15.0}) {
      for (const double left : {-30.0, 0.0, 30.0}) {
        sim::SceneSetup setup = clean_road(GetParam());
        setup.machine.roll_deg = roll;
        setup.machine.pitch_deg = pitch;
        setup.machine.turned_left_deg = left;
        for (const JudgedFrame& f : run_frames(setup, 7, 2)) {
          ++frames;
          for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
            EXPECT_TRUE(f.is(q, POSE_WALL_VALID) || f.is(q, POSE_WALL_DEGRADED))
                << pose_wall_quantity_name(q) << " roll " << roll << " pitch " << pitch << " turned left " << left;
            EXPECT_LE(std::fabs(f.raw_error(q)), kSingleFrame * kPromise[q])
                << pose_wall_quantity_name(q) << " roll " << roll << " pitch " << pitch << " turned left " << left;
            EXPECT_LE(std::fabs(f.raw_error(q)), f.result.quantity[q].protection_level) << pose_wall_quantity_name(q);
            squares[q] += f.raw_error(q) * f.raw_error(q);
          }
        }
      }
    }
  }
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    EXPECT_LE(std::sqrt(squares[q] / frames), kPromise[q]) << pose_wall_quantity_name(q);
  }
}

// A floor that falls by 15 degrees between upright walls: a heap's flank looks the same. The doubt is about the road,
// which is roll or pitch by the forward axis, and some of both for a machine that is turned.
TEST_P(FramesAndSigns, WallsThatLeanAlikeDoubtTheAngleAboutTheRoad) {
  constexpr double kFall_deg = 15.0;
  const auto level = [](double fall_deg, double left_deg, std::uint32_t q) {
    sim::SceneSetup setup = sim::make_setup("clean", "os0-128", false, 1);
    setup.machine.forward_axis = GetParam();
    setup.machine.turned_left_deg = left_deg;
    setup.road.cross_fall_deg = fall_deg;
    const JudgedFrame f = run_frames(setup, 7, 1)[0];
    EXPECT_TRUE(f.is(q, POSE_WALL_VALID) || f.is(q, POSE_WALL_DEGRADED)) << pose_wall_quantity_name(q);
    return f.result.quantity[q].protection_level;
  };
  const bool along_x = GetParam() < 2;
  const std::uint32_t about = along_x ? POSE_WALL_ROLL : POSE_WALL_PITCH;
  const std::uint32_t across = along_x ? POSE_WALL_PITCH : POSE_WALL_ROLL;
  for (const double fall_deg : {-kFall_deg, kFall_deg}) {
    EXPECT_GE(level(fall_deg, 0.0, about), kFall_deg * kRadPerDeg);
    EXPECT_LE(level(fall_deg, 0.0, across), 0.1 * kFall_deg * kRadPerDeg);
    for (const double left_deg : {-30.0, 30.0}) {
      EXPECT_GE(level(fall_deg, left_deg, about), 0.8 * kFall_deg * kRadPerDeg);
      EXPECT_GE(level(fall_deg, left_deg, across), 0.4 * kFall_deg * kRadPerDeg);
    }
  }
  EXPECT_LE(level(5.0, 0.0, about), kRadPerDeg) << "as floors may fall";
}

TEST_P(FramesAndSigns, AMachineTurnedLeftReportsNegativeYaw) {
  for (const double left : {-20.0, -3.0, 3.0, 20.0}) {
    sim::SceneSetup setup = clean_road(GetParam());
    setup.machine.turned_left_deg = left;
    const JudgedFrame f = run_frames(setup, 3, 1)[0];
    EXPECT_NEAR(f.result.quantity[POSE_WALL_YAW].raw, -left * kRadPerDeg, kSingleFrame * kPromise[POSE_WALL_YAW]);
    EXPECT_EQ(std::signbit(f.result.quantity[POSE_WALL_YAW].value), left > 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Axes, FramesAndSigns, ::testing::Range(0, 4),
                         [](const auto& test) { return kAxisNames[test.param]; });

}  // namespace
}  // namespace pose_wall::test
