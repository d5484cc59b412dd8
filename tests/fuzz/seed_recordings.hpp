// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Recordings to begin with, as small as they can be: one cloud in a ROS 1 bag and in an MCAP, messages of clouds and
// packets, packets of sensors, metadata of an Ouster.

#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <utility>

namespace pose_wall::test::seeds {

using Text = std::string;

template <typename Number>
Text number(Number value) {
  return Text(reinterpret_cast<const char*>(&value), sizeof value);
}

inline Text counted(const Text& text) {
  return number(static_cast<std::uint32_t>(text.size())) + text;
}

// A sensor_msgs/PointCloud2 of two points; CDR has zeros behind its texts and aligns what follows.
inline Text point_cloud2(bool cdr) {
  const auto word = [cdr](const Text& text) {
    Text bytes = counted(cdr ? text + '\0' : text);
    while (cdr && bytes.size() % 4 != 0) bytes += '\0';
    return bytes;
  };
  Text m = cdr ? Text("") : number<std::uint32_t>(1);
  m += number<std::uint32_t>(5) + number<std::uint32_t>(7) + word("lidar");
  m += number<std::uint32_t>(1) + number<std::uint32_t>(2) + number<std::uint32_t>(3);
  std::uint32_t offset = 0;
  for (const char* name : {"x", "y", "z"}) {
    m += word(name) + number(offset) + '\7' + (cdr ? Text(3, '\0') : Text()) + number<std::uint32_t>(1);
    offset += 4;
  }
  m += Text(1, '\0') + (cdr ? Text(3, '\0') : Text());
  m += number<std::uint32_t>(12) + number<std::uint32_t>(24) + number<std::uint32_t>(24);
  for (const float at : {1.0F, 2.0F, 3.0F, -1.0F, 2.5F, -1.4F}) m += number(at);
  m += '\1';
  return (cdr ? Text("\0\1\0\0", 4) : Text()) + m;
}

inline Text ros1_record(std::initializer_list<std::pair<const char*, Text>> fields, const Text& data) {
  Text header;
  for (const auto& [name, value] : fields) header += counted(Text(name) + "=" + value);
  return counted(header) + counted(data);
}

inline Text ros1_bag() {
  const Text id = number<std::uint32_t>(0), none = number<std::uint64_t>(0), one = number<std::uint32_t>(1);
  Text connection;
  for (const char* field : {"topic=/points", "type=sensor_msgs/PointCloud2", "md5sum=*", "message_definition="}) {
    connection += counted(field);
  }
  return "#ROSBAG V2.0\n" +
         ros1_record({{"op", "\3"}, {"index_pos", none}, {"conn_count", one}, {"chunk_count", one}}, Text(64, ' ')) +
         ros1_record({{"op", "\7"}, {"conn", id}, {"topic", "/points"}}, connection) +
         ros1_record({{"op", "\2"}, {"conn", id}, {"time", none}}, point_cloud2(false));
}

inline Text mcap_record(char op, const Text& content) {
  return op + number(static_cast<std::uint64_t>(content.size())) + content;
}

inline Text mcap(const Text& type = "sensor_msgs/msg/PointCloud2", const Text& content = point_cloud2(true)) {
  const auto id = number<std::uint16_t>(1);
  const Text time = number<std::uint64_t>(9), none = counted("");
  const Text magic = "\x89MCAP0\r\n";
  const Text schema = id + counted(type) + counted("ros2msg") + none;
  const Text channel = id + id + counted("/points") + counted("cdr") + none;
  const Text message = id + number<std::uint32_t>(0) + time + time + content;
  return magic + mcap_record(1, none + none) + mcap_record(3, schema) + mcap_record(4, channel) +
         mcap_record(5, message) + mcap_record(15, number<std::uint32_t>(0)) + mcap_record(2, Text(20, '\0')) + magic;
}

inline Text velodyne_payload() {
  Text payload;
  for (int block = 0; block < 12; ++block) {
    payload += "\xFF\xEE" + number(static_cast<std::uint16_t>(3000 * block % 36000));
    for (int beam = 0; beam < 32; ++beam) payload += number(static_cast<std::uint16_t>(500 + 20 * beam)) + '\x40';
  }
  return payload + number<std::uint32_t>(1000000) + "\x37\x22";
}

// One block after another; `blocks` of a Hesai with a head, or of a Pandar40P without one.
inline Text hesai_payload(std::size_t lasers, std::size_t blocks) {
  const bool is_40p = lasers == 40;
  Text payload = is_40p ? ""
                        : Text("\xEE\xFF\6\1\0\0", 6) + Text(1, static_cast<char>(lasers)) +
                              Text(1, static_cast<char>(blocks)) + Text("\0\4\2\1", 4);
  for (std::size_t block = 0; block < blocks; ++block) {
    payload += (is_40p ? "\xFF\xEE" : "") + number(static_cast<std::uint16_t>(4000 * block));
    for (std::size_t i = 0; i < lasers; ++i) {
      payload += number(static_cast<std::uint16_t>(400 + 9 * i)) + Text(is_40p ? 1 : 2, '\x20');
    }
  }
  if (is_40p) return payload + Text(14, '\0') + "\x37" + Text(7, '\1');
  return payload + Text(10, '\0') + (lasers == 64 ? Text(6, '\0') : Text()) + "\x37" +
         Text(lasers == 64 ? 11 : 17, '\1');
}

inline Text mid360_payload(char type, std::size_t point_bytes) {
  Text points;
  for (std::size_t i = 0; i < 6; ++i) points += Text(point_bytes, static_cast<char>(17 * i));
  return Text(1, '\0') + number(static_cast<std::uint16_t>(36 + points.size())) + number<std::uint16_t>(4800) +
         number<std::uint16_t>(6) + Text(3, '\0') + type + Text(17, '\0') + number<std::uint64_t>(1'000'000'000) +
         points;
}

// Of an LSLidar: a Velodyne's layout with `tail` behind its blocks; and what a C16 of firmware 3 says of itself.
inline Text lslidar_payload(const Text& tail) {
  Text payload = velodyne_payload().substr(0, 1200) + tail;
  for (std::size_t block = 0; block < 12; ++block) {
    payload.replace(100 * block + 2, 2, number(static_cast<std::uint16_t>(36 * block)));
  }
  return payload;
}

inline Text lslidar_device() {
  Text device = Text("\xA5\xFF\0\x5A", 4) + Text(1202, '\0');
  for (std::size_t i = 0; i < 16; ++i) {
    const auto angle = static_cast<std::uint16_t>(100 * (i % 2 == 0 ? static_cast<int>(i) - 15 : static_cast<int>(i)));
    device[245 + 2 * i] = static_cast<char>(angle >> 8U);
    device[246 + 2 * i] = static_cast<char>(angle);
  }
  return device;
}

inline Text lslidar_hybrid_payload() {
  Text payload;
  for (int i = 0; i < 171; ++i)
    payload += i == 62 ? Text("\xFF\xAA\xBB\xCC\xDD\x11\x11", 7) : Text("\x41\x23\xF8\3\x92\0\t", 7);
  return payload + Text("\2\x11\x2D\0\7\7\xDD\x80\1", 9);
}

// As the target `packets` takes them: length, milliseconds, bytes.
inline Text datagrams(const Text& payload, int count) {
  Text text;
  for (int i = 0; i < count; ++i) text += number(static_cast<std::uint16_t>(payload.size())) + '\2' + payload;
  return text;
}

inline Text message_head(bool cdr) {
  const Text stamp = number<std::uint32_t>(5) + number<std::uint32_t>(7);
  return cdr ? Text("\0\1\0\0", 4) + stamp + counted(Text("l\0", 2)) + Text(2, '\0')
             : number<std::uint32_t>(1) + stamp + counted("l");
}

// A livox_ros_driver2/CustomMsg of two points.
inline Text livox_custom(bool cdr) {
  const Text point = number<std::uint32_t>(9) + number(1.0F) + number(-2.0F) + number(0.5F) + "\x20\x10\1";
  Text text = message_head(cdr);
  while (cdr && text.size() % 8 != 4) text += '\0';
  return text + number<std::uint64_t>(5) + number<std::uint32_t>(2) + Text(4, '\0') + number<std::uint32_t>(2) + point +
         (cdr ? Text(1, '\0') : Text()) + point;
}

// Of one packet: VelodyneScan, NebulaPackets or PandarScan.
inline Text packet_message(const Text& payload, bool cdr, bool counted_before, bool counted_behind) {
  const auto size = number(static_cast<std::uint32_t>(payload.size()));
  Text text = message_head(cdr) + number<std::uint32_t>(1) + number<std::uint32_t>(5) + number<std::uint32_t>(7);
  if (counted_before) text += size;
  text += payload;
  if (counted_behind) text += Text(1500 - payload.size(), '\0') + size;
  return text;
}

// Ethernet, IPv4, UDP; checksums left at zero.
inline Text capture(const Text& payload) {
  const auto big = [](std::size_t value) { return Text{static_cast<char>(value >> 8U), static_cast<char>(value)}; };
  const Text udp = big(2368) + big(2368) + big(payload.size() + 8) + Text(2, '\0') + payload;
  const Text ip =
      Text("\x45\0", 2) + big(udp.size() + 20) + Text("\0\0\0\0\x40\x11\0\0\xc0\xa8\1\xc9\xff\xff\xff\xff", 16);
  const Text frame = Text(12, '\2') + Text("\x08\0", 2) + ip + udp;
  const auto bytes = number(static_cast<std::uint32_t>(frame.size()));
  const Text head = number<std::uint32_t>(0xA1B2C3D4U) + number<std::uint16_t>(2) + number<std::uint16_t>(4) +
                    Text(8, '\0') + number<std::uint32_t>(65535) + number<std::uint32_t>(1);
  return head + number<std::uint32_t>(5) + number<std::uint32_t>(6) + bytes + bytes + frame;
}

inline Text ouster_metadata() {
  const Text turn = "[1,0,0,0,0,1,0,0,0,0,1,36,0,0,0,1]";
  return "{\"prod_line\":\"OS-1\",\"data_format\":{\"pixels_per_column\":2,\"columns_per_frame\":512,"
         "\"columns_per_packet\":16,\"udp_profile_lidar\":\"RNG15_RFL8_NIR8\"},\"beam_altitude_angles\":[10,-10],"
         "\"beam_azimuth_angles\":[0,1],\"lidar_origin_to_beam_origin_mm\":15.8,\"lidar_to_sensor_transform\":" +
         turn + "}\n\n";
}

}  // namespace pose_wall::test::seeds
