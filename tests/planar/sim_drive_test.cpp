// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the simulated tracks drive the arcs that are computed by hand, odometry errs by what it is not told, and
// whole drives keep to their roads and are the same for the same seed.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "lab/sim/drive_route.hpp"

namespace pose_wall::tools::sim::drive_test {
namespace {

TrackSettings at_once() {
  TrackSettings settings = TrackSettings::without_slip();
  settings.lag_s = 0.0;
  settings.acceleration_mps2 = 1e9;
  return settings;
}

void go(TrackDrive* machine, double left_mps, double right_mps, double time_s, double step_s = 0.05) {
  for (int i = 0; i < static_cast<int>(std::lround(time_s / step_s)); ++i) machine->step({left_mps, right_mps}, step_s);
}

void expect_pose(const PlanePose& pose, double x_m, double y_m, double yaw_rad, double slack = 1e-9) {
  EXPECT_NEAR(pose.x_m, x_m, slack);
  EXPECT_NEAR(pose.y_m, y_m, slack);
  EXPECT_NEAR(std::remainder(pose.yaw_rad - yaw_rad, 2 * M_PI), 0.0, slack);
}

TEST(SimDrive, ArcsByHand) {
  expect_pose(moved({1, 2, M_PI / 2}, 0.5, 0, 0, 4), 1, 4, M_PI / 2);
  // A quarter of a circle of radius 2 to the left.
  expect_pose(moved({}, M_PI, 0, M_PI / 2, 1), 2, 2, M_PI / 2);
  // Half of one of radius 1 to the right.
  expect_pose(moved({}, M_PI, 0, -M_PI, 1), 0, -2, M_PI);
  // Sideways about a point ahead.
  expect_pose(moved({}, 0, -1, 1, M_PI), 2, 0, M_PI);
  expect_pose(moved({}, 1, 0, 1e-7, 1), 1, 5e-8, 1e-7, 1e-12);
}

TEST(SimDrive, TracksWithoutSlip) {
  TrackSettings settings = at_once();
  settings.gauge_m = 1.0;
  TrackDrive ahead(settings, nullptr, {0, 0, 0.3}, 1);
  go(&ahead, 0.5, 0.5, 10);
  expect_pose(ahead.truth(), 5 * std::cos(0.3), 5 * std::sin(0.3), 0.3);
  EXPECT_NEAR(ahead.driven_m(), 5.0, 1e-9);
  // Right track twice as fast: radius 1.5 gauges, and a whole circle of it comes back.
  TrackDrive circle(settings, nullptr, {0, 0, 0}, 1);
  go(&circle, 0.25, 0.5, M_PI, M_PI / 40);
  expect_pose(circle.truth(), 1.5 * std::sin(0.25 * M_PI), 1.5 * (1 - std::cos(0.25 * M_PI)), 0.25 * M_PI);
  go(&circle, 0.25, 0.5, 7 * M_PI, M_PI / 40);
  expect_pose(circle.truth(), 0, 0, 0);
  expect_pose(circle.odometry(), 0, 0, 0);
  TrackDrive spin(settings, nullptr, {3, 4, 0}, 1);
  go(&spin, -0.5, 0.5, 1);
  expect_pose(spin.truth(), 3, 4, 1);
  EXPECT_NEAR(spin.turned_rad(), 1.0, 1e-9);
}

TEST(SimDrive, SlipAndResistanceByHand) {
  TrackSettings settings = at_once();
  settings.gauge_m = 1.0;
  settings.slip = 0.1;
  settings.turn_resistance = 2.0;
  TrackDrive ahead(settings, nullptr, {}, 1);
  go(&ahead, 0.5, 0.5, 10);
  expect_pose(ahead.truth(), 4.5, 0, 0);
  expect_pose(ahead.odometry(), 5.0, 0, 0);
  TrackDrive spin(settings, nullptr, {}, 1);
  go(&spin, -0.5, 0.5, 1);
  expect_pose(spin.truth(), 0, 0, 0.45);
  expect_pose(spin.odometry(), 0, 0, 1.0);
  settings.odometry_slip = 0.1;
  settings.odometry_turn_resistance = 2.0;
  TrackDrive told(settings, nullptr, {}, 1);
  go(&told, 0.2, 0.5, 20);
  expect_pose(told.odometry(), told.truth().x_m, told.truth().y_m, told.truth().yaw_rad);
  settings.turn_ahead_m = 0.5;
  TrackDrive about(settings, nullptr, {}, 1);
  go(&about, -0.5, 0.5, 2);
  // The point half a metre ahead stays.
  EXPECT_NEAR(about.truth().x_m + 0.5 * std::cos(about.truth().yaw_rad), 0.5, 1e-9);
  EXPECT_NEAR(about.truth().y_m + 0.5 * std::sin(about.truth().yaw_rad), 0.0, 1e-9);
}

TEST(SimDrive, TracksFollowWithALagAndALimit) {
  TrackSettings settings = TrackSettings::without_slip();
  settings.lag_s = 0.5;
  settings.acceleration_mps2 = 1e9;
  TrackDrive lag(settings, nullptr, {}, 1);
  go(&lag, 0.8, 0.8, 0.5, 0.01);
  EXPECT_NEAR(lag.tracks().left_mps, 0.8 * (1 - std::exp(-1.0)), 1e-9);
  settings.lag_s = 0.0;
  settings.acceleration_mps2 = 0.4;
  TrackDrive limit(settings, nullptr, {}, 1);
  go(&limit, 5, -5, 1, 0.01);
  EXPECT_NEAR(limit.tracks().left_mps, 0.4, 1e-9);
  go(&limit, 5, -5, 9, 0.01);
  EXPECT_NEAR(limit.tracks().right_mps, -settings.speed_max_mps, 1e-9);
}

TEST(SimDrive, GyroscopeKeepsTheYaw) {
  TrackSettings settings;
  settings.gyroscope = 1.0;
  settings.gyroscope_bias_dps = settings.gyroscope_noise_dps = 0.0;
  const Network network(NetworkPlan(), 1);
  TrackDrive machine(settings, &network, {10, 0, 0}, 3);
  go(&machine, 0.4, 0.5, 30);
  EXPECT_NEAR(std::remainder(machine.odometry().yaw_rad - machine.truth().yaw_rad, 2 * M_PI), 0.0, 1e-9);
  EXPECT_GT(std::hypot(machine.odometry().x_m - machine.truth().x_m, machine.odometry().y_m - machine.truth().y_m),
            0.005);
}

TEST(SimDrive, DrivesKeepToTheirRoads) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    NetworkPlan plan;
    plan.length_m = 200;
    plan.turn_rad = seed % 2 == 0 ? 0.8 : 0.0;
    plan.prop_pitch_m = seed % 3 == 0 ? 3.0 : 0.0;
    const Network network(plan, seed);
    const Route route = network.graph().tour(0, 250, seed);
    RunSettings settings;
    settings.sensor.beams = 90;
    const NetworkRun run = drive(network, route, settings, seed);
    ASSERT_TRUE(run.has_arrived) << "seed " << seed;
    EXPECT_NEAR(run.driven_m, route.length_m, 0.05 * route.length_m + 2.0);
    EXPECT_GT(run.scans(), static_cast<std::size_t>(3.5 * run.driven_m));
    double worst_tilt_rad = 0.0;
    for (std::size_t i = 0; i < run.scans(); ++i) {
      const RunStep& step = run.at_scan(i);
      EXPECT_GT(network.clearance_m(step.truth.place(), 3.0), 0.6) << "seed " << seed << " at " << step.time_s << " s";
      worst_tilt_rad = std::max({worst_tilt_rad, std::abs(step.roll_rad), std::abs(step.pitch_rad)});
    }
    EXPECT_GT(worst_tilt_rad, 0.005);
    EXPECT_LT(worst_tilt_rad, 0.12);
    const RunStep& last = run.steps.back();
    const double error_m = (last.odometry.place() - last.truth.place()).norm();
    EXPECT_GT(error_m, 0.1) << "odometry that never errs tests nothing";
  }
}

