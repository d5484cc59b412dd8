// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the stop stops on points that came before, a person or not. A driver that hands out a ring of old clouds, or
// leaves old points where packets were lost, hides nobody, and a machine that obeys touches nobody.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "planar/encounter/plans.hpp"
#include "pose_wall_planar.h"

namespace {

using namespace pose_wall::test;

constexpr std::int64_t kPeriod_ns = 100000000;

using Cloud = std::vector<float>;

// A machine in a road, whose driver may deliver what it likes.
class FreshRoad {
 public:
  explicit FreshRoad(const Sensor& of = {Pattern::os1_64, 2.0, 1.5, 0.0, 0.28, 1.0, 1024}) : sensor(of), draw_(3) {
    world.half_width_m = 3.0;
    world.wall_wave_m = 0.02;
    stop_.open(sensor, encounter_settings());
    EXPECT_EQ(pose_wall_planar_stop_confirm(stop_.get()), POSE_WALL_OK);
    motion_.struct_size = sizeof(motion_);
    motion_.given = POSE_WALL_PLANAR_STOP_MEASURED | POSE_WALL_PLANAR_STOP_COMMANDED;
  }

  Cloud look(double x_m = 0.0) {
    scan_.take(sensor, world, x_m, 0.0, 0.0, 0.0, 0.0, &draw_);
    return scan_.points();
  }
  pose_wall_planar_stop_result give(const Cloud& points, double speed_m_s = 0.0,
                                    const pose_wall_inputs* inputs = nullptr) {
    stamp_ns_ += kPeriod_ns;
    pose_wall_cloud cloud = scan_.cloud(stamp_ns_);
    cloud.data = points.data();
    cloud.inputs = inputs;
    motion_.speed_m_s = speed_m_s;
    motion_.command_speed_m_s = std::max(speed_m_s, 0.05);
    EXPECT_EQ(pose_wall_planar_stop_process(stop_.get(), &cloud, &motion_, stamp_ns_ + 1000000, &stop_.result()),
              POSE_WALL_OK);
    return stop_.result();
  }

  World world;
  Sensor sensor;

 private:
  Draw draw_;
  Scan scan_;
  StopUnderTest stop_;
  pose_wall_planar_stop_motion motion_{};
  std::int64_t stamp_ns_ = 1000000000;
};

bool stops_as_frozen(const pose_wall_planar_stop_result& result) {
  return result.state == POSE_WALL_PLANAR_STOP_STOP && (result.reasons & POSE_WALL_PLANAR_STOP_R_FROZEN) != 0;
}

TEST(StopFreshness, ARingOfOldCloudsHidesNobody) {
  for (const std::size_t ring : {std::size_t{1}, std::size_t{2}, std::size_t{8}, std::size_t{64}}) {
    FreshRoad road;
    for (int k = 0; k < 30; ++k) road.give(road.look());
    std::vector<Cloud> clouds;
    pose_wall_planar_stop_result live{};
    for (std::size_t k = 0; k < ring; ++k) {
      clouds.push_back(road.look());
      live = road.give(clouds.back());
    }
    ASSERT_EQ(live.state, std::uint32_t{POSE_WALL_PLANAR_STOP_GO}) << "or the test shows nothing";
    road.world.things.push_back(round_thing(3.2, 0.2, 0.2, -0.1, 1.7));
    for (std::size_t k = 0; k < ring + 20; ++k) {
      ASSERT_TRUE(stops_as_frozen(road.give(clouds[k % ring]))) << ring << " clouds, repeat " << k;
    }
    road.world.things.clear();
    for (int k = 0; k < 60; ++k) live = road.give(road.look());
    EXPECT_EQ(live.state, std::uint32_t{POSE_WALL_PLANAR_STOP_GO}) << "fresh clouds";
  }
}

TEST(StopFreshness, OldPointsOfLostPacketsHideNobody) {
  for (const double half_rad : {0.09, 0.3, 1.57}) {
    FreshRoad road;
    for (int k = 0; k < 29; ++k) road.give(road.look());
    const Cloud old = road.look();
    ASSERT_EQ(road.give(old).state, std::uint32_t{POSE_WALL_PLANAR_STOP_GO});
    road.world.things.push_back(round_thing(3.2, 0.2, 0.2, -0.1, 1.7));
    const auto& directions = Directions::of(road.sensor);
    for (int k = 0; k < 30; ++k) {
      Cloud points = road.look();
      for (std::size_t i = 0; i < directions.size(); ++i) {
        if (!(std::fabs(std::atan2(directions[i].y, directions[i].x)) < half_rad)) continue;
        std::copy_n(old.begin() + static_cast<std::ptrdiff_t>(4 * i), 4,
                    points.begin() + static_cast<std::ptrdiff_t>(4 * i));
      }
      ASSERT_TRUE(stops_as_frozen(road.give(points))) << half_rad << " rad, frame " << k;
    }
  }
}

// A packet is a slice of the sensor's own azimuth, however the sensor is mounted.
TEST(StopFreshness, ASliceIsKnownWhereverItLiesUnderAnyMount) {
  for (const auto& [roll_rad, pitch_rad] : {std::pair{0.0, 0.0}, {0.0, 0.28}, {0.3, 0.6}, {1.5, 0.0}}) {
    for (int degrees = -175; degrees < 180; degrees += 25) {
      FreshRoad road({Pattern::os1_64, 2.0, 1.5, roll_rad, pitch_rad, 3.15, 1024});
      const Cloud old = road.look();
      road.give(old);
      const double from_rad = degrees * 0.0174533, wide_rad = 10.0 * 0.0174533;
      const auto& directions = Directions::of(road.sensor);
      Cloud points = road.look();
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const double away_rad = std::remainder(std::atan2(directions[i].y, directions[i].x) - from_rad, 6.2831853);
        if (!(away_rad >= 0.0 && away_rad < wide_rad)) continue;
        std::copy_n(old.begin() + static_cast<std::ptrdiff_t>(4 * i), 4,
                    points.begin() + static_cast<std::ptrdiff_t>(4 * i));
      }
      EXPECT_TRUE(stops_as_frozen(road.give(points)))
          << "from " << degrees << " degrees, mount " << roll_rad << ", " << pitch_rad;
    }
  }
}

