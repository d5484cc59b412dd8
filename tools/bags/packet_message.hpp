// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Messages that hold packets of a sensor as they came: velodyne_msgs/VelodyneScan, nebula_msgs/NebulaPackets,
// pandar_msgs/PandarScan.

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bags/bag_reader.hpp"

namespace pose_wall::tools {

struct MessagePacket {
  std::int64_t stamp_ns = 0;
  ByteView payload;  // within the message
};

struct DecodedPackets {
  std::int64_t stamp_ns = 0;  // of its header; 0: none
  std::string frame_id;
  std::vector<MessagePacket> packets;
};

// Named as ROS 1 or ROS 2 does.
bool is_packet_type(std::string_view type);

// As decode_cloud.
DecodedPackets decode_packets(std::string_view type, MessageEncoding encoding, ByteView message,
                              const Place& place = {});

}  // namespace pose_wall::tools
