// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What every verb that measures frames of files is told.

#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/config_file/load_config.hpp"
#include "io/inputs/frame_sequence.hpp"

namespace pose_wall::tools {

// In Hz, of frames without stamps.
constexpr double kRateDefault_hz = 10.0;

struct FrameOptions {
  std::vector<std::string> inputs;
  std::string config_file;  // empty: the defaults
  std::vector<std::string> settings;
  double rate_hz = kRateDefault_hz;
  bool quiet = false;
  InputOptions input;

  // All that is read: what an output must not overwrite.
  std::vector<std::filesystem::path> files_read(const FrameSequence& sequence) const;
  // Throws ConfigError. Choices that were made go to stderr, unless quiet.
  LoadedConfig load() const;

  // Opens the inputs; throws std::invalid_argument. Choices that were made go to stderr, unless quiet.
  FrameSequence open() const;

  // The options and inputs as a shell takes them, for a command that reads the same: "-c vlp16 -s forward_axis=+Y
  // x.bag".
  std::string shell_words() const;
};

}  // namespace pose_wall::tools
