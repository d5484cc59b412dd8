// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Commands of the drive from a topic of ROS 2.

#pragma once

#include <memory>
#include <string>

#include "apps/live/planar/command_board.hpp"
#include "apps/live/ros2/ros2_node.hpp"
#include "apps/live/sink.hpp"

namespace pose_wall::tools::live {

// Throws std::runtime_error for what is no topic of ROS.
std::unique_ptr<Sink> make_ros2_commands(const std::string& topic, CommandBoard& commands,
                                         std::shared_ptr<Ros2Node> node);

}  // namespace pose_wall::tools::live
