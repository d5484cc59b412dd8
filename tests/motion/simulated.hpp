// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Short simulated runs through a motion, each frame beside the true pose of base in base of the first frame.

#pragma once

#include <functional>
#include <vector>

#include "motion/pose.hpp"
#include "support/motion_contract.hpp"
#include "support/motion_under_test.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::motion::test {

namespace sim = pose_wall::tools::sim;
using pose_wall::test::Points;

// A rough road, a machine that drives in it, a small scanner that sees it quickly.
inline sim::SceneSetup rough_road(double speed_m_s) {
  sim::SceneSetup setup;
  setup.rock.roughness_m = 0.04;
  setup.rock.rock_repeats = 0.0;
  setup.floor.floor_roughness_m = 0.01;
  setup.machine.speed_mps = speed_m_s;
  setup.sensor.rings = 32.0;
  setup.sensor.columns = 512.0;
  return setup;
}
inline sim::SceneSetup clean_road(double speed_m_s) {
  sim::SceneSetup setup = rough_road(speed_m_s);
  setup.rock = {};
  setup.floor = {};
  return setup;
}

inline Pose true_pose(const sim::SceneSetup& setup, const sim::MachinePose& pose) {
  const sim::Placement placed = sim::place(setup, pose);
  Pose out;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) out.R(i, j) = placed.R_road_base(i, j);
    out.t[i] = placed.origin_road[i];
  }
  return out;
}

struct MotionFrame {
  pose_wall_motion_result result;
  Pose truth;            // in start
  Eigen::Vector3d step;  // true, in base of the frame before
  std::int64_t stamp_ns;

  bool has_pose() const { return result.along_state != POSE_WALL_ALONG_LOST; }
  bool measured() const { return result.along_state == POSE_WALL_ALONG_MEASURED; }
  Eigen::Vector3d position() const { return {result.position_m[0], result.position_m[1], result.position_m[2]}; }
  Eigen::Vector3d axis() const { return {result.road_axis[0], result.road_axis[1], result.road_axis[2]}; }
  double error_m() const { return (position() - truth.t).norm(); }
  double along_error_m() const { return (position() - truth.t).dot(axis()); }
  double step_along_error_m() const {
    return (Eigen::Vector3d(result.step_m[0], result.step_m[1], result.step_m[2]) - step)
        .dot(truth.R.transpose() * axis());
  }
  // From the true attitude to the one found, in start.
  Eigen::Vector3d turn_off() const {
    const Eigen::Quaterniond q(result.quaternion[3], result.quaternion[0], result.quaternion[1], result.quaternion[2]);
    return turn_of(q.toRotationMatrix() * truth.R.transpose());
  }
  double turn_error_rad() const { return turn_off().norm(); }
};

// A frame's cloud as it is given to the motion; points may be changed before.
struct SimulatedRun {
  explicit SimulatedRun(const sim::SceneSetup& setup, std::uint64_t seed = 1) : simulator(setup, seed) {}

  pose_wall_cloud cloud_of(const sim::Frame& frame) const {
    pose_wall_cloud cloud = pose_wall::test::cloud_of(frame);
    return cloud;
  }

  // give: what the motion says of the i-th frame; it may change the stamp.
  template <typename Give>
  std::vector<MotionFrame> run_by(std::uint32_t from, std::uint32_t count, Give give) const {
    std::vector<MotionFrame> out;
    const Pose start = true_pose(simulator.setup(), simulator.pose(from));
    Pose before = start;
    for (std::uint32_t i = from; i < from + count; ++i) {
      const sim::Frame frame = simulator.render(i);
      const Pose now = true_pose(simulator.setup(), simulator.pose(i));
      MotionFrame row;
      row.stamp_ns = frame.stamp_ns;
      row.result = give(i, frame, &row.stamp_ns);
      row.truth = {start.R.transpose() * now.R, start.R.transpose() * (now.t - start.t)};
      row.step = before.R.transpose() * (now.t - before.t);
      before = now;
      out.push_back(row);
    }
    return out;
  }
  std::vector<MotionFrame> run(pose_wall::test::MotionUnderTest& motion, std::uint32_t count,
                               const std::function<void(std::uint32_t, sim::Frame*)>& change = {},
                               std::uint32_t from = 0) const {
    return run_by(from, count, [&](std::uint32_t i, sim::Frame frame, std::int64_t* stamp_ns) {
      if (change) change(i, &frame);
      *stamp_ns = frame.stamp_ns;
      return motion.process(cloud_of(frame));
    });
  }
  std::vector<MotionFrame> run(std::uint32_t count) const {
    pose_wall::test::MotionUnderTest motion(pose_wall::test::config_for(simulator.setup()));
    return run(motion, count);
  }

  sim::Simulator simulator;
};

}  // namespace pose_wall::motion::test
