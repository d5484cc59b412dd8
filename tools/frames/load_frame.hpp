// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Frame files by their ending.

#pragma once

#include <filesystem>
#include <string>

#include "frames/frame.hpp"

namespace pose_wall::tools {

// ".pcd, .bin (KITTI), .ply"
std::string frame_endings_text();

// True for a path whose ending names a format that is read; upper and lower case alike.
bool has_frame_ending(const std::filesystem::path& path);

// Reads a frame file. cloud.stamp_ns is left at 0. Throws FrameError, without naming the path.
Frame load_frame(const std::filesystem::path& path);

}  // namespace pose_wall::tools
