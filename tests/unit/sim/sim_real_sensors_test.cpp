// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: a real sensor's points lie on the rock although its light does not leave the origin. They come when its
// lasers fire, in whole steps of its own ranges. Noise by incidence and light, two returns in dust and a window of
// azimuths do what their keys say. While they are off they draw no random number.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "lab/sim/network_scan.hpp"
#include "lab/sim/parameters.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/sensors.hpp"
#include "lab/sim/simulator.hpp"

namespace pose_wall::tools::sim {
namespace {

// Without noise, steps and width of beams: what is left is geometry.
SceneSetup exact_road(const std::string& sensor) {
  SceneSetup setup = make_setup("clean", sensor, false, 1);
  setup.sensor.range_noise_m = setup.sensor.range_quantum_m = setup.sensor.divergence_deg = 0.0;
  setup.mount.mount_roll_deg = 0.0;  // of a sensor that hangs, too: its axes are the road's
  return setup;
}

Vector point(const Frame& frame, std::size_t i) {
  const float* p = &frame.xyz_intensity[4 * i];
  return {p[0], p[1], p[2]};
}

// Of each beam by ring and column.
std::map<std::pair<int, int>, Beam> beams_by_place(const Sensor& sensor) {
  std::map<std::pair<int, int>, Beam> beams;
  for (const Beam& beam : beams_of(sensor, 0)) beams[{beam.ring, beam.step}] = beam;
  return beams;
}

TEST(SimRealSensors, PointsLieOnTheRockAndNotOnRaysFromTheOrigin) {
  for (const SensorModel& model : real_sensor_models()) {
    const std::string& name = model.sensor.name;
    const Frame frame = Simulator(exact_road(name), 1).render(0);
    const auto beams = beams_by_place(model.sensor);
    double farthest_m = 0.0;
    for (std::size_t i = 0; i < frame.count(); ++i) {
      const Vector p = point(frame, i);
      const Label label = frame.labels[i];
      EXPECT_TRUE(label != Label::kWallLeft || std::abs(p.y() - 2.5) < 2e-5) << name << p;
      EXPECT_TRUE(label != Label::kWallRight || std::abs(p.y() + 2.5) < 2e-5) << name << p;
      EXPECT_TRUE(label != Label::kFloor || std::abs(p.z() + 1.4) < 2e-5) << name << p;
      const Beam& beam = beams.at({frame.ring[i], frame.column[i]});
      EXPECT_LT(beam.direction.cross(p - beam.origin).norm(), 2e-5) << name;
      farthest_m = std::max(farthest_m, beam.direction.cross(p).norm());
    }
    EXPECT_GT(frame.count(), 15'000U) << name;
    // A lens that stands along the beam is none to be seen from the side; one above it, or aside, is.
    const double reach_m = model.sensor.beams->reach_m();
    EXPECT_LE(farthest_m, reach_m + 2e-5) << name;
    EXPECT_GE(farthest_m, (model.sensor.beams->lens.azimuth_deg != 0.0 ? 0.2 : 0.05) * reach_m) << name;
  }
}

// By hand: an RS-LiDAR-16's lens 38.25 mm out, a C16's 43.1 mm out and 14.68 degrees behind the head's azimuth.
TEST(SimRealSensors, LightLeavesWhereTheLensIs) {
  const Beam rs16 = beams_by_place(find_sensor("robosense-rs16")->sensor).at({0, 450});
  EXPECT_NEAR(rs16.origin.x(), 0.0, 1e-9) << "a quarter turn: to the right";
  EXPECT_NEAR(rs16.origin.y(), -0.03825, 1e-9);
  EXPECT_NEAR(rs16.direction.y(), -std::cos(15.0 * M_PI / 180.0), 1e-9);
  const Beam c16 = beams_by_place(find_sensor("lslidar-c16-v3")->sensor).at({0, 0});
  EXPECT_NEAR(c16.origin.x(), 0.0431 * std::cos(14.68 * M_PI / 180.0), 1e-9);
  EXPECT_NEAR(c16.origin.y(), 0.0431 * std::sin(14.68 * M_PI / 180.0), 1e-9) << "behind: to the left of what is ahead";
  const Beam vlp16 = beams_by_place(find_sensor("velodyne-vlp16")->sensor).at({15, 0});
  EXPECT_NEAR(vlp16.origin.z(), -0.0112, 1e-12);
  const double turned_rad = 34.56 / 55.296 * 0.2 * M_PI / 180.0;  // laser 15 fires 34.56 us after laser 0
  EXPECT_NEAR(std::atan2(vlp16.direction.y(), vlp16.direction.x()), -turned_rad, 1e-12);
}

TEST(SimRealSensors, RangesComeInStepsOfTheSensorsOwnCount) {
  for (const char* name : {"velodyne-vlp16", "hesai-xt32", "ouster-os1-64", "robosense-rs16"}) {
    SceneSetup setup = make_setup("clean", name, false, 1);
    setup.sensor.columns = std::ceil(setup.sensor.columns / 8.0);
    const Frame frame = Simulator(setup, 1).render(0);
    const auto beams = beams_by_place(setup.sensor);
    const BeamTable& table = *setup.sensor.beams;
    for (std::size_t i = 0; i < frame.count(); ++i) {
      const Beam& beam = beams.at({frame.ring[i], frame.column[i]});
      const double steps = ((point(frame, i) - beam.origin).norm() + table.ahead_m()) / table.ranges.unit_m;
      EXPECT_NEAR(steps, std::round(steps), 0.02) << name << ": coordinates are floats";
    }
  }
}

TEST(SimRealSensors, LasersOfAFiringComeOneAfterTheOther) {
  SceneSetup setup = exact_road("velodyne-vlp16");
  setup.sequence.scan_s = 0.1;
  const Frame frame = Simulator(setup, 1).render(0);
  EXPECT_TRUE(std::is_sorted(frame.time_ns.begin(), frame.time_ns.end()));
  for (std::size_t i = 0; i < frame.count(); ++i) {
    // Rings from below: lasers 0, 2, ... 14, then 1, 3, ... 15.
    const int laser = frame.ring[i] < 8 ? 2 * frame.ring[i] : 2 * (frame.ring[i] - 8) + 1;
    const double wanted_ns = 1e8 / 1800.0 * (frame.column[i] + 2.304 * laser / 55.296);
    EXPECT_NEAR(frame.time_ns[i], wanted_ns, 1.0);
  }
}

TEST(SimRealSensors, TheirBeamsCannotBeSet) {
  SceneSetup setup = make_setup("clean", "hesai-xt32", false, 1);
  set_parameter(setup, "rings=16");
  EXPECT_THROW(Simulator(setup, 1), std::invalid_argument);
  setup = make_setup("clean", "hesai-xt32", false, 1);
  set_parameter(setup, "elevation_min_deg=-20");
  EXPECT_THROW(Simulator(setup, 1), std::invalid_argument);
}

// Boxes and capsules are looked up by the direction of a beam: they must be found from a lens beside the origin.
TEST(SimRealSensors, ThingsAreAsSolidForThemAsForOthers) {
  SceneSetup setup = exact_road("lslidar-c16-v3");
  setup.objects.prop_side = kSideBoth;
  setup.objects.pipe_side = kSideBoth;
  const Frame frame = Simulator(setup, 1).render(0);
  const auto beams = beams_by_place(setup.sensor);
  constexpr double kPropAt_m = 0.3;  // and each metre from there, upright, 0.5 m before the wall
  // A beam that meets the wall passes them all.
  std::size_t passed = 0;
  for (std::size_t i = 0; i < frame.count(); ++i) {
    const Vector p = point(frame, i);
    if (frame.labels[i] != Label::kWallLeft || std::abs(p.x()) > 20.0) continue;
    const Beam& beam = beams.at({frame.ring[i], frame.column[i]});
    const double share = (2.0 - beam.origin.y()) / (p.y() - beam.origin.y());
    const double x = beam.origin.x() + share * (p.x() - beam.origin.x());
    const double slant = beam.direction.y() / std::hypot(beam.direction.x(), beam.direction.y());
    EXPECT_GE(std::abs(std::remainder(x - kPropAt_m, 1.0)) * slant, 0.09 - 1e-5) << "through a prop at " << x;
    ++passed;
  }
  EXPECT_GT(passed, 1000U);
}

double scatter_m(const Frame& frame, Label label, double plane_m, int axis, double from_x_m, double to_x_m) {
  double squares = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < frame.count(); ++i) {
    const Vector p = point(frame, i);
    if (frame.labels[i] != label || std::abs(p.x()) < from_x_m || std::abs(p.x()) > to_x_m) continue;
    // Along the beam: what is off the plane is the range's error times the cosine of its incidence.
    const double cosine = std::abs(p[axis]) / p.norm();
    squares += std::pow((p[axis] - plane_m) / cosine, 2);
    ++count;
  }
  EXPECT_GT(count, 200);
  return std::sqrt(squares / count);
}

TEST(SimNoise, GrowsWithTheIncidenceUpToItsMost) {
  SceneSetup setup = make_setup("clean", "os1-64", false, 1);
  setup.sensor.range_noise_m = 0.01;
  setup.sensor.noise_incidence_m = 0.02;
  const Frame frame = Simulator(setup, 1).render(0);
  // 2.5 m ahead of the foot of the wall's normal the tangent is 1 (rings are nearly level); at 20 m and more it is cut.
  EXPECT_NEAR(scatter_m(frame, Label::kWallLeft, 2.5, 1, 0.0, 0.3), 0.0105, 0.0015);
  EXPECT_NEAR(scatter_m(frame, Label::kWallLeft, 2.5, 1, 2.3, 2.7), std::hypot(0.01, 0.0215), 0.004);
  EXPECT_NEAR(scatter_m(frame, Label::kWallLeft, 2.5, 1, 20.0, 40.0), std::hypot(0.01, 0.1), 0.02);
}

TEST(SimNoise, GrowsWithTheRootOfTheMissingLightUpToItsMost) {
  SceneSetup setup = make_setup("clean", "os1-64", false, 1);
  setup.sensor.range_noise_m = 0.01;
  setup.sensor.noise_dark_most = 1.5;
  const Frame frame = Simulator(setup, 1).render(0);
  EXPECT_NEAR(scatter_m(frame, Label::kWallLeft, 2.5, 1, 0.0, 0.3), 0.01, 0.0015) << "square on: what is stated";
  // At a cosine of 0.4 the light is 0.2 + 0.8 * 0.4 = 0.52: 1.39 times the noise. Farther it would be 2.2 times.
  EXPECT_NEAR(scatter_m(frame, Label::kWallLeft, 2.5, 1, 5.4, 6.0), 0.0139, 0.0015);
  EXPECT_NEAR(scatter_m(frame, Label::kWallLeft, 2.5, 1, 20.0, 40.0), 0.015, 0.0015);
}

TEST(SimDust, TwoReturnsKeepTheRockBehindIt) {
  SceneSetup setup = make_setup("clean", "os1-64", false, 1);
  setup.sensor.range_noise_m = 0.0;
  setup.faults.dust = 0.4;
  setup.faults.dust_range_m = 0.5;
  const Frame one = Simulator(setup, 1).render(0);
  setup.sensor.dual_returns = 1.0;
  const Frame two = Simulator(setup, 1).render(0);
  setup.faults.dust = 0.0;
  const Frame clear = Simulator(setup, 1).render(0);
  const auto dust_of = [](const Frame& frame) {
    return std::count(frame.labels.begin(), frame.labels.end(), Label::kDust);
  };
  EXPECT_GT(dust_of(one), 15'000);
  EXPECT_NEAR(static_cast<double>(dust_of(two)), static_cast<double>(dust_of(one)), 600.0) << "four times its scatter";
  EXPECT_LT(one.count(), clear.count()) << "dust hides what is behind it";
  EXPECT_EQ(two.count() - static_cast<std::size_t>(dust_of(two)), clear.count()) << "all of it is there";
  for (std::size_t i = 1; i < two.count(); ++i) {
    if (two.labels[i - 1] != Label::kDust || two.column[i] != two.column[i - 1]) continue;
    EXPECT_LT(point(two, i - 1).cross(point(two, i)).norm(), 1e-4) << "on one ray";
  }
}

TEST(SimWindow, OnlyItsAzimuthsAreMeasuredAndNothingElseChanges) {
  SceneSetup setup = make_setup("clean", "velodyne-vlp16", false, 1);
  setup.sensor.range_noise_m = 0.0;
  setup.sensor.divergence_deg = 0.0;
  const Frame whole = Simulator(setup, 1).render(0);
  set_parameter(setup, "window_from_deg=-30");
  set_parameter(setup, "window_to_deg=60");
  const Frame part = Simulator(setup, 1).render(0);
  std::size_t next = 0;
  for (std::size_t i = 0; i < whole.count() && next < part.count(); ++i) {
    if (point(whole, i) == point(part, next)) ++next;
  }
  EXPECT_EQ(next, part.count()) << "all of its points are those of the whole turn, in order";
  EXPECT_NEAR(static_cast<double>(beams_of(setup.sensor, 0).size()), 0.25 * 16 * 1800, 32.0);
  for (std::size_t i = 0; i < part.count(); ++i) {
    const double azimuth_deg = std::atan2(point(part, i).y(), point(part, i).x()) * 180.0 / M_PI;
    EXPECT_GE(azimuth_deg, -30.01);
    EXPECT_LE(azimuth_deg, 60.01);
  }
}

TEST(SimNetwork, ARealSensorsLightLeavesItsLens) {
  NetworkPlan plan;
  plan.length_m = 200.0;
  const Network network(plan, 3);
  Sensor sensor = find_sensor("robosense-rs16")->sensor;
  sensor.range_noise_m = 0.0;
  StandingPose pose;
  const Place p = network.graph().edges[1].line[6];
  pose.at = {p.x(), p.y(), 0.7};
  const Frame frame = network_cloud(network, sensor, pose, 0, 1);
  const auto beams = beams_by_place(sensor);
  ASSERT_GT(frame.count(), 10'000U);
  for (std::size_t i = 0; i < frame.count(); ++i) {
    const Beam& beam = beams.at({frame.ring[i], frame.column[i]});
    EXPECT_LT(beam.direction.cross(point(frame, i) - beam.origin).norm(), 2e-5);
  }
}

TEST(SimSensorWindow, AWholeTurnIsAllAround) {
  SceneSetup whole;
  const std::size_t beams = beams_of(whole.sensor, 0).size();
  for (const auto& [from, to] : {std::pair{-180.0, 180.0}, std::pair{0.0, 360.0}, std::pair{-360.0, 360.0}}) {
    whole.sensor.window_from_deg = from;
    whole.sensor.window_to_deg = to;
    EXPECT_EQ(beams_of(whole.sensor, 0).size(), beams) << from;
  }
}

}  // namespace
}  // namespace pose_wall::tools::sim
