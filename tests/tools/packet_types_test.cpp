// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: packets come out of the messages of each maker's driver as its .msg files lay them out, in ROS 1 and ROS 2.
// That includes messages that are one packet. A device's packets on a topic of their own come along. An Ouster's
// metadata is found beside its packets.

#include <gtest/gtest.h>

#include <functional>

#include "bag_files.hpp"
#include "io/bags/packet_message.hpp"
#include "packet_files.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

// Fields one after another in either serialisation.
class FieldWriter {
 public:
  explicit FieldWriter(bool is_cdr) : is_cdr_(is_cdr), cdr_(false) {}

  template <typename Number>
  FieldWriter& number(Number value) {
    if (is_cdr_) cdr_.put(value);
    if (!is_cdr_) ros1_ += raw(value);
    return *this;
  }
  FieldWriter& bytes(const std::string& block) {
    if (is_cdr_) cdr_.put_bytes(block);
    if (!is_cdr_) ros1_ += block;
    return *this;
  }
  FieldWriter& counted(const std::string& block) {
    return number(static_cast<std::uint32_t>(block.size())).bytes(block);
  }
  FieldWriter& stamp(std::uint32_t nsec) { return number(std::uint32_t{1'700'000'000}).number(nsec); }
  FieldWriter& header(std::uint32_t nsec) {
    if (!is_cdr_) number(std::uint32_t{9});
    stamp(nsec);
    if (is_cdr_) cdr_.put_text("mast");
    if (!is_cdr_) counted("mast");
    return *this;
  }
  std::string text() const { return is_cdr_ ? cdr_.text() : ros1_; }

 private:
  bool is_cdr_;
  CdrWriter cdr_;
  std::string ros1_;
};

std::string ros2_type(const std::string& type) {
  const std::size_t slash = type.find('/');
  return type.substr(0, slash) + "/msg" + type.substr(slash);
}

DecodedPackets decode(const std::string& type, bool is_cdr, const std::string& bytes) {
  return decode_packets(is_cdr ? ros2_type(type) : type, is_cdr ? MessageEncoding::kCdr : MessageEncoding::kRos1,
                        test::view_of(bytes), {1000, ""});
}

std::string refusal_of(const std::string& type, bool is_cdr, const std::string& bytes) {
  return test::said_by<FrameError>([&] { decode(type, is_cdr, bytes); });
}

// A type whose message is one packet.
struct SingleType {
  std::string type;
  std::size_t bytes;
  bool has_stamp;
  bool has_frame;
  std::function<void(FieldWriter&, const std::string&)> put;
};

const std::vector<SingleType>& single_types() {
  const auto stamped = [](FieldWriter& out, const std::string& payload) { out.stamp(5).bytes(payload); };
  const auto counted = [](FieldWriter& out, const std::string& payload) { out.counted(payload); };
  static const std::vector<SingleType> types = {
      {"velodyne_msgs/VelodynePacket", 1206, true, false, stamped},
      {"ouster_ros/PacketMsg", 6464, false, false, counted},
      {"ouster_sensor_msgs/PacketMsg", 12609, false, false, counted},
      {"rslidar_msg/RslidarPacket", 1248, true, true,
       [](FieldWriter& out, const std::string& payload) {
         out.header(5).number(std::uint8_t{0}).number(std::uint8_t{1}).counted(payload);
       }},
      {"rslidar_msgs/rslidarPacket", 1248, true, false, stamped},
      {"lslidar_msgs/LslidarPacket", 1206, true, false, stamped},
      {"lslidar_msgs/LslidarPacket", 1212, true, false, stamped},
      {"lslidar_driver/LslidarPacket", 1212, false, false,
       [](FieldWriter& out, const std::string& payload) { out.bytes(payload); }},
      {"lslidar_c16_msgs/LslidarC16Packet", 1206, true, false, stamped},
      {"lslidar_c32_msgs/LslidarC32Packet", 1206, true, false, stamped},
      {"lslidar_ch_msgs/LslidarChPacket", 1206, true, true,
       [](FieldWriter& out, const std::string& payload) { out.header(7).stamp(5).bytes(payload); }}};
  return types;
}

TEST(PacketTypes, OneMessageMayBeOnePacket) {
  for (const SingleType& type : single_types()) {
    EXPECT_TRUE(is_packet_type(type.type) && is_packet_type(ros2_type(type.type))) << type.type;
    for (const bool is_cdr : {false, true}) {
      FieldWriter out(is_cdr);
      type.put(out, std::string(type.bytes - 1, 'a') + "z");
      const std::string message = out.text();  // the packet is a view of it
      const DecodedPackets decoded = decode(type.type, is_cdr, message);
      ASSERT_EQ(decoded.packets.size(), 1U) << type.type;
      EXPECT_EQ(decoded.packets[0].stamp_ns, type.has_stamp ? 1'700'000'000'000'000'005 : 0) << type.type;
      EXPECT_EQ(decoded.frame_id, type.has_frame ? "mast" : "") << type.type;
      ASSERT_EQ(decoded.packets[0].payload.size, type.bytes) << type.type;
      EXPECT_EQ(text_of(decoded.packets[0].payload).back(), 'z') << type.type;
      // Of LSLidar's the length alone tells which version of the type it is.
      const std::size_t cuts = contains(type.type, "/LslidarPacket") ? 1200 : out.text().size();
      for (std::size_t size = 0; size < cuts; size += 7) {
        EXPECT_TRUE(contains(refusal_of(type.type, is_cdr, out.text().substr(0, size)), "offset ")) << type.type;
      }
    }
  }
}

// Arrays of 1206 bytes: CDR fills up before the next stamp.
TEST(PacketTypes, ScansOfPacketsOfUnevenSize) {
  for (const char* type : {"rslidar_msgs/rslidarScan", "lslidar_c16_msgs/LslidarC16ScanUnified",
                           "lslidar_c32_msgs/LslidarC32ScanUnified"}) {
    const bool is_lslidar = contains(type, "lslidar_c");
    for (const bool is_cdr : {false, true}) {
      FieldWriter out(is_cdr);
      out.header(5);
      if (is_lslidar) out.number(std::uint64_t{77});
      out.number(std::uint32_t{3});
      for (std::uint32_t i = 0; i < 3; ++i) {
        out.stamp(i).bytes(std::string(is_lslidar ? 1206 : 1248, static_cast<char>('a' + i)));
      }
      const std::string message = out.text();  // packets are views of it
      const DecodedPackets decoded = decode(type, is_cdr, message);
      ASSERT_EQ(decoded.packets.size(), 3U) << type;
      EXPECT_EQ(decoded.frame_id, "mast");
      for (std::uint32_t i = 0; i < 3; ++i) {
        EXPECT_EQ(decoded.packets[i].stamp_ns, 1'700'000'000'000'000'000 + i) << type;
        EXPECT_EQ(text_of(decoded.packets[i].payload),
                  std::string(is_lslidar ? 1206 : 1248, static_cast<char>('a' + i)));
      }
    }
  }
}

// LSLidar's newer driver copies packets of 1206 bytes into 1212; of those that are as long the last bytes are no zeros.
TEST(PacketTypes, FillingBehindAPacketOfLslidarIsCutOff) {
  FieldWriter filled(true), planar(true);
  filled.stamp(5).bytes(std::string(1206, 'a') + std::string(6, '\0'));
  EXPECT_EQ(decode("lslidar_msgs/LslidarPacket", true, filled.text()).packets[0].payload.size, 1206U);
  planar.stamp(5).bytes(std::string(2000, 'a'));
  EXPECT_TRUE(contains(refusal_of("lslidar_msgs/LslidarPacket", true, planar.text()), "others are of planar sensors"));
}

TEST(PacketTypes, ADeviceIsFoundBesideItsPackets) {
  EXPECT_EQ(device_topic({"/rslidar_packets", "/rslidar_packets_difop"}, "/rslidar_packets"), "/rslidar_packets_difop");
  EXPECT_EQ(device_topic({"/l/packets", "/l/difop", "/r/packets", "/r/difop"}, "/r/packets"), "/r/difop");
  EXPECT_EQ(device_topic({"/a", "/a_difop", "/b", "/b_difop"}, "/b"), "/b_difop");
  EXPECT_EQ(device_topic({"/a", "/b", "/difop"}, "/a"), "") << "nobody can tell whose it is";
  EXPECT_EQ(device_topic({"/a"}, "/a"), "");
  EXPECT_TRUE(is_side_topic("/ouster/imu_packets") && is_side_topic("/lslidar_packet_difop"));
  EXPECT_FALSE(is_side_topic("/ouster/lidar_packets"));
}

TEST(PacketTypes, ABagOfSinglePacketsGivesTheFramesOfACapture) {
  const TempFolder folder;
  const std::string type = "velodyne_msgs/VelodynePacket";
  std::vector<WrittenMessage> ros1, cdr;
  std::uint32_t number = 0;
  for (const std::string& payload : test::velodyne_turns()) {
    ros1.push_back({0, FieldWriter(false).stamp(number * 1'000'000).bytes(payload).text()});
    cdr.push_back({0, FieldWriter(true).stamp(number++ * 1'000'000).bytes(payload).text()});
  }
  // A device's packets, which a Velodyne has none of, are what the sensor ignores; they choose no topic.
  const std::vector<std::pair<std::string, std::string>> topics = {{"/packets", type}, {"/packets_difop", type}};
  const std::vector<std::pair<std::string, std::string>> topics2 = {{"/packets", ros2_type(type)},
                                                                    {"/packets_difop", ros2_type(type)}};
  for (int i = 0; i < 40; ++i) {
    ros1.push_back({1, FieldWriter(false).stamp(0).bytes(std::string(1206, '\0')).text()});
    cdr.push_back({1, FieldWriter(true).stamp(0).bytes(std::string(1206, '\0')).text()});
  }
  for (const std::string& file : {folder.write("a.bag", test::ros1_bag(topics, ros1)),
                                  folder.write("a.mcap", test::mcap(topics2, cdr, nullptr))}) {
    const test::ReadCapture bag = test::read(file);
    ASSERT_TRUE(bag.errors.empty()) << bag.errors.front();
    EXPECT_EQ(bag.about.topic, "/packets");
    ASSERT_EQ(bag.frames.size(), 3U) << file;
    for (const SourcedFrame& frame : bag.frames) EXPECT_GE(*frame.stamp_ns, 1'700'000'000'000'000'000);
  }
}

// Two rings, sixteen columns of a turn, all in one packet; profile RNG15_RFL8_NIR8.
std::string ouster_metadata() {
  return R"({"prod_line": "OS-test", "beam_altitude_angles": [0, -20], "beam_azimuth_angles": [0, 0],
 "lidar_origin_to_beam_origin_mm": 100,
 "lidar_to_sensor_transform": [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36, 0, 0, 0, 1],
 "data_format": {"columns_per_frame": 16, "columns_per_packet": 16, "pixels_per_column": 2,
 "udp_profile_lidar": "RNG15_RFL8_NIR8"}})";
}

std::string ouster_packet(std::uint16_t frame) {
  std::string payload = raw(std::uint16_t{1}) + raw(frame) + std::string(28, '\0');
  for (std::uint16_t column = 0; column < 16; ++column) {
    payload += raw(std::uint64_t{1'000'000} * (frame * 16U + column)) + raw(column) + raw(std::uint16_t{1});
    for (int pixel = 0; pixel < 2; ++pixel) payload += raw(std::uint16_t{625}) + "\x07\x01";
  }
  return payload + std::string(32, '\0');
}

std::string ouster_bag(bool with_metadata) {
  const std::string type = "ouster_sensor_msgs/msg/PacketMsg";
  std::vector<WrittenMessage> messages;
  CdrWriter told(false);
  told.put_text(ouster_metadata());
  for (std::uint16_t frame = 1; frame < 6; ++frame) {
    messages.push_back({0, FieldWriter(true).counted(ouster_packet(frame)).text()});
    for (int i = 0; i < 4; ++i) messages.push_back({1, FieldWriter(true).counted(std::string(48, '\0')).text()});
    if (with_metadata) messages.push_back({2, told.text()});
  }
  return test::mcap(
      {{"/ouster/lidar_packets", type}, {"/ouster/imu_packets", type}, {"/ouster/metadata", "std_msgs/msg/String"}},
      messages, nullptr);
}

TEST(PacketTypes, TheMetadataOfAnOusterIsFoundBesideItsPackets) {
  const TempFolder folder;
  const test::ReadCapture told = test::read(folder.write("told.mcap", ouster_bag(true)));
  ASSERT_TRUE(told.errors.empty()) << told.errors.front();
  EXPECT_EQ(told.about.topic, "/ouster/lidar_packets");
  EXPECT_TRUE(contains(told.about.kind, "OS-test")) << told.about.kind;
  ASSERT_GE(told.frames.size(), 3U);
  EXPECT_EQ(told.frames.front().frame->cloud.height, 2U);
  const test::ReadCapture untold = test::read(folder.write("untold.mcap", ouster_bag(false)));
  ASSERT_EQ(untold.errors.size(), 1U);
  EXPECT_TRUE(contains(untold.errors.front(), "/ouster/metadata of the bag")) << untold.errors.front();
}

}  // namespace
}  // namespace pose_wall::tools
