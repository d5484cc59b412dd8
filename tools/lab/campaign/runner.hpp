// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Puts the frames of a campaign's runs through the engine, or through the motion library.

#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "io/config_file/load_config.hpp"
#include "io/frames/frame.hpp"
#include "lab/campaign/manifest.hpp"
#include "lab/campaign/record.hpp"
#include "lab/campaign/workers.hpp"
#include "lab/sim/setup.hpp"
#include "lab/sim/simulator.hpp"
#include "pose_wall.h"
#include "study/motion/motion_runner.hpp"

namespace pose_wall::tools::campaign {

// The choice's file first, over it what scene and sensor ask for, over all its KEY=VALUE. Throws ConfigError.
LoadedConfig config_for(const sim::Setup& setup, const EngineChoice& choice);

// What measures frames: MovingEngine, or another engine in its place. Both return a status of the engine's.
struct Instrument {
  std::function<std::int32_t(const LoadedConfig&)> open;
  std::function<std::int32_t(const pose_wall_cloud&, pose_wall_result&)> process;
};

// One run. The instrument is opened anew; `on_frame` is called after each frame.
RunRecord measure(const Run& run, const EngineChoice& choice, const Instrument& instrument,
                  const std::function<void()>& on_frame);

// One run of motion as the table in its file.
std::string measure_motion(const Run& run, const EngineChoice& choice, const MotionLibrary& library,
                           const std::function<void()>& on_frame);

// A frame of the simulator as `pose_wall sim` writes it and `pose_wall motion` reads it: with the fields t and ring
// where the scan takes time.
Frame rendered_frame(const sim::Frame& rendered, bool scan_takes_time);

struct Work {
  bool motion = false;  // the motion library is measured, not the engine
  std::filesystem::path folder;
  EngineChoice choice;
  std::string campaign;  // fingerprint of the manifest
  Crew crew;
};

// Writes a record for each run. Throws as work_on does.
void run_all(const std::vector<Run>& runs, const Work& work);

}  // namespace pose_wall::tools::campaign
