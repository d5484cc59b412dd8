// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: head, angles and times tell which RoboSense it is, and they have to agree. Another sensor than the stated one
// is refused with both. A capture of both ports is read, and so is data with a saved device packet. Packets whose bytes
// are changed by chance never give points in a wrong unit.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bag_files.hpp"
#include "io/bags/packet_message.hpp"
#include "io/packets/robosense.hpp"
#include "io/packets/sensors.hpp"
#include "robosense_packets.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

std::string told(const RoboSenseExample& example, const std::string& stated = "") {
  SensorChoice choice;
  if (!stated.empty()) choice.kind = sensor_by_name(stated).value();
  const std::unique_ptr<ScanAssembler> assembler = make_assembler(choice);
  try {
    add(*assembler, payload_of(example.device));
    for (const std::string& payload : robosense_data(example, 6, 90.0)) {
      EXPECT_TRUE(add(*assembler, payload)) << example.word << " as " << stated;
    }
    assembler->finish();
  } catch (const FrameError& refused) {
    return refused.what();
  }
  return assembler->kind();
}

std::string kind_of(const std::string& word) {
  return std::string("packets of a ") + known_sensor(*sensor_by_name(word)).title;
}

TEST(RoboSenseKinds, EachIsToldAndReadByItsName) {
  for (const RoboSenseExample& example : test::robosense_examples()) {
    EXPECT_EQ(told(example), kind_of(example.word));
    EXPECT_EQ(told(example, example.word), kind_of(example.word));
    EXPECT_EQ(told(test::with_two_returns(example)), kind_of(example.word));
    EXPECT_EQ(recognise_sensor(test::view_of(payload_of(example.packet))), sensor_by_name(example.word))
        << example.word;
  }
}

TEST(RoboSenseKinds, AnotherThanTheStatedOneIsRefusedWithBoth) {
  for (const RoboSenseExample& example : test::robosense_examples()) {
    for (const RoboSenseExample& other : test::robosense_examples()) {
      if (other.word == example.word) continue;
      const std::string refused = told(example, other.word);
      EXPECT_TRUE(contains(refused, other.word)) << refused;
      const std::string title = known_sensor(*sensor_by_name(example.word)).title;
      EXPECT_TRUE(contains(refused, title)) << refused;
    }
  }
}

// Bytes 30 to 32 were reserved once.
TEST(RoboSenseKinds, AHeadThatSaysNothingLeavesItToAnglesAndTimes) {
  for (RoboSenseExample example : test::robosense_examples()) {
    if (example.word == "robosense_bpearl4" || example.word == "robosense_airy") continue;
    if (example.packet.is_first_kind) example.packet.head.clear();
    if (!example.packet.is_first_kind) example.packet.head = {{17, 1}};
    EXPECT_EQ(told(example), kind_of(example.word));
  }
}

TEST(RoboSenseKinds, VoicesThatContradictEachOtherAreRefused) {
  RoboSenseExample example = test::rs32_example();
  example.packet.head = {{30, 1}};
  EXPECT_TRUE(contains(told(example),
                       "the head of its data says RoboSense RS-LiDAR-16; the angles of its device packet "
                       "say RoboSense RS-LiDAR-32"));
  example = test::rs32_example();
  example.packet_us *= 2.0;
  example.device.speed = 300;
  EXPECT_TRUE(contains(told(example), "the time that its packets take says RoboSense RS-LiDAR-16"));
  example = test::bpearl_example();
  example.packet.head = {{31, 3}, {32, 5}};  // came later
  EXPECT_TRUE(contains(told(example), "the head of its data says no sensor that is known"));
}

TEST(RoboSenseKinds, WhereNothingTellsItHasToBeNamed) {
  RoboSenseExample example = test::rs16_example();
  example.packet.head.clear();
  example.device.rs16_deg.clear();
  example.device.speed = 0;
  example.packet_us = 0.0;  // the clock stands
  EXPECT_TRUE(
      contains(told(example), "nothing tells which: it may be a RoboSense RS-LiDAR-16 or RoboSense RS-LiDAR-32"));
  EXPECT_EQ(told(example, "robosense_rs16"), kind_of("robosense_rs16"));
  EXPECT_TRUE(contains(told(example, "robosense_rs32"), "does not say where its lasers point"));
}

