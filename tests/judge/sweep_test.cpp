// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: drives stay in their road; a scan that takes its time is bent as its machine moved, by the times that its
// cloud tells; light leaves a real sensor where its manual says.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "judge/text.hpp"
#include "judge/trial.hpp"

namespace pose_wall::judge {
namespace {

struct Scene {
  explicit Scene(std::uint64_t seed, int sensor, Furnishing furnishing)
      : draw(seed),
        road(draw_road(seed, furnishing)),
        machine(draw_machine(road, sensor_at(sensor).hung, &draw)),
        scanner(sensor_at(sensor), true, &draw),
        stance(draw_stance(road, furnishing == Furnishing::kQuiet, &draw)) {}

  Draw draw;
  Road road;
  Machine machine;
  Scanner scanner;
  Stance stance;
};

TEST(JudgesDrives, StayInTheirRoadAndBeforeItsEndAndHalfOfThemStand) {
  constexpr int kRoads = 400, kFrames = 20;
  int stand = 0, quick = 0;
  for (std::uint64_t seed = 0; seed < kRoads; ++seed) {
    Scene scene(seed, 0, Furnishing::kDrawn);
    const Drive drive = draw_drive(scene.road, scene.machine, scene.stance, Going::kDrawn, kFrames, &scene.draw);
    const Pace pace = drive.pace();
    stand += pace.ahead_m_s == 0.0 ? 1 : 0;
    quick += pace.ahead_m_s > 1.0 ? 1 : 0;
    EXPECT_LE(pace.ahead_m_s, 5.0);
    EXPECT_LE(pace.turn_rad_s, kRadPerDeg * 5.0);
    const Stance& last = drive.stances.back();
    const bool at_its_end = last.x_m + scene.machine.s_front_m >= scene.road.room_ahead_m;
    EXPECT_FALSE(pace.ahead_m_s > 0.0 && at_its_end) << seed;
    EXPECT_GT(truth_of(scene.road, scene.machine, last.pose(scene.road, scene.machine)).low[POSE_WALL_D_LF], 0.0);
    for (const double y_m : {last.y_m - kHalfWidth_m, last.y_m + kHalfWidth_m}) {
      EXPECT_LT(std::abs(y_m), 0.5 * scene.road.width_m) << seed;
    }
  }
  // Of 400 chances of a half, within four sigma; some of the others have no room. A fifth drives quickly, at least.
  EXPECT_GT(stand, 160);
  EXPECT_LT(stand, 280);
  EXPECT_GT(quick, 80);
}

TEST(JudgesDrives, TheMotionWithinAScanEndsAtTheNextStamp) {
  Scene scene(7, 0, Furnishing::kQuiet);
  const Drive drive = draw_drive(scene.road, scene.machine, scene.stance, Going::kDrives, 2, &scene.draw);
  const Passage first(scene.road, scene.machine, drive.stances[0], drive.stances[1]);
  const Passage second(scene.road, scene.machine, drive.stances[1], drive.stances[2]);
  EXPECT_GT(drive.pace().ahead_m_s, 0.0);
  EXPECT_TRUE(first.at(1.0).turn.isApprox(second.at(0.0).turn, 1e-12));
  EXPECT_TRUE(first.at(1.0).position_m.isApprox(second.at(0.0).position_m, 1e-12));
  const Matrix3d middle = first.at(0.4567).turn;
  EXPECT_TRUE((middle * middle.transpose()).isIdentity(1e-7));
}

double median_off_planes_m(const Scene& scene, const Cloud& cloud, const Passage& passage, bool freed) {
  std::vector<double> off_m;
  for (const Point& point : cloud.points) {
    const Vector3d sensor_m(point.x_m, point.y_m, point.z_m);
    if (!(sensor_m.norm() > 0.5 && sensor_m.norm() < 15.0)) continue;
    const Vector3d base_m = scene.machine.mounting.turn() * sensor_m + scene.machine.mounting.position_base_m;
    const Vector3d world_m = passage.at(freed ? 1e-8 * point.after_ns : 0.0).to_world(base_m);
    for (const Plane& plane : {scene.road.floor, scene.road.left, scene.road.right}) {
      if (std::abs(plane.distance_m(world_m)) < 0.3) off_m.push_back(std::abs(plane.distance_m(world_m)));
    }
  }
  EXPECT_GT(off_m.size(), 5000U);
  return quantile(off_m, 0.5);
}

// Half of a normal distribution lies within 0.67 sigma, and 12 mm of noise along a ray are less across a plane: freed
// of the motion, half of the points lie within 8 mm of a quiet road's planes. A turn by 2 degrees in a scan, more than
// a driver makes, moves what is 5 m away by up to 170 mm.
TEST(JudgesSweeps, AreFreedOfTheirMotionByTheTimesThatTheyTell) {
  Scene scene(11, sensor_row("os1_64_beams"), Furnishing::kQuiet);
  scene.stance = Stance();
  Stance next;
  next.x_m = 0.5;
  next.turned_left_rad = 2.0 * kRadPerDeg;
  next.nose_down_rad = 0.5 * kRadPerDeg;
  const Passage passage(scene.road, scene.machine, scene.stance, next);
  const Cloud cloud = scene.scanner.sweep(scene.road, scene.machine, passage, 0, &scene.draw);
  EXPECT_TRUE(cloud.timed);
  EXPECT_LT(median_off_planes_m(scene, cloud, passage, true), 0.008);
  EXPECT_GT(median_off_planes_m(scene, cloud, passage, false), 0.016);
}

// How far before the axis, and how far above the origin, the light of a ring leaves: from what its
// points lack on a cone of its elevation.
void expect_offsets(const char* sensor, int ring, double elevation_deg, double lens_m, double up_m) {
  Scene scene(3, sensor_row(sensor), Furnishing::kQuiet);
  const Passage rest(scene.road, scene.machine, scene.stance, scene.stance);
  const Cloud cloud = scene.scanner.sweep(scene.road, scene.machine, rest, 0, &scene.draw);
  double sum_m = 0.0;
  int points = 0;
  for (const Point& point : cloud.points) {
    if (point.ring != static_cast<std::uint32_t>(ring) || !(std::hypot(point.x_m, point.y_m) > 0.5F)) continue;
    // Noise moves a point along its ray alone, so that every point of a ring lies on its cone.
    sum_m += point.z_m - (std::hypot(point.x_m, point.y_m) - lens_m) * std::tan(kRadPerDeg * elevation_deg);
    ++points;
  }
  ASSERT_GT(points, 300) << sensor;
  EXPECT_NEAR(sum_m / points, up_m, 2e-5) << sensor << " ring " << ring;
}

TEST(JudgesBeams, LeaveTheSensorWhereItsManualSays) {
  expect_offsets("vlp16_beams", 0, -15.0, 0.0, 0.0112);
  expect_offsets("vlp16_beams", 2, -11.0, 0.0, 0.0081);
  expect_offsets("vlp16_beams", 15, 15.0, 0.0, -0.0112);
  expect_offsets("hdl32_beams", 31, 32.0 / 3.0, 0.0, 0.0);
  expect_offsets("xt32", 0, -16.0, 0.0, 0.0);
  expect_offsets("rs16", 0, -15.0, 0.03825, 0.0);
  expect_offsets("os0_128_beams", 127, 45.0, 0.02767, 0.0);
}

TEST(JudgesBeams, FireInTheOrderOfTheirManual) {
  const Beams& puck = vlp16_beams();
  ASSERT_EQ(puck.lasers.size(), 16U);
  EXPECT_EQ(puck.lasers[3].elevation_deg, 3.0);
  EXPECT_EQ(puck.lasers[15].elevation_deg, 15.0);
  EXPECT_NEAR(puck.lasers[15].after_us, 34.560, 1e-9);
  EXPECT_EQ(puck.lasers[0].ring, 0);
  EXPECT_NEAR(hdl32_beams().lasers[1].elevation_deg, -9.33, 0.01);
  EXPECT_NEAR(hdl32_beams().lasers[31].elevation_deg, 10.67, 0.01);
}

}  // namespace
}  // namespace pose_wall::judge
