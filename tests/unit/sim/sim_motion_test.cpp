// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: scans that take time are distorted by the machine's motion, beam by beam, as a real sensor's are. People walk
// and the machine changes its speed. Rock need not repeat and may be uneven in brightness. Truth has the pose.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "lab/sim/pose.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/simulator.hpp"

namespace pose_wall::tools::sim {
namespace {

// Without noise, and with fewer columns.
SceneSetup still_setup() {
  SceneSetup setup;
  setup.sensor.range_noise_m = 0.0;
  setup.sensor.columns = 256.0;
  return setup;
}

// A point of a frame in the road, seen from where the machine stood so long after the frame's stamp.
Vector in_road(const SceneSetup& setup, const Frame& frame, std::size_t i, double frame_s, double after_s) {
  const float* p = &frame.xyz_intensity[4 * i];
  const Placement at = place(setup, pose_at(setup, frame_s + after_s));
  const Vector p_base = R_base_lidar(setup.mount) * Vector(p[0], p[1], p[2]) + lidar_origin_base(setup.mount);
  return at.R_road_base * p_base + at.origin_road;
}

double mean_x_m(const Frame& frame, Label label) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < frame.count(); ++i) {
    if (frame.labels[i] != label) continue;
    sum += static_cast<double>(frame.xyz_intensity[4 * i]);
    ++count;
  }
  EXPECT_GT(count, 10U);
  return sum / static_cast<double>(count);
}

TEST(SimMotion, EachPointLiesWhereItsBeamWasWhenItFired) {
  SceneSetup setup = still_setup();
  setup.sequence.scan_s = 0.1;
  setup.machine.speed_mps = 1.0;
  setup.machine.turn_rate_dps = 20.0;
  setup.machine.sway_roll_deg = 3.0;
  setup.mount.mount_x_m = 0.7;
  const Frame frame = Simulator(setup, 1).render(4);
  double off_at_once_m = 0.0;
  std::size_t walls = 0;
  for (std::size_t i = 0; i < frame.count(); ++i) {
    if (frame.labels[i] != Label::kWallLeft) continue;
    EXPECT_NEAR(in_road(setup, frame, i, 0.4, 1e-9 * frame.time_ns[i]).y(), 2.5, 2e-5);
    off_at_once_m = std::max(off_at_once_m, std::abs(in_road(setup, frame, i, 0.4, 0.0).y() - 2.5));
    ++walls;
  }
  EXPECT_GT(walls, 2000U);
  EXPECT_GT(off_at_once_m, 0.02) << "taken for one instant, the wall is bent";
}

TEST(SimMotion, PointsComeAsTheyFire) {
  for (const char* sensor : {"vlp16", "os1-64", "mid360"}) {
    SceneSetup setup = make_setup("clean", sensor, false, 1);
    setup.sequence.scan_s = 0.1;
    const Frame frame = Simulator(setup, 1).render(0);
    ASSERT_EQ(frame.time_ns.size(), frame.count());
    ASSERT_EQ(frame.ring.size(), frame.count());
    EXPECT_TRUE(std::is_sorted(frame.time_ns.begin(), frame.time_ns.end())) << sensor;
    EXPECT_LT(frame.time_ns.back(), 100'000'000U) << sensor;
    EXPECT_GT(frame.time_ns.back(), 99'000'000U) << sensor;
    const std::uint16_t top = *std::max_element(frame.ring.begin(), frame.ring.end());
    EXPECT_EQ(top, setup.sensor.rings > 0.0 ? setup.sensor.rings - 1.0 : 0.0) << sensor;
  }
}

TEST(SimMotion, OfAMachineThatStandsTheSamePointsComeInAnotherOrder) {
  const auto sorted_points = [](double scan_s) {
    SceneSetup setup = still_setup();
    setup.sequence.scan_s = scan_s;
    const Frame frame = Simulator(setup, 1).render(2);
    std::vector<std::array<float, 4>> points(frame.count());
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::copy_n(&frame.xyz_intensity[4 * i], 4, points[i].begin());
    }
    std::sort(points.begin(), points.end());
    return points;
  };
  EXPECT_EQ(sorted_points(0.0), sorted_points(0.1));
}

TEST(SimMotion, AtOneInstantAllTimesAreZero) {
  const Frame frame = Simulator(still_setup(), 1).render(1);
  EXPECT_TRUE(std::all_of(frame.time_ns.begin(), frame.time_ns.end(), [](std::uint32_t t) { return t == 0; }));
}

TEST(SimMotion, AScanLongerThanAPeriodIsRefused) {
  SceneSetup setup = still_setup();
  setup.sequence.rate_hz = 20.0;
  setup.sequence.scan_s = 0.051;
  EXPECT_THROW(Simulator(setup, 1), std::invalid_argument);
  setup.sequence.scan_s = 0.05;
  EXPECT_NO_THROW(Simulator(setup, 1));
}