// The driver hangs when a person is less than 3 m ahead.
TEST(StopFreshness, AMachineThatObeysTouchesNobody) {
  for (const double wish_m_s : {0.3, 0.9}) {
    for (const std::size_t ring : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{64}}) {
      FreshRoad road;
      road.world.things.push_back(round_thing(10.0, 0.1, 0.2, -0.1, 1.7));
      std::vector<Cloud> clouds;
      double x_m = 0.0, speed_m_s = 0.0;
      std::size_t hung = 0;
      for (int k = 0; k < 300; ++k) {
        x_m += 0.1 * speed_m_s;
        const double room_m = 9.8 - (x_m + 2.25);
        ASSERT_GT(room_m, 0.0) << wish_m_s << " m/s, ring of " << ring;
        if (hung > 0 || (room_m < 3.0 && speed_m_s > 0.2)) ++hung;
        if (hung == 0) {
          clouds.push_back(road.look(x_m));
          if (clouds.size() > ring) clouds.erase(clouds.begin());
        }
        const auto result = road.give(hung > 0 ? clouds[(hung - 1) % clouds.size()] : clouds.back(), speed_m_s);
        const bool stops = result.state == POSE_WALL_PLANAR_STOP_STOP;
        const double allowed_m_s = stops ? 0.0 : std::min(wish_m_s, result.allowed_speed_m_s);
        speed_m_s += std::clamp(allowed_m_s - speed_m_s, -0.1, 0.1);
      }
      EXPECT_GT(hung, 100U) << "or it never hung";
      EXPECT_EQ(speed_m_s, 0.0);
    }
  }
}

// The boom swings into the way, and the frame tells where it is.
TEST(StopFreshness, WhatAFrameTellsOfTheMachineIsNoThing) {
  FreshRoad road;
  for (int k = 0; k < 30; ++k) road.give(road.look());
  road.world.things.push_back(round_thing(3.2, 0.0, 0.2, 0.0, 1.7));
  pose_wall_inputs inputs{};
  inputs.struct_size = sizeof inputs;
  const double box_m[6] = {2.9, 3.5, -0.3, 0.3, -2.0, 2.0};
  std::copy_n(box_m, 6, inputs.body_box[0]);
  const auto of_machine = road.give(road.look(), 0.0, &inputs);
  EXPECT_EQ(of_machine.reasons & POSE_WALL_PLANAR_STOP_R_THING, 0U);
  const auto of_nobody = road.give(road.look());
  EXPECT_NE(of_nobody.reasons & POSE_WALL_PLANAR_STOP_R_THING, 0U) << "or the test shows nothing";
}

}  // namespace
