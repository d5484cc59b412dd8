// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A drive in a drawn network of roads, and SLAM in a block of garbage that takes its scans.

#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <vector>

#include "lab/sim/drive_route.hpp"
#include "pose_wall_planar_slam.h"

namespace pose_wall::planar_test {

namespace sim = pose_wall::tools::sim;

inline sim::NetworkRun driven(const sim::NetworkPlan& plan, double metres, std::uint64_t seed) {
  const sim::Network network(plan, seed);
  const sim::Route route = network.graph().tour(0, metres, seed);
  return sim::drive(network, route, sim::RunSettings(), seed);
}

// A road, driven there and back once or more.
inline sim::NetworkPlan small_plan() {
  sim::NetworkPlan plan;
  plan.length_m = 150.0;
  plan.roads = 2;
  return plan;
}

inline pose_wall_planar_scan scan_of(const sim::NetworkRun& run, std::size_t i) {
  pose_wall_planar_scan scan{};
  scan.struct_size = sizeof(scan);
  scan.beams = static_cast<std::uint32_t>(run.sensor.beams);
  scan.stamp_ns = static_cast<std::int64_t>(run.at_scan(i).time_s * 1e9);
  scan.angle_min_rad = run.sensor.angle_min_rad();
  scan.angle_step_rad = run.sensor.angle_step_rad();
  scan.range_min_m = run.sensor.range_min_m;
  scan.range_max_m = run.sensor.range_max_m;
  scan.sigma_m = run.sensor.noise_m;
  scan.range_m = run.ranges_of(i);
  return scan;
}

inline pose_wall_planar_pose pose_of(const sim::PlanePose& pose) {
  return {pose.x_m, pose.y_m, pose.yaw_rad};
}

// b in the frame of a.
inline pose_wall_planar_pose step_between(const pose_wall_planar_pose& a, const pose_wall_planar_pose& b) {
  const double c = std::cos(a.yaw_rad), s = std::sin(a.yaw_rad), dx = b.x_m - a.x_m, dy = b.y_m - a.y_m;
  return {c * dx + s * dy, c * dy - s * dx, std::remainder(b.yaw_rad - a.yaw_rad, 2.0 * 3.14159265358979)};
}

inline double apart_m(const pose_wall_planar_pose& a, const pose_wall_planar_pose& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

class OpenedSlam {
 public:
  explicit OpenedSlam(std::uint32_t keyframes_most = 2048, int garbage = 0xA5) {
    pose_wall_planar_slam_settings settings;
    EXPECT_EQ(pose_wall_planar_slam_settings_init(&settings), POSE_WALL_OK);
    settings.keyframes_most = keyframes_most;
    EXPECT_EQ(pose_wall_planar_slam_memory_needed(&settings, &bytes_), POSE_WALL_OK);
    block_.reset(std::aligned_alloc(POSE_WALL_BLOCK_ALIGNMENT, bytes_));
    std::memset(block_.get(), garbage, bytes_);
    EXPECT_EQ(pose_wall_planar_slam_open(&settings, block_.get(), bytes_, &slam_), POSE_WALL_OK);
  }

  pose_wall_planar_slam* get() const { return slam_; }
  std::uint64_t bytes() const { return bytes_; }

  pose_wall_planar_slam_result process(const sim::NetworkRun& run, std::size_t i, bool with_odometry = true) const {
    pose_wall_planar_slam_result result{};
    result.struct_size = sizeof(result);
    const pose_wall_planar_scan scan = scan_of(run, i);
    const pose_wall_planar_pose odometry = pose_of(run.at_scan(i).odometry);
    EXPECT_EQ(pose_wall_planar_slam_process(slam_, &scan, with_odometry ? &odometry : nullptr, &result), POSE_WALL_OK);
    return result;
  }

  pose_wall_planar_keyframe keyframe(std::uint32_t k) const {
    pose_wall_planar_keyframe keyframe{};
    keyframe.struct_size = sizeof(keyframe);
    EXPECT_EQ(pose_wall_planar_slam_keyframe(slam_, k, &keyframe), POSE_WALL_OK);
    return keyframe;
  }

  std::vector<unsigned char> saved() const {
    std::uint64_t bytes = 0, written = 0;
    EXPECT_EQ(pose_wall_planar_slam_save_bytes(slam_, &bytes), POSE_WALL_OK);
    std::vector<unsigned char> out(bytes);
    EXPECT_EQ(pose_wall_planar_slam_save(slam_, out.data(), bytes, &written), POSE_WALL_OK);
    EXPECT_EQ(written, bytes);
    return out;
  }

 private:
  struct Free {
    void operator()(void* p) const { std::free(p); }
  };
  std::uint64_t bytes_ = 0;
  std::unique_ptr<void, Free> block_;
  pose_wall_planar_slam* slam_ = nullptr;
};

}  // namespace pose_wall::planar_test
