// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Truth against planes fitted to the very points of noiseless frames, by the specification's formulas written out
// once more here; and against hand-computed numbers where walls are no planes.

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>

#include "lab/sim/pose.hpp"
#include "lab/sim/simulator.hpp"

namespace pose_wall::tools::sim {
namespace {

struct Fitted {
  Vector n;
  double d;
};

// Plane through a label's points in base, turned by R; the normal points to the origin.
Fitted fit(const SceneSetup& setup, const Frame& frame, Label label, const Matrix& R) {
  std::vector<Vector> points;
  Vector mean = Vector::Zero();
  for (std::size_t i = 0; i < frame.count(); ++i) {
    if (frame.labels[i] != label) continue;
    const float* p = &frame.xyz_intensity[4 * i];
    points.push_back(R * (R_base_lidar(setup.mount) * Vector(p[0], p[1], p[2]) + lidar_origin_base(setup.mount)));
    mean += points.back();
  }
  mean /= static_cast<double>(points.size());
  Matrix scatter = Matrix::Zero();
  for (const Vector& p : points) scatter += (p - mean) * (p - mean).transpose();
  Vector n = Eigen::SelfAdjointEigenSolver<Matrix>(scatter).eigenvectors().col(0);
  if (n.dot(mean) > 0.0) n = -n;
  return {n, -n.dot(mean)};
}

// Sections "Frames and signs" of the specification.
std::array<double, 7> by_the_book(const SceneSetup& setup, const Frame& frame) {
  const Fitted floor = fit(setup, frame, Label::kFloor, Matrix::Identity());
  std::array<double, 7> value{};
  value[0] = std::atan2(floor.n.y(), floor.n.z());
  value[1] = std::atan2(-floor.n.x(), std::hypot(floor.n.y(), floor.n.z()));
  const Matrix R_level = rotation_y(value[1]) * rotation_x(value[0]);
  const Vector forward = R_level * forward_axis(setup.machine);
  std::size_t q = 3;
  for (const Label label : {Label::kWallLeft, Label::kWallRight}) {
    const Fitted wall = fit(setup, frame, label, R_level);
    Vector t = Vector::UnitZ().cross(wall.n).normalized();
    if (t.dot(forward) < 0.0) t = -t;
    value[2] += 0.5 * std::atan2(forward.x() * t.y() - forward.y() * t.x(), forward.x() * t.x() + forward.y() * t.y());
    for (const double s : {setup.machine.s_front_m, setup.machine.s_back_m}) {
      value[q++] = std::abs(wall.n.dot(R_level * (s * forward_axis(setup.machine))) + wall.d);
    }
  }
  return value;
}

void expect_truth_fits(const SceneSetup& setup) {
  const Simulator simulator(setup, 3);
  const std::array<double, 7> book = by_the_book(setup, simulator.render(0));
  const TruthRow truth = simulator.truth(0);
  for (std::size_t q = 0; q < 7; ++q) EXPECT_NEAR(truth.value[q], book[q], 2e-5) << "quantity " << q;
}

SceneSetup tilted_setup(double axis) {
  SceneSetup setup;
  setup.sensor.range_noise_m = 0.0;
  setup.machine.forward_axis = axis;
  setup.machine.roll_deg = 10.0;
  setup.machine.pitch_deg = -15.0;
  setup.machine.turned_left_deg = 30.0;
  setup.machine.lateral_m = 0.4;
  setup.mount.mount_x_m = 0.5;
  setup.mount.mount_y_m = -0.3;
  setup.mount.mount_z_m = 0.2;
  setup.mount.mount_roll_deg = 4.0;
  setup.mount.mount_pitch_deg = -7.0;
  setup.mount.mount_yaw_deg = 100.0;
  return setup;
}

TEST(SimTruth, FitsThePlanesForAllAxesAndTilts) {
  for (const double axis : {0.0, 1.0, 2.0, 3.0}) {
    SCOPED_TRACE(axis);
    expect_truth_fits(tilted_setup(axis));
  }
}

TEST(SimTruth, FitsLeaningWallsAndCrossFall) {
  for (const double axis : {0.0, 1.0, 2.0, 3.0}) {
    SCOPED_TRACE(axis);
    SceneSetup setup = tilted_setup(axis);
    setup.road.lean_left_deg = 9.0;
    setup.road.lean_right_deg = -6.0;
    setup.road.cross_fall_deg = 7.0;
    setup.road.slope_deg = 5.0;
    expect_truth_fits(setup);
  }
}

TEST(SimTruth, FitsAnUpsideDownSensor) {
  SceneSetup setup = tilted_setup(0.0);
  setup.mount.mount_roll_deg = 180.0;
  expect_truth_fits(setup);
}

TEST(SimTruth, TurnedLeftReportsNegativeYawAndALessDistantLeftFront) {
  SceneSetup setup;
  setup.machine.turned_left_deg = 5.0;
  const TruthRow truth = Simulator(setup, 1).truth(0);
  EXPECT_NEAR(truth.value[2], -5.0 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(truth.value[3], 2.5 - 2.0 * std::sin(5.0 * kRadPerDeg), 1e-12);
  EXPECT_NEAR(truth.value[6], 2.5 - 2.0 * std::sin(5.0 * kRadPerDeg), 1e-12);
}

TEST(SimTruth, MissingWallsHaveNone) {
  SceneSetup setup;
  setup.road.walls = kSideLeft;
  const TruthRow truth = Simulator(setup, 1).truth(0);
  EXPECT_FALSE(std::isnan(truth.value[3]) || std::isnan(truth.value[4]));
  EXPECT_TRUE(std::isnan(truth.value[5]) && std::isnan(truth.value[6]));
}

TEST(SimTruth, CurvedWallsAreMeasuredTowardsTheCentre) {
  SceneSetup setup;
  setup.road.curve_radius_m = 30.0;
  const TruthRow truth = Simulator(setup, 1).truth(0);
  const double from_centre = std::hypot(2.0, 30.0);
  for (const std::size_t left : {3u, 4u}) EXPECT_NEAR(truth.value[left], from_centre - 27.5, 1e-6);
  for (const std::size_t right : {5u, 6u}) EXPECT_NEAR(truth.value[right], 32.5 - from_centre, 1e-6);
}

TEST(SimTruth, ArchIsMeasuredAtTheHeightOfTheBaseOrigin) {
  SceneSetup setup;
  setup.road.arch_springing_m = 1.0;
  setup.machine.base_height_m = 1.8;
  const TruthRow truth = Simulator(setup, 1).truth(0);
  EXPECT_NEAR(truth.value[3], 2.5 * std::sqrt(1.0 - std::pow(0.8 / 2.5, 2)), 1e-6);
}

// The other wall, nearer to the left or right of the machine itself, is not this side's.
TEST(SimTruth, AWallIsTheRoadsHoweverFarTheMachineIsTurned) {
  for (const double turned_deg : {-40.0, 25.0, 40.0}) {
    SceneSetup setup;
    setup.road.arch_springing_m = 1.3;
    setup.machine.turned_left_deg = turned_deg;
    setup.machine.lateral_m = -1.0;
    const TruthRow arch = Simulator(setup, 1).truth(0);
    const double across_m = 2.0 * 2.5 * std::sqrt(1.0 - std::pow((setup.machine.base_height_m - 1.3) / 2.5, 2));
    EXPECT_NEAR(arch.value[3] + arch.value[5], across_m, 2e-3) << turned_deg;
    EXPECT_NEAR(arch.value[4] + arch.value[6], across_m, 2e-3) << turned_deg;
    setup.road.arch_springing_m = 0.0;
    setup.road.curve_radius_m = 200.0;
    const TruthRow curved = Simulator(setup, 1).truth(0);
    EXPECT_NEAR(curved.value[3] + curved.value[5], 5.0, 0.05) << turned_deg;
    EXPECT_NEAR(curved.value[4] + curved.value[6], 5.0, 0.05) << turned_deg;
  }
}

TEST(SimTruth, YawIsTheMeanDirectionOfWallsThatSplayDifferently) {
  SceneSetup setup = tilted_setup(0.0);
  setup.road.splay_left_deg = 8.0;
  setup.road.splay_right_deg = -3.0;
  setup.road.lean_left_deg = 5.0;
  setup.road.cross_fall_deg = 6.0;
  expect_truth_fits(setup);

  SceneSetup level;
  level.road.splay_left_deg = 8.0;
  level.road.splay_right_deg = -3.0;
  level.machine.turned_left_deg = 2.0;
  EXPECT_NEAR(Simulator(level, 1).truth(0).value[2], ((8.0 + 3.0) / 2.0 - 2.0) * kRadPerDeg, 1e-12);
  level.road.walls = kSideRight;
  EXPECT_NEAR(Simulator(level, 1).truth(0).value[2], (3.0 - 2.0) * kRadPerDeg, 1e-12);
  level.road.walls = kSideNone;
  EXPECT_TRUE(std::isnan(Simulator(level, 1).truth(0).value[2]));
}

TEST(SimTruth, StepsAreMeasuredSquareOrToTheNearestRock) {
  SceneSetup setup;
  setup.openings.widening_side = kSideLeft;
  setup.openings.widening_at_m = 1.0;
  setup.openings.widening_m = 3.0;
  setup.openings.narrow_side = kSideRight;
  setup.openings.narrow_at_m = 1.0;
  setup.openings.narrow_depth_m = 0.4;
  const Simulator simulator(setup, 1);
  const TruthRow square = simulator.truth(0);
  const TruthRow nearest = simulator.truth(0, StepRule::kNearest);
  EXPECT_NEAR(square.value[3], 5.5, 1e-6);
  EXPECT_NEAR(nearest.value[3], std::hypot(1.0, 2.5), 1e-4);  // the corner is nearer than the wall behind it
  for (const TruthRow& truth : {square, nearest}) {
    EXPECT_NEAR(truth.value[4], 2.5, 1e-6);
    EXPECT_NEAR(truth.value[5], 2.1, 1e-6);
    EXPECT_NEAR(truth.value[6], 2.5, 1e-6);
  }
}

TEST(SimTruth, NicheCountsBeforeTheFaceAndNotBeyondIt) {
  SceneSetup setup;
  setup.road.face_distance_m = 3.0;
  setup.road.face_niche_m = 1.5;
  setup.road.face_extra_width_m = 0.7;
  const TruthRow before = Simulator(setup, 1).truth(0);
  EXPECT_NEAR(before.value[3], 3.2, 1e-6);
  EXPECT_NEAR(before.value[4], 2.5, 1e-6);
  setup.road.face_distance_m = 1.5;
  EXPECT_NEAR(Simulator(setup, 1).truth(0).value[3], 2.5, 1e-6);
}

TEST(SimTruth, NearSidePlacesTheMachineByItsWall) {
  SceneSetup setup;
  setup.machine.near_side = kSideRight;
  setup.machine.near_distance_m = 0.6;
  setup.machine.drift_mps = 0.1;
  const TruthRow truth = Simulator(setup, 1).truth(10);
  EXPECT_NEAR(truth.value[5], 0.7, 1e-12);
  EXPECT_NEAR(truth.value[3], 4.3, 1e-12);
}

TEST(SimTruth, FollowsTheMotion) {
  SceneSetup setup;
  setup.machine.drift_mps = 0.1;
  setup.machine.turn_rate_dps = 2.0;
  setup.machine.sway_roll_deg = 1.0;
  const Simulator simulator(setup, 1);
  const TruthRow truth = simulator.truth(10);
  EXPECT_NEAR(truth.value[0], std::sin(2.0 * M_PI / 4.0) * kRadPerDeg, 1e-12);
  EXPECT_NEAR(truth.value[2], -2.0 * kRadPerDeg, 1e-12);
  EXPECT_NEAR(truth.value[4] + truth.value[6], 5.0, 0.3);
  EXPECT_EQ(truth.stamp_ns - simulator.truth(0).stamp_ns, 1000000000);
}

}  // namespace
}  // namespace pose_wall::tools::sim
