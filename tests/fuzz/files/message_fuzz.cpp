// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Fuzz target: bytes as a message of ROS, as it comes from a bag or from the network. The first byte chooses the type,
// the second whether it is of ROS 1 or CDR.

#include <array>

#include "fuzz/files/reader_target.hpp"
#include "io/bags/cloud_message.hpp"
#include "io/bags/packet_message.hpp"

namespace pose_wall::test {
namespace {

constexpr std::array<const char*, 11> kMessageTypes = {
    "sensor_msgs/PointCloud2",        "livox_ros_driver2/CustomMsg",
    "velodyne_msgs/VelodyneScan",     "nebula_msgs/NebulaPackets",
    "pandar_msgs/PandarScan",         "ouster_ros/PacketMsg",
    "rslidar_msg/RslidarPacket",      "rslidar_msgs/rslidarScan",
    "lslidar_msgs/LslidarPacket",     "lslidar_c16_msgs/LslidarC16ScanUnified",
    "lslidar_ch_msgs/LslidarChPacket"};

void decode(const char* type, tools::MessageEncoding encoding, const tools::ByteView& message) {
  if (tools::is_cloud_type(type)) {
    static_cast<void>(tools::source_of_cloud(type, encoding, message));
    return take_frame(tools::decode_cloud(type, encoding, message).frame);
  }
  std::size_t bytes = 0;
  for (const tools::MessagePacket& packet : tools::decode_packets(type, encoding, message).packets) {
    require(
        packet.payload.data >= message.data && packet.payload.data + packet.payload.size <= message.data + message.size,
        "a packet lies within its message");
    bytes += packet.payload.size;
  }
  require(bytes <= message.size, "packets lie side by side");
}

}  // namespace
}  // namespace pose_wall::test

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pose_wall;
  if (size < 2) return 0;
  const tools::Bytes message(reinterpret_cast<const std::byte*>(data + 2),
                             reinterpret_cast<const std::byte*>(data + size));
  const auto encoding = data[1] % 2 == 0 ? tools::MessageEncoding::kRos1 : tools::MessageEncoding::kCdr;
  try {
    test::decode(test::kMessageTypes[data[0] % test::kMessageTypes.size()], encoding, {message.data(), message.size()});
  } catch (const tools::FrameError& error) {
    test::require(error.what()[0] != '\0', "a refusal has a reason");
  }
  return 0;
}
