// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// What the drive is told, as messages of either ROS: geometry_msgs/Twist and TwistStamped.

#pragma once

#include <string>

#include "apps/live/planar/command_board.hpp"
#include "apps/live/ros_messages/ros_messages.hpp"
#include "io/bags/bag_reader.hpp"

namespace pose_wall::tools::live {

class CommandReader {
 public:
  CommandReader(CommandBoard& commands, MessageEncoding encoding) : commands_(commands), encoding_(encoding) {}

  // type: as kTwistType names it. linear.x is along forward_axis, angular.z to the left. Bytes of others: whatever they
  // are, nothing is thrown. What is no such message, or moves otherwise than along an arc, is refused: the stop covers
  // arcs alone.
  void take(const std::string& type, ByteView message);

 private:
  CommandBoard& commands_;
  MessageEncoding encoding_;
};

}  // namespace pose_wall::tools::live
