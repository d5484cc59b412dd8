// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A machine that stands, or creeps, in a road with a stop: frame by frame, for tests of single answers.

#pragma once

#include <gtest/gtest.h>

#include "planar/encounter/plans.hpp"

namespace pose_wall::test {

// A machine that stands in a road, with a stop that is asked for straight ahead.
class Standing {
 public:
  static constexpr std::int64_t kFrame_ns = 100000000;  // 10 frames a second

  explicit Standing(World world, double confirm_m = 2.5, double memory_s = 60.0) : world_(std::move(world)), draw_(3) {
    sensor_ = Sensor(Pattern::os1_64, 2.0, 1.5, 0.0, 0.28, 1.0, 1024);
    pose_wall_planar_stop_settings settings = encounter_settings();
    settings.confirm_m = confirm_m;
    settings.memory_s = memory_s;
    stop_.open(sensor_, settings);
    confirm();
    motion_.struct_size = sizeof(motion_);
    motion_.given = POSE_WALL_PLANAR_STOP_MEASURED | POSE_WALL_PLANAR_STOP_COMMANDED;
    motion_.command_speed_m_s = 0.05;
  }

  void confirm() { EXPECT_EQ(pose_wall_planar_stop_confirm(stop_.get()), POSE_WALL_OK); }
  // Where it looks, from along the road to the left. Before the first frame.
  void turn(double yaw_rad) { yaw_rad_ = yaw_rad; }
  void take() { scan_.take(sensor_, world_, x_m_, 0.0, yaw_rad_, 0.0, 0.0, &draw_); }
  pose_wall_planar_stop_result frame() {
    take();
    return again();
  }
  // The last cloud once more, with a new stamp.
  pose_wall_planar_stop_result again() {
    stamp_ns_ += kFrame_ns;
    const pose_wall_cloud cloud = scan_.cloud(stamp_ns_);
    EXPECT_EQ(pose_wall_planar_stop_process(stop_.get(), &cloud, &motion_, stamp_ns_ + 1000000, &stop_.result()),
              POSE_WALL_OK);
    return stop_.result();
  }
  pose_wall_planar_stop_result frames(int count) {
    for (int k = 0; k < count; ++k) frame();
    return stop_.result();
  }
  // Straight ahead, or back where metres are negative; then it stands again.
  void drive(double metres) {
    constexpr int kFrames = 30;
    constexpr double kFrame_s = 1e-9 * kFrame_ns;
    for (int k = 0; k <= kFrames; ++k) {
      const double before_m_s = motion_.speed_m_s;
      motion_.speed_m_s = k < kFrames ? metres / (kFrames * kFrame_s) : 0.0;
      x_m_ += 0.5 * (before_m_s + motion_.speed_m_s) * kFrame_s;
      frame();
    }
  }
  // The clock of stamps and calls.
  void set_clock(std::int64_t by_ns) { stamp_ns_ += by_ns; }
  pose_wall_planar_stop_result tick_after(std::int64_t after_ns) {
    EXPECT_EQ(pose_wall_planar_stop_tick(stop_.get(), stamp_ns_ + after_ns, &stop_.result()), POSE_WALL_OK);
    return stop_.result();
  }

  World& world() { return world_; }
  Scan& scan() { return scan_; }
  Sensor& sensor() { return sensor_; }
  StopUnderTest& stop() { return stop_; }
  pose_wall_planar_stop_motion& motion() { return motion_; }
  std::int64_t stamp_ns() const { return stamp_ns_; }

 private:
  World world_;
  double x_m_ = 0.0, yaw_rad_ = 0.0;
  Draw draw_;
  Sensor sensor_;
  Scan scan_;
  StopUnderTest stop_;
  pose_wall_planar_stop_motion motion_{};
  std::int64_t stamp_ns_ = 1000000000;
};

inline World plain_road(double half_width_m = 3.0) {
  World world;
  world.half_width_m = half_width_m, world.wall_wave_m = 0.02;
  return world;
}

}  // namespace pose_wall::test
