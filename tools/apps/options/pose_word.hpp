// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Poses and files of pictures as words of the command line.

#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "pose_wall_planar_types.h"

namespace pose_wall::tools {

// "x,y,yaw" in m, m, degrees. Throws std::invalid_argument that names the option.
pose_wall_planar_pose pose_of_word(const std::string& word, const char* option);

// Refuses a name that does not end in .svg.
CLI::Validator svg_file();

}  // namespace pose_wall::tools
