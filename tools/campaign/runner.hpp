// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Puts the frames of a campaign's runs through the engine.

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "campaign/manifest.hpp"
#include "campaign/record.hpp"
#include "campaign/workers.hpp"
#include "config_file/load_config.hpp"
#include "motion/moving_engine.hpp"
#include "sim/setup.hpp"

namespace pose_wall::tools::campaign {

// The choice's file first, over it what scene and sensor ask for, over all its KEY=VALUE. Throws ConfigError.
LoadedConfig config_for(const sim::Setup& setup, const EngineChoice& choice);

// One run. The engine is opened anew; `on_frame` is called after each frame.
RunRecord measure(const Run& run, const EngineChoice& choice, MovingEngine& engine,
                  const std::function<void()>& on_frame);

struct Work {
  std::filesystem::path folder;
  EngineChoice choice;
  std::string campaign;  // fingerprint of the manifest
  Crew crew;
};

// Writes a record for each run. Throws as work_on does.
void run_all(const std::vector<Run>& runs, const Work& work);

}  // namespace pose_wall::tools::campaign