TEST(SimMotion, RockComesAgainAfterATurnOfTheTileOrNot) {
  for (const bool repeats : {true, false}) {
    SceneSetup setup = still_setup();
    setup.rock.roughness_m = 0.05;
    setup.rock.rock_repeats = repeats ? 1.0 : 0.0;
    setup.sequence.rate_hz = 1.0;
    setup.machine.speed_mps = 102.4;  // 205 correlation lengths of 0.5 m: 1,024 cells of 0.1 m
    const Simulator simulator(setup, 3);
    const Frame here = simulator.render(0), there = simulator.render(1);
    double square_m2 = 0.0;
    const std::size_t count = 4 * std::min(here.count(), there.count());
    for (std::size_t i = 0; i < count; ++i) {
      square_m2 += std::pow(static_cast<double>(here.xyz_intensity[i] - there.xyz_intensity[i]), 2);
    }
    const double rms_m = std::sqrt(square_m2 / static_cast<double>(count));
    if (repeats) {
      EXPECT_LT(rms_m, 1e-3);
    } else {
      EXPECT_GT(rms_m, 0.05);
    }
  }
}

TEST(SimMotion, RockThatDoesNotRepeatIsAsRough) {
  SceneSetup setup = still_setup();
  setup.rock.roughness_m = 0.05;
  setup.rock.rock_repeats = 0.0;
  double squares_m2 = 0.0;
  std::size_t count = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Frame frame = Simulator(setup, seed).render(0);
    for (std::size_t i = 0; i < frame.count(); ++i) {
      if (frame.labels[i] != Label::kWallLeft || std::abs(frame.xyz_intensity[4 * i]) > 6.0F) continue;
      squares_m2 += std::pow(static_cast<double>(frame.xyz_intensity[4 * i + 1]) - 2.5, 2);
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(squares_m2 / static_cast<double>(count)), 0.05, 0.008);
}

TEST(SimMotion, PeopleWalkAndVehiclesDrive) {
  SceneSetup setup = still_setup();
  setup.objects.people_side = kSideLeft;
  setup.objects.people_count = 1.0;
  setup.objects.people_speed_mps = -1.5;
  const Simulator people(setup, 1);
  // Seen from the side, the points of a person shift a little over it as it passes.
  EXPECT_NEAR(mean_x_m(people.render(10), Label::kObject) - mean_x_m(people.render(0), Label::kObject), -1.5, 0.2);

  setup.objects.people_side = kSideNone;
  setup.objects.vehicle_side = kSideRight;
  setup.objects.vehicle_at_m = 5.0;
  setup.objects.vehicle_speed_mps = 1.0;
  setup.machine.speed_mps = 1.0;
  const Simulator vehicle(setup, 1);
  EXPECT_NEAR(mean_x_m(vehicle.render(20), Label::kObject), mean_x_m(vehicle.render(0), Label::kObject), 1e-3)
      << "it drives along with the machine";
}

TEST(SimMotion, TheMachineTurnsBack) {
  SceneSetup setup = still_setup();
  setup.machine.speed_mps = 1.0;
  setup.machine.speed_change_at_s = 2.0;
  setup.machine.speed_after_mps = -0.5;
  EXPECT_DOUBLE_EQ(pose_at(setup, 2.0).along_m, 2.0);
  EXPECT_DOUBLE_EQ(pose_at(setup, 4.0).along_m, 1.0);
}

TEST(SimMotion, TextureChangesIntensitiesAlone) {
  SceneSetup setup = still_setup();
  setup.rock.roughness_m = 0.03;
  const Frame even = Simulator(setup, 5).render(0);
  setup.rock.texture = 0.2;
  const Frame uneven = Simulator(setup, 5).render(0);
  ASSERT_EQ(even.count(), uneven.count());
  double sum = 0.0, squares = 0.0, before = 0.0;
  for (std::size_t i = 0; i < even.count(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(even.xyz_intensity[4 * i + axis], uneven.xyz_intensity[4 * i + axis]);
    }
    const auto a = static_cast<double>(even.xyz_intensity[4 * i + 3]);
    const auto b = static_cast<double>(uneven.xyz_intensity[4 * i + 3]);
    before += a;
    sum += b;
    squares += std::pow(b / a - 1.0, 2);
  }
  EXPECT_NEAR(sum / before, 1.0, 0.03);
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(even.count())), 0.2, 0.03);
}

TEST(SimMotion, TruthHasThePoseOfBase) {
  SceneSetup setup = still_setup();
  setup.machine.speed_mps = 2.0;
  setup.machine.turned_left_deg = 30.0;
  setup.machine.lateral_m = 0.25;
  const BasePose pose = Simulator(setup, 1).truth(5).pose.value();
  EXPECT_NEAR(pose[0], 1.0, 1e-12);
  EXPECT_NEAR(pose[1], 0.25, 1e-12);
  EXPECT_NEAR(pose[2], 1.4, 1e-12);
  EXPECT_NEAR(pose[3], 0.0, 1e-12);
  EXPECT_NEAR(pose[4], 0.0, 1e-12);
  EXPECT_NEAR(pose[5], std::sin(M_PI / 12.0), 1e-12);
  EXPECT_NEAR(pose[6], std::cos(M_PI / 12.0), 1e-12);
}

}  // namespace
}  // namespace pose_wall::tools::sim
