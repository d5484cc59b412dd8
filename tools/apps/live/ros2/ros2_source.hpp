// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Clouds and transforms from topics of ROS 2.

#pragma once

#include <memory>

#include "apps/live/ros2/ros2_node.hpp"
#include "apps/live/source.hpp"
#include "io/config_file/load_config.hpp"

namespace pose_wall::tools::live {

std::unique_ptr<Source> make_ros2_source(const LoadedConfig& loaded, std::shared_ptr<Ros2Node> node);

// "" where the kernel's buffer holds a cloud of so many bytes; else what is lost and what to do about it.
std::string receive_buffer_warning(std::uint64_t granted_bytes, std::uint64_t cloud_bytes);

}  // namespace pose_wall::tools::live
