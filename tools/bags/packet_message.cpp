// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

#include "bags/packet_message.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "bags/message_cursor.hpp"
#include "language/language.hpp"

namespace pose_wall::tools {
namespace {

// How the payload of one packet stands behind its stamp.
enum class PayloadForm { kFixed, kCounted, kFixedThenCount };

struct PacketType {
  std::string_view name;
  PayloadForm form;
  std::size_t bytes;  // of a fixed one
};

constexpr std::array<PacketType, 6> kPacketTypes = {
    {{"velodyne_msgs/VelodyneScan", PayloadForm::kFixed, 1206},
     {"velodyne_msgs/msg/VelodyneScan", PayloadForm::kFixed, 1206},
     {"nebula_msgs/NebulaPackets", PayloadForm::kCounted, 0},
     {"nebula_msgs/msg/NebulaPackets", PayloadForm::kCounted, 0},
     {"pandar_msgs/PandarScan", PayloadForm::kFixedThenCount, 1500},
     {"pandar_msgs/msg/PandarScan", PayloadForm::kFixedThenCount, 1500}}};

const PacketType* find_packet_type(std::string_view name) {
  const auto* const found =
      std::find_if(kPacketTypes.begin(), kPacketTypes.end(), [&](const PacketType& type) { return type.name == name; });
  return found != kPacketTypes.end() ? found : nullptr;
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

}  // namespace

bool is_packet_type(std::string_view type) {
  return find_packet_type(type) != nullptr;
}

DecodedPackets decode_packets(std::string_view type, MessageEncoding encoding, ByteView message_bytes,
                              const Place& place) {
  const PacketType* const found = find_packet_type(type);
  if (found == nullptr) throw FrameError(say("messages of type {} hold no packets", type));
  MessageCursor message(encoding, message_bytes, place);
  const MessageHeader header = read_header(message);
  DecodedPackets decoded;
  decoded.stamp_ns = header.stamp_ns;
  decoded.frame_id = header.frame_id;
  const auto count = message.number<std::uint32_t>("packets");
  // Each packet takes at least a stamp and a length, so a count that is not true ends with the bytes.
  for (std::uint32_t i = 0; i < count; ++i) {
    MessagePacket packet;
    packet.stamp_ns = message.stamp_ns("stamp of a packet");
    packet.payload = read_payload(message, *found);
    decoded.packets.push_back(packet);
  }
  return decoded;
}

}  // namespace pose_wall::tools
