// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// sensor_msgs/PointCloud2 as ROS 1 and ROS 2 (CDR) write it: one table of fields, two ways to lay it out.

#pragma once

#include "io/bags/cloud_message.hpp"

namespace pose_wall::tools {

// The points stay as they lie in the message. Throws FrameError that names the place.
DecodedCloud decode_point_cloud2(MessageEncoding encoding, ByteView message, const Place& place);

// As source_of_cloud().
SourceIdentity source_of_point_cloud2(MessageEncoding encoding, ByteView message, const Place& place);

}  // namespace pose_wall::tools
