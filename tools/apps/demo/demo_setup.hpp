// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the demo shows: a scene of the simulator, and the engine's settings that fit it.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/config_file/load_config.hpp"
#include "lab/sim/setup.hpp"

namespace pose_wall::tools {

struct DemoOptions {
  std::string scene;  // "": a heading as it is met underground, with the machine at work in it
  std::string sensor = "os1-64";
  std::string config_file;
  std::vector<std::string> settings;    // of the engine, KEY=VALUE
  std::vector<std::string> simulation;  // of the simulator, KEY=VALUE
  std::uint64_t seed = 1;
};

// Throws std::invalid_argument for unknown names and values out of range.
sim::Setup demo_setup(const DemoOptions& options);

// Defaults, then axes, sampling points and extrinsic as simulated and a box around the simulated machine's body, then
// the config file and settings of the options. Throws ConfigError.
LoadedConfig demo_config(const DemoOptions& options, const sim::Setup& setup);

}  // namespace pose_wall::tools
