// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: messages of raw packets give the packets with their stamps in either serialisation, lengths that do not fit
// are refused with the place, and bags of such messages give the frames that a capture of the packets gives.

#include <gtest/gtest.h>

#include "bag_files.hpp"
#include "io/bags/packet_message.hpp"
#include "ouster_packets.hpp"
#include "packet_files.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

// As a driver writes them: packets a millisecond apart.
std::string message(const std::string& type, MessageEncoding encoding, const std::vector<std::string>& payloads,
                    bool big_endian = false) {
  const bool is_cdr = encoding == MessageEncoding::kCdr;
  CdrWriter cdr(big_endian);
  std::string ros1;
  const auto put = [&](std::uint32_t number) {
    if (is_cdr) cdr.put(number);
    if (!is_cdr) ros1 += raw(number);
  };
  const auto put_bytes = [&](const std::string& bytes) {
    if (is_cdr) cdr.put_bytes(bytes);
    if (!is_cdr) ros1 += bytes;
  };
  if (!is_cdr) put(9);
  put(1'700'000'000);
  put(5);
  if (is_cdr) cdr.put_text("lidar");
  if (!is_cdr) ros1 += with_length("lidar");
  put(static_cast<std::uint32_t>(payloads.size()));
  for (std::uint32_t i = 0; i < payloads.size(); ++i) {
    put(1'700'000'000);
    put(i * 1'000'000);
    std::string payload = payloads[i];
    const auto size = static_cast<std::uint32_t>(payload.size());
    if (contains(type, "NebulaPackets")) put(size);
    if (contains(type, "PandarScan")) payload.resize(1500, '\0');
    put_bytes(payload);
    if (contains(type, "PandarScan")) put(size);
  }
  return is_cdr ? cdr.text() : ros1;
}

DecodedPackets decode(const std::string& type, MessageEncoding encoding, const std::string& bytes) {
  return decode_packets(type, encoding, test::view_of(bytes), {1000, ""});
}

std::string refusal_of(const std::string& type, MessageEncoding encoding, const std::string& bytes) {
  return test::said_by<FrameError>([&] { decode(type, encoding, bytes); });
}

const std::vector<std::string> kTypes = {"velodyne_msgs/VelodyneScan", "nebula_msgs/NebulaPackets",
                                         "pandar_msgs/PandarScan"};

std::string ros2_name(const std::string& type) {
  const std::size_t slash = type.find('/');
  return type.substr(0, slash) + "/msg" + type.substr(slash);
}

TEST(PacketMessage, EveryTypeInEverySerialisation) {
  const std::vector<std::string> payloads = {std::string(1206, 'a'), std::string(1206, 'b')};
  for (const std::string& type : kTypes) {
    EXPECT_TRUE(is_packet_type(type) && is_packet_type(ros2_name(type)));
    // Packets are views of their messages.
    const std::string ros1 = message(type, MessageEncoding::kRos1, payloads),
                      cdr = message(type, MessageEncoding::kCdr, payloads),
                      big_endian = message(type, MessageEncoding::kCdr, payloads, true);
    for (const DecodedPackets& decoded :
         {decode(type, MessageEncoding::kRos1, ros1), decode(ros2_name(type), MessageEncoding::kCdr, cdr),
          decode(ros2_name(type), MessageEncoding::kCdr, big_endian)}) {
      EXPECT_EQ(decoded.stamp_ns, 1'700'000'000'000'000'005);
      EXPECT_EQ(decoded.frame_id, "lidar");
      ASSERT_EQ(decoded.packets.size(), 2U);
      EXPECT_EQ(decoded.packets[1].stamp_ns, 1'700'000'000'001'000'000);
      EXPECT_EQ(text_of(decoded.packets[1].payload).front(), 'b');
      EXPECT_EQ(decoded.packets[1].payload.size, 1206U);
    }
  }
  EXPECT_FALSE(is_packet_type("sensor_msgs/PointCloud2"));
  EXPECT_TRUE(contains(refusal_of("std_msgs/String", MessageEncoding::kRos1, ""), "hold no packets"));
}

TEST(PacketMessage, WhatIsCutOrCountsBeyondItsBytesIsRefusedWithThePlace) {
  for (const std::string& type : kTypes) {
    for (const MessageEncoding encoding : {MessageEncoding::kRos1, MessageEncoding::kCdr}) {
      const std::string whole = message(type, encoding, {std::string(1206, 'a')});
      for (std::size_t size = 0; size < whole.size(); ++size) {
        EXPECT_TRUE(contains(refusal_of(type, encoding, whole.substr(0, size)), "offset ")) << type << " " << size;
      }
      std::string many = whole;
      const std::size_t count = encoding == MessageEncoding::kRos1 ? 21 : 24;
      ASSERT_EQ(many.substr(count, 4), raw(1U));
      many.replace(count, 4, "\xFF\xFF\xFF\xFF");
      EXPECT_TRUE(contains(refusal_of(type, encoding, many), "offset "));
    }
  }
  std::string longer = message(kTypes[2], MessageEncoding::kRos1, {std::string(1206, 'a')});
  longer.replace(longer.size() - 4, 4, raw(1501U));
  EXPECT_TRUE(contains(refusal_of(kTypes[2], MessageEncoding::kRos1, longer), "a packet of 1501 bytes; at most 1500"));
  EXPECT_TRUE(contains(refusal_of(kTypes[0], MessageEncoding::kOther, longer), "neither CDR nor of ROS 1"));
}

test::ReadCapture read_of_bag(const TempFolder& folder, const std::string& name, const std::string& bag) {
  return test::read(folder.write(name, bag));
}

TEST(PacketBag, GivesTheFramesOfACapture) {
#if !POSE_WALL_HAS_PCAP
  GTEST_SKIP() << "this build reads no captures";
#endif
  const TempFolder folder;
  const std::vector<std::string> payloads = test::velodyne_turns();
  const std::vector<std::string> first(payloads.begin(), payloads.begin() + 7),
      second(payloads.begin() + 7, payloads.end());
  const test::ReadCapture captured = test::read(folder.write("c.pcap", test::capture_of(payloads)));
  ASSERT_EQ(captured.frames.size(), 3U);
  for (const std::string& type : kTypes) {
    // Stamps of the second message begin anew: that of the frame that spans both is the first's.
    const test::ReadCapture ros1 = read_of_bag(
        folder, "a.bag", test::ros1_bag({{"/points", type}}, {{0, message(type, MessageEncoding::kRos1, payloads)}}));
    const test::ReadCapture mcap = read_of_bag(
        folder, "a.mcap",
        test::mcap({{"/points", ros2_name(type)}}, {{0, message(type, MessageEncoding::kCdr, payloads)}}, nullptr));
    for (const test::ReadCapture* bag : {&ros1, &mcap}) {
      ASSERT_TRUE(bag->errors.empty()) << bag->errors.front();
      ASSERT_EQ(bag->frames.size(), 3U);
      EXPECT_EQ(bag->announced, 3U);
      EXPECT_TRUE(contains(bag->about.kind, "packets of a Velodyne VLP-16")) << bag->about.kind;
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(bag->frames[i].frame->bytes, captured.frames[i].frame->bytes);
        EXPECT_EQ(*bag->frames[i].stamp_ns, *captured.frames[i].stamp_ns);
      }
    }
    const test::ReadCapture parts = read_of_bag(folder, "parts.mcap",
                                                test::mcap({{"/points", ros2_name(type)}},
                                                           {{0, message(type, MessageEncoding::kCdr, first)},
                                                            {0, message(type, MessageEncoding::kCdr, second)}},
                                                           nullptr));
    EXPECT_EQ(parts.frames.size(), 3U) << "frames do not end with messages";
  }
}

TEST(PacketBag, AMessageThatCannotBeReadIsSaidAndTheOthersAreRead) {
  const TempFolder folder;
  const std::string good = message(kTypes[0], MessageEncoding::kCdr, test::velodyne_turns());
  const test::ReadCapture bag =
      read_of_bag(folder, "a.mcap",
                  test::mcap({{"/points", ros2_name(kTypes[0])}}, {{0, good.substr(0, 3000)}, {0, good}}, nullptr));
  EXPECT_EQ(bag.frames.size(), 3U);
  ASSERT_EQ(bag.errors.size(), 1U);
  EXPECT_TRUE(contains(bag.errors.front(), "data of a packet takes 1206 bytes"));
  EXPECT_EQ(bag.announced, 4U);
}

// Its driver records its metadata as a text beside its packets.
TEST(PacketBag, MetadataOfAnOusterIsThatOfTheBag) {
  const TempFolder folder;
  const std::string type = "nebula_msgs/NebulaPackets", text = test::ouster_json({});
  std::vector<std::string> payloads;
  for (const test::OusterPacket& packet : test::turns_of({}, 3)) payloads.push_back(test::payload_of(packet));
  CdrWriter cdr(false);
  cdr.put_text(text);
  const auto ros1 = [&](const std::string& topic, const std::string& metadata) {
    return read_of_bag(
        folder, "a.bag",
        test::ros1_bag({{topic, "std_msgs/String"}, {"/ouster/lidar_packets", type}},
                       {{1, message(type, MessageEncoding::kRos1, payloads)}, {0, with_length(metadata)}}));
  };
  const test::ReadCapture mcap =
      read_of_bag(folder, "a.mcap",
                  test::mcap({{"/ouster/metadata", "std_msgs/msg/String"}, {"/ouster/lidar_packets", ros2_name(type)}},
                             {{0, cdr.text()}, {1, message(type, MessageEncoding::kCdr, payloads)}}, nullptr));
  const test::ReadCapture of_ros1 = ros1("/ouster/metadata", text);
  for (const test::ReadCapture* bag : {&of_ros1, &mcap}) {
    ASSERT_TRUE(bag->errors.empty()) << bag->errors.front();
    EXPECT_EQ(bag->frames.size(), 3U);
    EXPECT_TRUE(contains(bag->about.kind, "packets of an Ouster OS-test")) << bag->about.kind;
  }
  const std::string elsewhere = test::refusal_of(ros1("/other/metadata", text));
  EXPECT_TRUE(contains(elsewhere, "--metadata") && contains(elsewhere, "/ouster/metadata")) << elsewhere;
  EXPECT_TRUE(contains(test::refusal_of(ros1("/ouster/metadata", "{}")), "metadata of topic /ouster/metadata: "));
}

// A driver that records both made the clouds of the packets.
TEST(PacketBag, CloudsArePreferredAndEitherTopicCanBeNamed) {
  const TempFolder folder;
  const std::string file =
      folder.write("a.bag", test::ros1_bag({{"/packets", kTypes[0]}, {"/points", "sensor_msgs/PointCloud2"}},
                                           {{0, message(kTypes[0], MessageEncoding::kRos1, test::velodyne_turns())},
                                            {1, test::ros1_message(test::CloudMessage{})}}));
  const test::ReadCapture both = test::read(file);
  EXPECT_EQ(both.about.topic, "/points");
  EXPECT_EQ(both.frames.size(), 1U);
  InputOptions options;
  options.topic = "/packets";
  options.packets.sensor = "vlp16";
  EXPECT_EQ(FrameSequence({file}, options).frames(), 3U);
  options.packets.sensor = "hdl32e";
  const FrameSequence refused({file}, options);
  ASSERT_EQ(refused.errors().size(), 1U);
  EXPECT_TRUE(contains(refused.errors().front(), "Velodyne VLP-16")) << refused.errors().front();
  EXPECT_TRUE(contains(refused.errors().front(), "a.bag")) << refused.errors().front();
}

}  // namespace
}  // namespace pose_wall::tools
