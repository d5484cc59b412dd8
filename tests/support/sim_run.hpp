// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The simulator's frames through the engine, each beside its truth.

#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "io/numbers/angles.hpp"
#include "lab/sim/machine_body.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/simulator.hpp"
#include "support/clouds.hpp"
#include "support/engine_under_test.hpp"

namespace pose_wall::test {

namespace sim = pose_wall::tools::sim;

using tools::kRadPerDeg;

inline void set_box(pose_wall_config* config, const char* key, const std::array<double, 6>& box) {
  std::string text;
  for (const double number : box) text += std::to_string(number) + " ";
  set(config, key, text.c_str());
}

// What the engine is to be told of the simulated machine: axes, mounting, and the boxes that hold body and boom. (A
// boom that swings is in no box.)
inline pose_wall_config config_for(const sim::SceneSetup& setup, pose_wall_config config = config_with()) {
  static const char* const kAxes[] = {"+X", "-X", "+Y", "-Y"};
  set(&config, "forward_axis", kAxes[static_cast<int>(setup.machine.forward_axis)]);
  set(&config, "extrinsic_x", setup.mount.mount_x_m);
  set(&config, "extrinsic_y", setup.mount.mount_y_m);
  set(&config, "extrinsic_z", setup.mount.mount_z_m);
  set(&config, "extrinsic_roll", setup.mount.mount_roll_deg * kRadPerDeg);
  set(&config, "extrinsic_pitch", setup.mount.mount_pitch_deg * kRadPerDeg);
  set(&config, "extrinsic_yaw", setup.mount.mount_yaw_deg * kRadPerDeg);
  if (setup.machine.body != 0.0) set_box(&config, "body_box_1", sim::body_box_base_m(setup.machine));
  const bool boom_stays = setup.machine.boom != 0.0 && setup.machine.boom_sweep_deg == 0.0;
  if (boom_stays) set_box(&config, "body_box_2", sim::boom_box_base_m(setup.machine));
  set(&config, "s_front", setup.machine.s_front_m);
  set(&config, "s_back", setup.machine.s_back_m);
  return config;
}

inline pose_wall_cloud cloud_of(const sim::Frame& frame) {
  pose_wall_cloud cloud;
  pose_wall_cloud_xyz32(&cloud, frame.xyz_intensity.data(), static_cast<std::uint32_t>(frame.count()),
                        4 * sizeof(float), frame.stamp_ns);
  return cloud;
}

inline Points points_of(const sim::Frame& frame) {
  Points points(frame.count());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float* p = &frame.xyz_intensity[4 * i];
    points[i] = {p[0], p[1], p[2]};
  }
  return points;
}

// Both truths of a frame: of the road's planes, and of what is really there.
struct JudgedFrame {
  pose_wall_result result;
  tools::TruthRow truth, surveyed;

  double raw_error(std::uint32_t q) const { return off(q, result.quantity[q].raw); }
  double error(std::uint32_t q) const { return off(q, result.quantity[q].value); }
  // To what lies between both; where they are far apart, to the nearer one.
  double off(std::uint32_t q, double value) const {
    constexpr double kFar_rad = 0.0349, kFar_m = 0.2;  // twice the alert limits
    const double by_road = value - truth.value[q], by_survey = value - surveyed.value[q];
    if (!std::isfinite(by_survey)) return by_road;
    const bool is_near = std::fabs(by_road - by_survey) <= (q < POSE_WALL_D_LF ? kFar_rad : kFar_m);
    if (is_near && (by_road < 0.0) != (by_survey < 0.0)) return 0.0;
    return std::fabs(by_road) < std::fabs(by_survey) ? by_road : by_survey;
  }
  bool is(std::uint32_t q, std::uint32_t state) const { return result.quantity[q].state == state; }
};

inline std::vector<JudgedFrame> run_frames(const sim::SceneSetup& setup, std::uint64_t seed, std::uint32_t count,
                                           const pose_wall_config& base = config_with()) {
  const sim::Simulator simulator(setup, seed);
  EngineUnderTest engine(config_for(setup, base));
  std::vector<JudgedFrame> out;
  for (std::uint32_t i = 0; i < count; ++i) {
    const sim::Frame frame = simulator.render(i);
    out.push_back({engine.process(cloud_of(frame)), simulator.truth(i), simulator.surveyed_truth(i)});
  }
  return out;
}

}  // namespace pose_wall::test