TEST(SimDrive, ScansAreThoseOfTheirPoses) {
  const Network network(NetworkPlan(), 5);
  RunSettings settings;
  settings.sensor.noise_m = settings.sensor.dropout = 0.0;
  const NetworkRun run = drive(network, network.graph().tour(0, 60, 1), settings, 5);
  ASSERT_EQ(run.ranges.size(), run.scans() * 360);
  for (std::size_t i = 0; i < run.scans(); i += 7) {
    const PlanePose& at = run.at_scan(i).truth;
    for (int beam = 0; beam < 360; beam += 11) {
      const double angle = at.yaw_rad + settings.sensor.angle_min_rad() + beam * settings.sensor.angle_step_rad();
      const PlaneHit hit = network.cast(at.place(), {std::cos(angle), std::sin(angle)}, 30);
      if (std::isnan(run.ranges_of(i)[beam])) continue;
      EXPECT_EQ(run.ranges_of(i)[beam], static_cast<float>(hit.range_m));
    }
  }
}

TEST(SimDrive, TheSameSeedGivesTheSameBits) {
  const auto run_of = [](std::uint64_t seed) {
    const Network network(NetworkPlan(), 5);
    return drive(network, network.graph().tour(0, 80, 1), {}, seed);
  };
  const NetworkRun a = run_of(3), b = run_of(3), c = run_of(4);
  ASSERT_EQ(a.ranges.size(), b.ranges.size());
  EXPECT_EQ(std::memcmp(a.ranges.data(), b.ranges.data(), a.ranges.size() * sizeof(float)), 0);
  EXPECT_EQ(a.steps.back().odometry.x_m, b.steps.back().odometry.x_m);
  EXPECT_NE(a.steps.back().odometry.x_m, c.steps.back().odometry.x_m);
}

}  // namespace
}  // namespace pose_wall::tools::sim::drive_test
