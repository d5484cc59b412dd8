// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Frames that others recorded: not part of this project, so they are named here and read where the caller keeps them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "frame_input.hpp"

namespace pose_wall::bench {

struct Recording {
  std::string name;
  std::string path;                   // below the folder of the data: a frame, or a folder of frames
  std::string config_file;            // below config/; "": the defaults
  std::vector<std::string> settings;  // KEY=VALUE on top of it
  bool in_sequence;
};

const std::vector<Recording>& recordings();

// Throws tools::ConfigError, tools::FrameError or std::runtime_error.
FrameInput recorded_input(const std::filesystem::path& data, const Recording& recording);

}  // namespace pose_wall::bench
