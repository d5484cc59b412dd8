// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What frame_bench runs through the engine: frames and the settings for them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "lab/sim/simulator.hpp"
#include "pose_wall.hpp"

namespace pose_wall::bench {

struct InputFrame {
  pose_wall_cloud cloud;            // as it lies in memory, for the engine
  const tools::sim::Frame* packed;  // the same points, for the floor pass
};

struct FrameInput {
  api::Config config;
  std::vector<InputFrame> frames;
  // false: each frame by itself. The engine forgets the last one, which else it would take for a frozen sensor's or for
  // another pose of the same machine.
  bool in_sequence = true;
  std::shared_ptr<const void> storage;  // what the frames point into, where nobody else keeps it
};

// Simulated frames of a sensor.
FrameInput simulated_input(const std::string& sensor);
// What fills every table, by the settings of the densest sensor.
FrameInput spread_input(std::uint32_t points);

}  // namespace pose_wall::bench
