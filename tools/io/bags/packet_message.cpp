// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "io/bags/packet_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "io/bags/message_cursor.hpp"
#include "io/language/language.hpp"

namespace pose_wall::tools {
namespace {

// How the payload of one packet stands behind its stamp. Of an open one the bytes that are left tell the size: drivers
// declare the same type with 1206 bytes or with 1212.
enum class PayloadForm { kFixed, kCounted, kFixedThenCount, kOpen };

enum class HeadForm { kNone, kHeader, kHeaderAndFlags, kHeaderAndBase };

struct PacketType {
  std::string_view package, name;
  HeadForm head;
  bool is_list;    // behind a count; else the message is one packet
  bool has_stamp;  // each packet of its own
  PayloadForm form;
  std::size_t bytes;  // of a fixed one
};

// By the .msg files of the drivers: ros-drivers/velodyne, tier4/nebula, HesaiTechnology, ouster-ros (ouster_ros in ROS
// 1 and early ROS 2, then ouster_msgs, ouster_sensor_msgs), rslidar_msg, ros_rslidar, Lslidar_ROS1_driver (a branch for
// each sensor) and lslidar_c16, lslidar_c32.
constexpr std::array<PacketType, 19> kPacketTypes = {
    {{"velodyne_msgs", "VelodyneScan", HeadForm::kHeader, true, true, PayloadForm::kFixed, 1206},
     {"velodyne_msgs", "VelodynePacket", HeadForm::kNone, false, true, PayloadForm::kFixed, 1206},
     {"nebula_msgs", "NebulaPackets", HeadForm::kHeader, true, true, PayloadForm::kCounted, 0},
     {"pandar_msgs", "PandarScan", HeadForm::kHeader, true, true, PayloadForm::kFixedThenCount, 1500},
     {"ouster_ros", "PacketMsg", HeadForm::kNone, false, false, PayloadForm::kCounted, 0},
     {"ouster_msgs", "PacketMsg", HeadForm::kNone, false, false, PayloadForm::kCounted, 0},
     {"ouster_sensor_msgs", "PacketMsg", HeadForm::kNone, false, false, PayloadForm::kCounted, 0},
     {"rslidar_msg", "RslidarPacket", HeadForm::kHeaderAndFlags, false, false, PayloadForm::kCounted, 0},
     {"rslidar_msgs", "rslidarScan", HeadForm::kHeader, true, true, PayloadForm::kFixed, 1248},
     {"rslidar_msgs", "RslidarScan", HeadForm::kHeader, true, true, PayloadForm::kFixed, 1248},
     {"robosense_msgs", "RobosenseScan", HeadForm::kHeader, true, true, PayloadForm::kFixed, 1248},
     {"rslidar_msgs", "rslidarPacket", HeadForm::kNone, false, true, PayloadForm::kFixed, 1248},
     {"lslidar_msgs", "LslidarPacket", HeadForm::kNone, false, true, PayloadForm::kOpen, 0},
     {"lslidar_driver", "LslidarPacket", HeadForm::kNone, false, true, PayloadForm::kOpen, 0},
     {"lslidar_ch_msgs", "LslidarChPacket", HeadForm::kHeader, false, true, PayloadForm::kFixed, 1206},
     {"lslidar_c16_msgs", "LslidarC16Packet", HeadForm::kNone, false, true, PayloadForm::kFixed, 1206},
     {"lslidar_c16_msgs", "LslidarC16ScanUnified", HeadForm::kHeaderAndBase, true, true, PayloadForm::kFixed, 1206},
     {"lslidar_c32_msgs", "LslidarC32Packet", HeadForm::kNone, false, true, PayloadForm::kFixed, 1206},
     {"lslidar_c32_msgs", "LslidarC32ScanUnified", HeadForm::kHeaderAndBase, true, true, PayloadForm::kFixed, 1206}}};

// LSLidar's packets of firmware 2.x and 3.x, and of 4.0 and later.
constexpr std::size_t kLslidarBytes = 1206, kLslidarLongBytes = 1212;
constexpr std::size_t kStampBytes = 8;

// "rslidar_msg/msg/RslidarPacket" is rslidar_msg/RslidarPacket of ROS 2.
const PacketType* find_packet_type(std::string_view type) {
  const std::size_t slash = type.find('/');
  if (slash == std::string_view::npos) return nullptr;
  const std::string_view package = type.substr(0, slash);
  std::string_view name = type.substr(slash + 1);
  constexpr std::string_view kOfRos2 = "msg/";
  if (name.rfind(kOfRos2, 0) == 0) name.remove_prefix(kOfRos2.size());
  const auto* const found = std::find_if(kPacketTypes.begin(), kPacketTypes.end(), [&](const PacketType& known) {
    return known.package == package && known.name == name;
  });
  return found != kPacketTypes.end() ? found : nullptr;
}

void read_head(MessageCursor& message, const PacketType& type, DecodedPackets& decoded) {
  if (type.head == HeadForm::kNone) return;
  const MessageHeader header = read_header(message);
  decoded.stamp_ns = header.stamp_ns;
  decoded.frame_id = header.frame_id;
  if (type.head == HeadForm::kHeaderAndFlags) message.bytes(2, "is_difop and is_frame_begin");
  if (type.head == HeadForm::kHeaderAndBase) message.number<std::uint64_t>("basetime");
}

// The newer driver copies packets of 1206 bytes into 1212. Zeros are no tail of a longer one: its last bytes are return
// mode and model.
ByteView without_filling(ByteView payload) {
  const auto is_zero = [](std::byte byte) { return byte == std::byte{0}; };
  if (payload.size == kLslidarLongBytes &&
      std::all_of(payload.data + kLslidarBytes, payload.data + kLslidarLongBytes, is_zero)) {
    payload.size = kLslidarBytes;
  }
  return payload;
}

// One version of the type has no stamp.
MessagePacket read_open(MessageCursor& message) {
  MessagePacket packet;
  const std::size_t left = message.left();
  const bool has_stamp = left == kLslidarBytes + kStampBytes || left == kLslidarLongBytes + kStampBytes;
  if (!has_stamp && left != kLslidarBytes && left != kLslidarLongBytes) {
    message.refuse(say("a packet of {} bytes with its stamp; {} or {} are allowed: others are of planar sensors", left,
                       kLslidarBytes + kStampBytes, kLslidarLongBytes + kStampBytes));
  }
  if (has_stamp) packet.stamp_ns = message.stamp_ns("stamp of a packet");
  packet.payload = without_filling(message.bytes(message.left(), "data of a packet"));
  return packet;
}

ByteView read_payload(MessageCursor& message, const PacketType& type) {
  if (type.form == PayloadForm::kCounted) return message.block("data of a packet");
  ByteView payload = message.bytes(type.bytes, "data of a packet");
  if (type.form == PayloadForm::kFixed) return payload;
  const auto size = message.number<std::uint32_t>("size of a packet");
  if (size > payload.size) {
    message.refuse(say("a packet of {} bytes; at most {} are allowed", size, payload.size));
  }
  payload.size = size;
  return payload;
}

MessagePacket read_packet(MessageCursor& message, const PacketType& type) {
  if (type.form == PayloadForm::kOpen) return read_open(message);
  MessagePacket packet;
  if (type.has_stamp) packet.stamp_ns = message.stamp_ns("stamp of a packet");
  packet.payload = read_payload(message, type);
  return packet;
}

constexpr std::string_view kDevice = "difop";

std::string_view namespace_of(std::string_view topic) {
  const std::size_t slash = topic.rfind('/');
  return slash == std::string_view::npos ? std::string_view{} : topic.substr(0, slash);
}

}  // namespace

bool is_side_topic(std::string_view topic) {
  return topic.find(kDevice) != std::string_view::npos || topic.find("imu") != std::string_view::npos;
}

std::string device_topic(const std::vector<std::string>& topics, std::string_view topic) {
  std::vector<std::string> own, beside;
  std::size_t senders = 0;
  for (const std::string& other : topics) {
    if (namespace_of(other) != namespace_of(topic)) continue;
    const bool is_device = other != topic && other.find(kDevice) != std::string::npos;
    if (!is_side_topic(other)) ++senders;
    if (is_device) beside.push_back(other);
    if (is_device && other.rfind(topic, 0) == 0) own.push_back(other);
  }
  if (own.size() == 1) return own.front();
  return own.empty() && beside.size() == 1 && senders == 1 ? beside.front() : "";
}

bool is_packet_type(std::string_view type) {
  return find_packet_type(type) != nullptr;
}

DecodedPackets decode_packets(std::string_view type, MessageEncoding encoding, ByteView message_bytes,
                              const Place& place) {
  const PacketType* const found = find_packet_type(type);
  if (found == nullptr) throw FrameError(say("messages of type {} hold no packets", type));
  MessageCursor message(encoding, message_bytes, place);
  DecodedPackets decoded;
  read_head(message, *found, decoded);
  if (!found->is_list) {
    decoded.packets.push_back(read_packet(message, *found));
    if (!found->has_stamp) decoded.packets.front().stamp_ns = decoded.stamp_ns;
    return decoded;
  }
  const auto count = message.number<std::uint32_t>("packets");
  // Each packet takes at least a stamp and a length, so a count that is not true ends with the bytes.
  for (std::uint32_t i = 0; i < count; ++i) decoded.packets.push_back(read_packet(message, *found));
  return decoded;
}

}  // namespace pose_wall::tools
