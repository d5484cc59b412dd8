// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Messages that hold packets of a sensor as they came: scans of many (VelodyneScan, NebulaPackets, PandarScan,
// rslidarScan, LslidarC16ScanUnified, ...), and messages that are one packet each (PacketMsg of an Ouster,
// RslidarPacket, LslidarPacket, ...).

#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/bags/bag_reader.hpp"

namespace pose_wall::tools {

struct MessagePacket {
  std::int64_t stamp_ns = 0;  // 0: none, as of an Ouster
  ByteView payload;           // within the message
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

// Whether a topic of this name has what belongs to the packets of another topic, but no points: packets that describe
// the device (DIFOP), or those of the inertial unit.
bool is_side_topic(std::string_view topic);

// Of these topics with packets the one that describes the device (DIFOP) which sends on `topic`: its name begins with
// that of `topic`, or both are the only ones of their namespace. Empty: none, or nobody can tell.
std::string device_topic(const std::vector<std::string>& topics, std::string_view topic);

}  // namespace pose_wall::tools
