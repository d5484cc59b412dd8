// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// A ROS 2 bag as the recorder leaves it: a folder with metadata.yaml, which names the files in their order.

#pragma once

#include <filesystem>
#include <vector>

namespace pose_wall::tools {

// True when the folder holds a metadata.yaml of rosbag2.
bool is_rosbag2_folder(const std::filesystem::path& folder);

// Its files, existing or not. Throws FrameError when metadata.yaml cannot be understood or the bag is compressed as a
// whole.
std::vector<std::filesystem::path> rosbag2_files(const std::filesystem::path& folder);

}  // namespace pose_wall::tools
