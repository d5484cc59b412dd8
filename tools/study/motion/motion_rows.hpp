// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What `pose_wall motion` writes: a row of CSV and a row of a TUM trajectory per frame, and the map as PLY.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/motion/motion_runner.hpp"

namespace pose_wall::tools {

// Of a frame that could not be read, in the place of its state.
inline constexpr const char* kUnreadableFrame = "unreadable";

// Columns keep their places: later versions add theirs behind the others.
std::vector<std::string> motion_head();
std::vector<std::string> motion_cells(const MotionOutcome& outcome);

// "first|no_ground".
std::string motion_reason_names(std::uint32_t reasons);

// `t x y z qx qy qz qw` with its line break, t in s; empty for a frame without a pose.
std::string tum_row(const MotionOutcome& outcome);

// Binary little endian, x, y, z as float. xyz_m: three numbers a point.
std::string map_as_ply(const std::vector<float>& xyz_m);

}  // namespace pose_wall::tools