TEST(RoboSenseKinds, WhereTheClockStandsSpeedAndAzimuthsTell) {
  for (RoboSenseExample example : test::robosense_examples()) {
    example.packet_us = 0.0;
    EXPECT_EQ(told(example), kind_of(example.word));
    example.device.speed = 480;
    EXPECT_NE(told(example), kind_of(example.word)) << example.word;
  }
}

TEST(RoboSenseKinds, LostPacketsDoNotMakeAnotherSensor) {
  const RoboSenseExample example = test::rs32_example();
  const std::unique_ptr<ScanAssembler> assembler = make_assembler({});
  add(*assembler, payload_of(example.device));
  const std::vector<std::string> data = robosense_data(example, 40);
  for (std::size_t i = 0; i < data.size(); i += 2) EXPECT_TRUE(add(*assembler, data[i]));
  EXPECT_EQ(assembler->kind(), kind_of(example.word));
}

#if POSE_WALL_HAS_PCAP

TEST(RoboSenseKinds, ACaptureIsReadWithItsDevicePacketOrASavedOne) {
  const TempFolder folder;
  for (const RoboSenseExample& example : test::robosense_examples()) {
    std::vector<std::string> data = robosense_data(example, 500);
    const std::string alone = folder.write("alone.pcap", capture_of(data));
    const std::string saved = folder.write("device.bin", payload_of(example.device));
    const test::ReadCapture with_saved = read(alone, {"", saved});
    data.insert(data.begin() + 250, payload_of(example.device));
    const test::ReadCapture both = read(folder.write("both.pcap", capture_of(data)));
    ASSERT_TRUE(both.errors.empty()) << both.errors.front();
    ASSERT_TRUE(with_saved.errors.empty()) << with_saved.errors.front();
    EXPECT_GE(both.frames.size(), 2U) << example.word;
    EXPECT_EQ(both.frames.size(), with_saved.frames.size()) << example.word;
    EXPECT_EQ(both.about.kind, kind_of(example.word));
    const std::string brief = folder.write("brief.pcap", capture_of(robosense_data(example, 20)));
    EXPECT_TRUE(contains(refusal_of(read(brief)), "no device packet of it (DIFOP, port 7788)"));
    EXPECT_TRUE(contains(refusal_of(read(brief, {example.word, ""})), "port 7788"));
  }
}

TEST(RoboSenseKinds, DevicePacketsAloneAreNamed) {
  const TempFolder folder;
  const std::string device = payload_of(test::rs32_example().device);
  EXPECT_TRUE(contains(refusal_of(read(folder.write("d.pcap", capture_of({device, device})))),
                       "but none of its data (MSOP, port 6699)"));
}

TEST(RoboSenseKinds, MetadataThatIsOfAnotherSensorIsRefused) {
  const TempFolder folder;
  RoboSenseExample example = test::rs32_example();
  std::vector<std::string> data = robosense_data(example, 10);
  data.push_back(payload_of(example.device));
  const std::string capture = folder.write("c.pcap", capture_of(data));
  example.device.serial = 0x0102030405;
  const std::string saved = folder.write("device.bin", payload_of(example.device));
  EXPECT_TRUE(contains(refusal_of(read(capture, {"", saved})), "000102030405, but the packets are of 1A2B3C4D5E6F"));
  const std::string text = folder.write("t.txt", "hello");
  EXPECT_TRUE(contains(refusal_of(read(capture, {"robosense_rs32", text})), "device packets: 1248 bytes"));
  test::VelodynePacket packet;
  const std::string velodyne = folder.write("v.pcap", capture_of(std::vector<std::string>(8, payload_of(packet))));
  EXPECT_TRUE(contains(refusal_of(read(velodyne, {"", saved})), "the packets are of another sensor"));
}

TEST(RoboSenseKinds, WhatIsNotReadIsNamed) {
  const TempFolder folder;
  std::string ruby(1248, '\0'), e1(1200, '\0');
  test::put_at(&ruby, 0, "\x55\xAA\x05\x5A");
  ruby[42] = '\xFE';
  test::put_at(&e1, 0, "\x55\xAA\x5A\xA5");
  EXPECT_TRUE(contains(refusal_of(read(folder.write("r.pcap", capture_of({ruby})))), "data of a RoboSense Ruby"));
  EXPECT_TRUE(contains(refusal_of(read(folder.write("e.pcap", capture_of({e1})))), "RoboSense M2, M3, MX, E1"));
}

#endif

