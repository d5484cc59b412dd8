// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What every verb that measures frames of files is told.

#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "config_file/load_config.hpp"
#include "inputs/frame_sequence.hpp"
#include "language/language.hpp"

namespace pose_wall::tools {

struct FrameOptions {
  std::vector<std::string> inputs;
  std::string config_file;  // empty: the defaults
  std::vector<std::string> settings;
  double rate_hz = 10.0;
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

constexpr const char* kInputHelp = translatable(
    "Frame files (.pcd, .bin, .ply, .xyz, .asc, .txt, .csv), folders of them in the order of the numbers in their "
    "names, "
    "bags (ROS 1, MCAP, SQLite, folders of rosbag2) or captures of packets (Velodyne, Ouster, Hesai, Livox)");

// Of verbs that take planar scans, too.
constexpr const char* kScanInputHelp = translatable(
    "A log of CARMEN (FLASER, ROBOTLASER1; .clf, .log, also packed by gzip); or frames: files (.pcd, .bin, .ply, .xyz, "
    ".asc, .txt, .csv), folders of them in the order of the numbers in their names, bags (ROS 1, MCAP, SQLite, folders "
    "of rosbag2) or captures of packets (Velodyne, Ouster, Hesai, Livox)");

// How inputs are to be read.
void add_input_options(CLI::App* verb, InputOptions* options);

// INPUT (what it may be: a translatable text), those, --config, --set, --rate and --quiet. The options must live as
// long as the verb.
void add_frame_options(CLI::App* verb, FrameOptions* options, const char* input_help = kInputHelp);

}  // namespace pose_wall::tools
