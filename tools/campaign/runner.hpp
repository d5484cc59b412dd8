// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Renders and measures the runs of a campaign, several at a time.

#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "campaign/manifest.hpp"
#include "campaign/record.hpp"
#include "pose_wall.hpp"

namespace pose_wall::tools::campaign {

// One run. The engine is opened anew; `on_frame` is called after each frame.
RunRecord measure(const Run& run, const EngineChoice& choice, api::Engine& engine,
                  const std::function<void()>& on_frame);

struct Work {
  std::filesystem::path folder;
  EngineChoice choice;
  std::string campaign;  // fingerprint of the manifest
  unsigned jobs = 1;
  bool tell_progress = false;  // a bar on a terminal, else a line for every tenth
};

// Ctrl-C came; the records of the runs that were done by then are there.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

// Writes a record for each run. What goes wrong in one run ends them all; the first such error is thrown. Ctrl-C ends
// them with the frame they are at: Interrupted.
void run_all(const std::vector<Run>& runs, const Work& work);

}  // namespace pose_wall::tools::campaign