// As rslidar_sdk writes them: a message for each packet, of data or of the device.
std::string packet_message(const std::string& payload, MessageEncoding encoding, std::uint32_t us) {
  const char is_device = payload[0] == '\xA5' ? '\1' : '\0';
  const std::string flags{is_device, '\0'};
  if (encoding == MessageEncoding::kRos1) {
    return test::raw(9U) + test::raw(1'700'000'000U) + test::raw(1000 * us) + test::with_length("lidar") + flags +
           test::with_length(payload);
  }
  test::CdrWriter cdr(false);
  cdr.put(std::int32_t{1'700'000'000});
  cdr.put(std::uint32_t{1000 * us});
  cdr.put_text("lidar");
  cdr.put_bytes(flags);
  cdr.put_block(payload);
  return cdr.text();
}

TEST(RoboSenseKinds, ABagOfTheDriversPacketsIsRead) {
  const test::TempFolder folder;
  const RoboSenseExample example = test::rs32_example();
  std::vector<std::string> payloads = robosense_data(example, 400, 90.0);
  payloads.insert(payloads.begin() + 200, payload_of(example.device));
  std::vector<test::WrittenMessage> ros1, cdr;
  for (std::uint32_t i = 0; i < payloads.size(); ++i) {
    ros1.push_back({0, packet_message(payloads[i], MessageEncoding::kRos1, 666 * i)});
    cdr.push_back({0, packet_message(payloads[i], MessageEncoding::kCdr, 666 * i)});
  }
  const std::string bag = folder.write("a.bag", test::ros1_bag({{"/packets", "rslidar_msg/RslidarPacket"}}, ros1));
  const std::string mcap =
      folder.write("a.mcap", test::mcap({{"/packets", "rslidar_msg/msg/RslidarPacket"}}, cdr, nullptr));
  for (const std::string& file : {bag, mcap}) {
    const test::ReadCapture read = test::read(file);
    ASSERT_TRUE(read.errors.empty()) << read.errors.front();
    EXPECT_EQ(read.frames.size(), 1U) << "a whole turn between two that are not";
    EXPECT_TRUE(contains(read.about.kind, kind_of(example.word))) << read.about.kind;
  }
  const std::string cut = packet_message(payloads[0], MessageEncoding::kRos1, 0).substr(0, 100);
  EXPECT_THROW(decode_packets("rslidar_msg/RslidarPacket", MessageEncoding::kRos1, test::view_of(cut)), FrameError);
}

// By the kind that it is taken for a point lies where its number says. Bytes that tell unit or kind are changed, too.
TEST(RoboSenseKinds, ChangedBytesNeverGiveAnotherUnit) {
  std::minstd_rand random(7);
  const auto any = [&](std::size_t below) { return static_cast<std::size_t>(random()) % below; };
  std::size_t accepted = 0;
  for (int round = 0; round < 3000; ++round) {
    RoboSenseExample example = test::robosense_examples()[any(7)];
    std::vector<std::string> payloads = robosense_data(example, 6, 90.0);
    payloads.insert(payloads.begin(), payload_of(example.device));
    for (std::size_t changes = 1 + any(3); changes > 0; --changes) {
      std::string& payload = payloads[any(2)];
      const std::size_t at = &payload == payloads.data() ? any(1248) : any(42);
      payload[at] = static_cast<char>(any(256));
      if (&payload == &payloads[1]) {
        for (std::size_t i = 2; i < payloads.size(); ++i) payloads[i][at] = payload[at];
      }
    }
    RoboSenseAssembler assembler(std::nullopt);
    try {
      for (const std::string& payload : payloads) add(assembler, payload);
      assembler.finish();
    } catch (const FrameError& refused) {
      EXPECT_FALSE(std::string(refused.what()).empty());
      continue;
    }
    const std::optional<Scan> scan = assembler.take();
    if (!scan) continue;
    ++accepted;
    EXPECT_EQ(assembler.kind(), kind_of(example.word));
    const bool is_half = contains(example.word, "helios") || example.word == "robosense_bpearl4";
    const double range_m = is_half ? 5.0 : 10.0;
    for (const ScanPoint& point : scan->points) {
      ASSERT_NEAR(std::hypot(point.x_m, point.y_m, point.z_m), range_m, 0.11) << example.word;
    }
  }
  EXPECT_GT(accepted, 1000U);
}

}  // namespace
}  // namespace pose_wall::tools
