// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the engine has no favourite direction or side: a road that is turned or mirrored gives an answer that is
// turned or mirrored. Does not prove that either answer is right; frames_and_signs_test.cpp does.

#include <gtest/gtest.h>

#include <cmath>

#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

// The points are the same but fall into other voxels, so each answer has its own rounding noise: half a voxel's spread
// (25 mm) over the square root of some thousand voxels is under 1 mm and, over 8 m of wall, 0.01 degrees; five times
// that. Different walls' halves are drawn as hypotheses, but the polish at the end is on all points.
constexpr double kAngle_rad = 0.05 * kRadPerDeg;
constexpr double kDistance_m = 0.005;

Points road(double turned_left_deg, double roll_deg) {
  sim::SceneSetup setup = sim::make_setup("clean", "os1-64", false, 1);
  setup.machine.turned_left_deg = turned_left_deg;
  setup.machine.roll_deg = roll_deg;
  setup.machine.lateral_m = 0.4;
  return points_of(sim::Simulator(setup, 5).render(0));
}

pose_wall_result measured(const Points& points) {
  EngineUnderTest engine(config_with());
  return engine.process(cloud_of(points, 0));
}

double raw(const pose_wall_result& r, std::uint32_t q) {
  EXPECT_GE(r.quantity[q].state, POSE_WALL_DEGRADED) << pose_wall_quantity_name(q);
  return r.quantity[q].raw;
}

TEST(Symmetry, ARoadTurnedAboutTheUprightMachineTurnsTheYaw) {
  const Points straight = road(0.0, 0.0);
  const double before = raw(measured(straight), POSE_WALL_YAW);
  for (const double turn_deg : {-35.0, -12.0, -1.0, 2.0, 20.0, 38.0}) {
    const double c = std::cos(turn_deg * kRadPerDeg), s = std::sin(turn_deg * kRadPerDeg);
    Points turned = straight;
    for (auto& [x, y, z] : turned) {
      const double old_x = x, old_y = y;
      x = static_cast<float>(c * old_x - s * old_y);
      y = static_cast<float>(s * old_x + c * old_y);
    }
    // The angle from the machine to the road grows as the road turns left.
    EXPECT_NEAR(raw(measured(turned), POSE_WALL_YAW) - before, turn_deg * kRadPerDeg, kAngle_rad) << turn_deg;
  }
}

TEST(Symmetry, AMirroredRoadSwapsTheSidesAndFlipsRollAndYaw) {
  const Points right_handed = road(6.0, 4.0);
  Points left_handed = right_handed;
  for (auto& [x, y, z] : left_handed) y = -y;
  const pose_wall_result a = measured(right_handed), b = measured(left_handed);
  EXPECT_NEAR(raw(a, POSE_WALL_ROLL), -raw(b, POSE_WALL_ROLL), kAngle_rad);
  EXPECT_NEAR(raw(a, POSE_WALL_PITCH), raw(b, POSE_WALL_PITCH), kAngle_rad);
  EXPECT_NEAR(raw(a, POSE_WALL_YAW), -raw(b, POSE_WALL_YAW), kAngle_rad);
  EXPECT_NEAR(raw(a, POSE_WALL_D_LF), raw(b, POSE_WALL_D_RF), kDistance_m);
  EXPECT_NEAR(raw(a, POSE_WALL_D_LB), raw(b, POSE_WALL_D_RB), kDistance_m);
  EXPECT_NEAR(raw(a, POSE_WALL_D_RF), raw(b, POSE_WALL_D_LF), kDistance_m);
  EXPECT_NEAR(raw(a, POSE_WALL_D_RB), raw(b, POSE_WALL_D_LB), kDistance_m);
}

// The same machine, its axis called by another name: what is ahead becomes what is behind.
TEST(Symmetry, TheOppositeForwardAxisSwapsSidesAndEnds) {
  const Points points = road(6.0, 4.0);
  EngineUnderTest ahead(config_with({{"forward_axis", "+X"}})), back(config_with({{"forward_axis", "-X"}}));
  const pose_wall_result a = ahead.process(cloud_of(points, 0)), b = back.process(cloud_of(points, 0));
  EXPECT_NEAR(raw(a, POSE_WALL_ROLL), raw(b, POSE_WALL_ROLL), kAngle_rad);
  EXPECT_NEAR(raw(a, POSE_WALL_PITCH), raw(b, POSE_WALL_PITCH), kAngle_rad);
  EXPECT_NEAR(raw(a, POSE_WALL_YAW), raw(b, POSE_WALL_YAW), kAngle_rad);
  EXPECT_NEAR(raw(a, POSE_WALL_D_LF), raw(b, POSE_WALL_D_RB), kDistance_m);
  EXPECT_NEAR(raw(a, POSE_WALL_D_RB), raw(b, POSE_WALL_D_LF), kDistance_m);
}

}  // namespace
}  // namespace pose_wall::test
