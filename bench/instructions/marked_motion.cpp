// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Drives an OS1-64 along a scene and gives its frames to the motion, with getppid() before and after each for
// count_plugin to write what it has counted. Prints a line per frame: points, state along, keyframes.
//
//   pose_wall_marked_motion [SCENE [FRAMES]]

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "lab/sim/run_files.hpp"
#include "lab/sim/scenes.hpp"
#include "lab/sim/simulator.hpp"
#include "pose_wall.h"
#include "pose_wall_motion.h"
#include "support/motion_under_test.hpp"

namespace pose_wall::bench {
namespace {

constexpr double kSpeed_m_s = 0.7, kScan_s = 0.1;
constexpr std::uint64_t kSeed = 1;

tools::sim::Setup driven(const std::string& scene) {
  tools::sim::Setup setup = tools::sim::make_setup(scene, "os1-64", false, kSeed);
  setup.machine.speed_mps = kSpeed_m_s;
  setup.sequence.scan_s = kScan_s;
  setup.rock.rock_repeats = 0.0;
  return setup;
}

// As the sensor's driver lays points out: with times and rings.
struct DriversCloud {
  explicit DriversCloud(const tools::sim::Frame& frame) : bytes(frame.count() * kStep) {
    for (std::size_t i = 0; i < frame.count(); ++i) {
      std::memcpy(&bytes[i * kStep], &frame.xyz_intensity[4 * i], 4 * sizeof(float));
      std::memcpy(&bytes[i * kStep + 16], &frame.time_ns[i], sizeof(std::uint32_t));
      std::memcpy(&bytes[i * kStep + 20], &frame.ring[i], sizeof(std::uint16_t));
    }
    cloud.struct_size = sizeof cloud;
    cloud.stamp_ns = frame.stamp_ns;
    cloud.data = bytes.data();
    cloud.data_bytes = bytes.size();
    cloud.width = static_cast<std::uint32_t>(frame.count());
    cloud.height = 1;
    cloud.point_step = kStep;
    cloud.x = {0, POSE_WALL_FIELD_FLOAT32};
    cloud.y = {4, POSE_WALL_FIELD_FLOAT32};
    cloud.z = {8, POSE_WALL_FIELD_FLOAT32};
    cloud.time = {16, POSE_WALL_FIELD_UINT32};
    cloud.ring = {20, POSE_WALL_FIELD_UINT16};
  }

  static constexpr std::uint32_t kStep = 22;
  std::vector<unsigned char> bytes;
  pose_wall_cloud cloud{};
};

int run(const std::string& scene, std::uint32_t count) {
  const tools::sim::Setup setup = driven(scene);
  const tools::sim::Simulator simulator(setup, kSeed);
  pose_wall_config config;
  if (pose_wall_config_init(&config) != POSE_WALL_OK) return EXIT_FAILURE;
  for (const tools::EngineSetting& s : tools::sim::engine_setting_list(setup)) {
    if (pose_wall_config_set(&config, s.key.c_str(), s.value.c_str()) != POSE_WALL_OK) return EXIT_FAILURE;
  }
  test::MotionUnderTest motion(config);
  for (std::uint32_t i = 0; i < count; ++i) {
    const DriversCloud given(simulator.render(i));
    static_cast<void>(getppid());
    const pose_wall_motion_result result = motion.process(given.cloud);
    static_cast<void>(getppid());
    std::printf("%u %u %u\n", result.points_in, result.along_state, result.keyframes);
  }
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace pose_wall::bench

int main(int argc, char** argv) {
  try {
    const unsigned long frames = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 12;
    return pose_wall::bench::run(argc > 1 ? argv[1] : "rough", static_cast<std::uint32_t>(frames));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "pose_wall_marked_motion: %s\n", e.what());
    return EXIT_FAILURE;
  }
}
