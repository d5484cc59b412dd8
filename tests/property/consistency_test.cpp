// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: what the result says hangs together: the distances are the specification's formula on the reported planes,
// with lateral offsets and any sampling points; the levelling matrix is that of roll and pitch; the counts add up.

#include <gtest/gtest.h>

#include <cmath>

#include "support/sim_run.hpp"

namespace pose_wall::test {
namespace {

// The same formula on the same doubles in another order: rounding only.
constexpr double kRounding = 1e-12;

sim::SceneSetup road(int axis) {
  sim::SceneSetup setup = sim::make_setup("trapezoid", "os1-64", false, 1);
  setup.machine.forward_axis = axis;
  setup.machine.turned_left_deg = 7.0;
  setup.machine.roll_deg = 5.0;
  setup.machine.pitch_deg = -8.0;
  setup.mount.mount_z_m = 0.2;
  return setup;
}

// forward and left of the four axes, in base.
constexpr double kForward[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};

double by_formula(const pose_wall_result& r, const pose_wall_plane& wall, int axis, double s, double offset) {
  const double fx = kForward[axis][0], fy = kForward[axis][1];
  const double p[3] = {s * fx - offset * fy, s * fy + offset * fx, 0.0};
  double distance = wall.d_m;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      distance += wall.normal[row] * r.R_level_base[3 * row + column] * p[column];
    }
  }
  return std::fabs(distance);
}

class Consistency : public ::testing::TestWithParam<int> {};

TEST_P(Consistency, DistancesAreTheFormulaOnTheReportedPlanes) {
  const int axis = GetParam();
  const sim::SceneSetup setup = road(axis);
  const sim::Frame frame = sim::Simulator(setup, 4).render(0);
  for (const double offset : {0.0, 0.6, -0.6}) {
    pose_wall_config config = config_for(setup);
    set(&config, "lateral_offset_left", offset);
    set(&config, "lateral_offset_right", -0.5 * offset);
    set(&config, "s_front", 1.5);
    set(&config, "s_back", -2.5);
    EngineUnderTest engine(config);
    const pose_wall_result r = engine.process(cloud_of(frame));
    ASSERT_TRUE(r.left.found != 0 && r.right.found != 0);
    EXPECT_NEAR(r.quantity[POSE_WALL_D_LF].raw, by_formula(r, r.left, axis, 1.5, offset), kRounding);
    EXPECT_NEAR(r.quantity[POSE_WALL_D_LB].raw, by_formula(r, r.left, axis, -2.5, offset), kRounding);
    EXPECT_NEAR(r.quantity[POSE_WALL_D_RF].raw, by_formula(r, r.right, axis, 1.5, -0.5 * offset), kRounding);
    EXPECT_NEAR(r.quantity[POSE_WALL_D_RB].raw, by_formula(r, r.right, axis, -2.5, -0.5 * offset), kRounding);
  }
}

TEST_P(Consistency, AnOffsetToTheFlankShortensTheDistance) {
  const sim::SceneSetup setup = road(GetParam());
  const sim::Frame frame = sim::Simulator(setup, 4).render(0);
  pose_wall_config flank = config_for(setup);
  set(&flank, "lateral_offset_left", 0.6);
  set(&flank, "lateral_offset_right", -0.6);
  EngineUnderTest centre_engine(config_for(setup)), flank_engine(flank);
  const pose_wall_result centre = centre_engine.process(cloud_of(frame)), side = flank_engine.process(cloud_of(frame));
  for (std::uint32_t q = POSE_WALL_D_LF; q <= POSE_WALL_D_RB; ++q) {
    // 0.6 m aside, foreshortened by 7 degrees of yaw, 5 to 8 of tilt and up to 6 of lean.
    EXPECT_NEAR(centre.quantity[q].raw - side.quantity[q].raw, 0.6, 0.04) << pose_wall_quantity_name(q);
  }
}

TEST_P(Consistency, TheLevellingMatrixIsThatOfRollAndPitch) {
  const sim::SceneSetup setup = road(GetParam());
  EngineUnderTest engine(config_for(setup));
  const pose_wall_result r = engine.process(cloud_of(sim::Simulator(setup, 4).render(0)));
  const double roll = r.quantity[POSE_WALL_ROLL].raw, pitch = r.quantity[POSE_WALL_PITCH].raw;
  const double cr = std::cos(roll), sr = std::sin(roll), cp = std::cos(pitch), sp = std::sin(pitch);
  const double expected[9] = {cp, sp * sr, sp * cr, 0.0, cr, -sr, -sp, cp * sr, cp * cr};
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(r.R_level_base[i], expected[i], 1e-14) << i;
  // R_level takes the floor's normal to +Z.
  for (int row = 0; row < 3; ++row) {
    double z = 0.0;
    for (int k = 0; k < 3; ++k) z += r.R_level_base[3 * row + k] * r.floor.normal[k];
    EXPECT_NEAR(z, row == 2 ? 1.0 : 0.0, 1e-14);
  }
}

TEST_P(Consistency, WallNormalsPointToTheMachineAndSidesAreTheirs) {
  const int axis = GetParam();
  const sim::SceneSetup setup = road(axis);
  EngineUnderTest engine(config_for(setup));
  const pose_wall_result r = engine.process(cloud_of(sim::Simulator(setup, 4).render(0)));
  const double lx = -kForward[axis][1], ly = kForward[axis][0];
  EXPECT_GT(r.left.d_m, 0.0);
  EXPECT_GT(r.right.d_m, 0.0);
  EXPECT_LT(r.left.normal[0] * lx + r.left.normal[1] * ly, -0.9);
  EXPECT_GT(r.right.normal[0] * lx + r.right.normal[1] * ly, 0.9);
  EXPECT_GT(r.floor.normal[2], 0.9);
  // A trapezoid scene: the left wall leans out by 6 degrees, the right one in by 4 (to the floor, which is level).
  EXPECT_NEAR(r.left.lean_rad, 6.0 * kRadPerDeg, 1.0 * kRadPerDeg);
  EXPECT_NEAR(r.right.lean_rad, -4.0 * kRadPerDeg, 1.0 * kRadPerDeg);
}

TEST_P(Consistency, CountsAddUpAndLabelsAreThose) {
  const sim::SceneSetup setup = road(GetParam());
  EngineUnderTest engine(config_for(setup));
  const sim::Frame frame = sim::Simulator(setup, 4).render(0);
  const pose_wall_result r = engine.process(cloud_of(frame));
  EXPECT_EQ(r.points_in, frame.count());
  EXPECT_EQ(r.stamp_ns, frame.stamp_ns);
  EXPECT_LE(r.outliers, r.voxels);
  pose_wall_points points;
  ASSERT_EQ(pose_wall_last_points(engine.get(), &points), POSE_WALL_OK);
  EXPECT_EQ(points.count, r.voxels - r.outliers);
  std::uint32_t labels[4] = {};
  for (std::uint32_t i = 0; i < points.count; ++i) {
    ASSERT_LE(points.label[i], POSE_WALL_LABEL_RIGHT);
    ++labels[points.label[i]];
  }
  for (const std::uint32_t count : labels) EXPECT_GT(count, 100U);
}

INSTANTIATE_TEST_SUITE_P(Axes, Consistency, ::testing::Range(0, 4));

}  // namespace
}  // namespace pose_wall::test
