// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// ROS 2 bags in SQLite (.db3), the storage of rosbag2 up to Humble.

#pragma once

#include <memory>
#include <string>

#include "io/bags/bag_reader.hpp"

namespace pose_wall::tools {

// Messages by their id, that is as they were recorded. Throws FrameError when the file is no such bag, or when this
// build has no SQLite.
std::unique_ptr<BagReader> open_sqlite_bag(const std::string& path);

}  // namespace pose_wall::tools
