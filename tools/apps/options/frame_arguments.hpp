// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// The options of every verb that measures frames of files.

#pragma once

#include <CLI/CLI.hpp>

#include "io/inputs/frame_options.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {

constexpr const char* kInputHelp = translatable(
    "Frame files (.pcd, .bin, .ply, .xyz, .asc, .txt, .csv), folders of them in the order of the numbers in their "
    "names, "
    "bags (ROS 1, MCAP, SQLite, folders of rosbag2) or captures of packets (Velodyne, Ouster, Hesai, Livox, RoboSense, "
    "LSLidar)");

// Of verbs that take planar scans, too.
constexpr const char* kScanInputHelp = translatable(
    "A log of CARMEN (FLASER, ROBOTLASER1; .clf, .log, also packed by gzip); or frames: files (.pcd, .bin, .ply, .xyz, "
    ".asc, .txt, .csv), folders of them in the order of the numbers in their names, bags (ROS 1, MCAP, SQLite, folders "
    "of rosbag2) or captures of packets (Velodyne, Ouster, Hesai, Livox, RoboSense, LSLidar)");

// How inputs are to be read.
void add_input_options(CLI::App* verb, InputOptions* options);

// INPUT (what it may be: a translatable text), those, --config, --set, --rate and --quiet. The options must live as
// long as the verb.
void add_frame_options(CLI::App* verb, FrameOptions* options, const char* input_help = kInputHelp);

}  // namespace pose_wall::tools
