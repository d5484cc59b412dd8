// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the sensor of packets is told by its first packets or by its name, alike for captures and for datagrams that
// are handed over one by one, with the same bits; names, metadata and packets that do not fit each other are refused
// with what was looked for and what is there.

#include <gtest/gtest.h>

#if POSE_WALL_HAS_PCAP

#include "io/packets/sensors.hpp"
#include "packet_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

struct Example {
  SensorKind kind;
  std::vector<std::string> payloads;
  const char* told = nullptr;  // by them, where that is not the model
};

test::HesaiPacket hesai(std::size_t lasers, std::size_t blocks) {
  test::HesaiPacket packet;
  packet.lasers = lasers;
  packet.blocks = blocks;
  packet.step_deg = 360.0 / static_cast<double>(blocks + 1);
  return packet;
}

test::HesaiPacket xt32m() {
  test::HesaiPacket packet = hesai(32, 6);
  packet.unit_mm = 5;
  return packet;
}

std::vector<std::string> mid360() {
  std::vector<std::string> payloads;
  for (std::uint64_t i = 0; i < 30; ++i) {
    payloads.push_back(
        test::mid360_payload(1, i * 10'000'000, {raw(1000) + raw(2000) + raw(static_cast<int>(i)) + "\x2A\x01"}));
  }
  return payloads;
}

// Packets of each sensor that name it, more than two turns or frames.
std::vector<Example> examples() {
  std::vector<Example> examples;
  for (const auto& [kind, product] : {std::pair(SensorKind::kVlp16, 0x22), std::pair(SensorKind::kVlp16HiRes, 0x24),
                                      std::pair(SensorKind::kHdl32e, 0x21), std::pair(SensorKind::kVlp32c, 0x28)}) {
    test::VelodynePacket packet;
    packet.product = static_cast<std::uint8_t>(product);
    examples.push_back({kind, std::vector<std::string>(8, payload_of(packet))});
  }
  for (const auto& [kind, packet] :
       {std::pair(SensorKind::kHesaiXt32, hesai(32, 8)), std::pair(SensorKind::kHesai40p, hesai(40, 10)),
        std::pair(SensorKind::kHesaiQt64, hesai(64, 4)), std::pair(SensorKind::kHesaiXt16, hesai(16, 8)),
        std::pair(SensorKind::kHesaiXt32m, xt32m()), std::pair(SensorKind::kHesaiQt128, hesai(128, 2)),
        std::pair(SensorKind::kHesaiPandar64, hesai(64, 6))}) {
    examples.push_back({kind, std::vector<std::string>(3, payload_of(packet))});
  }
  examples.push_back({SensorKind::kMid360, mid360(), "Livox Mid-360, Mid-360S, HAP or Avia 2"});
  return examples;
}

TEST(Sensors, EachIsToldByItsPacketsAndReadByItsName) {
  const TempFolder folder;
  for (const Example& example : examples()) {
    const KnownSensor& sensor = known_sensor(example.kind);
    const std::string title = example.told != nullptr ? example.told : sensor.title;
    EXPECT_EQ(recognised_title({0, {}, test::view_of(example.payloads.front())}), title);
    const std::string file = folder.write("c.pcap", capture_of(example.payloads));
    const ReadCapture told = read(file), named = read(file, {sensor.name, ""}), automatic = read(file, {"auto", ""});
    ASSERT_TRUE(told.errors.empty()) << told.errors.front();
    EXPECT_EQ(told.about.kind, "packets of a " + title);
    EXPECT_EQ(named.about.kind, std::string("packets of a ") + sensor.title);
    EXPECT_GE(told.frames.size(), 2U) << sensor.name;
    ASSERT_EQ(told.frames.size(), named.frames.size());
    EXPECT_EQ(told.frames.size(), automatic.frames.size());
    for (std::size_t i = 0; i < told.frames.size(); ++i) {
      EXPECT_EQ(told.frames[i].frame->bytes, named.frames[i].frame->bytes) << sensor.name;
    }
  }
}

TEST(Sensors, DatagramsHandedOverOneByOneGiveTheBitsOfTheCapture) {
  const TempFolder folder;
  for (const Example& example : examples()) {
    const ReadCapture recorded = read(folder.write("c.pcap", capture_of(example.payloads)));
    const std::unique_ptr<ScanAssembler> live = make_assembler({});
    std::vector<Scan> scans;
    const auto take_all = [&] {
      while (std::optional<Scan> scan = live->take()) scans.push_back(std::move(*scan));
    };
    for (std::size_t i = 0; i < example.payloads.size(); ++i) {
      const std::int64_t captured_ns = 1'700'000'000'000'000'000 + static_cast<std::int64_t>(i) * 1'000'000;
      EXPECT_TRUE(add(*live, example.payloads[i], captured_ns));
      EXPECT_FALSE(add(*live, "something else", captured_ns));
      take_all();
    }
    live->finish();
    take_all();
    ASSERT_GE(scans.size(), recorded.frames.size());
    for (std::size_t i = 0; i < recorded.frames.size(); ++i) {
      EXPECT_EQ(frame_of(scans[i]).bytes, recorded.frames[i].frame->bytes) << known_sensor(example.kind).name;
      EXPECT_EQ(scans[i].stamp_ns, *recorded.frames[i].stamp_ns);
    }
  }
}

TEST(Sensors, PacketsOfAnotherSensorAreNamed) {
  const TempFolder folder;
  const std::string velodyne = folder.write("v.pcap", capture_of({payload_of(test::VelodynePacket{})}));
  const std::string hesai_file = folder.write("h.pcap", capture_of({payload_of(hesai(32, 8))}));
  EXPECT_TRUE(contains(refusal_of(read(velodyne, {"hesai_xt32", ""})),
                       "no data packets of a Hesai PandarXT-32 (hesai_xt32); there are packets of a Velodyne VLP-16"));
  EXPECT_TRUE(contains(refusal_of(read(hesai_file, {"vlp16", ""})), "there are packets of a Hesai PandarXT-32"));
  EXPECT_TRUE(contains(refusal_of(read(hesai_file, {"hesai_qt64", ""})), "there are packets of a Hesai PandarXT-32"));
  EXPECT_TRUE(contains(refusal_of(read(hesai_file, {"hesai_xt32m", ""})), "there are packets of a Hesai PandarXT-32"));
  const std::string xt32m_file = folder.write("m.pcap", capture_of({payload_of(xt32m())}));
  EXPECT_TRUE(
      contains(refusal_of(read(xt32m_file, {"hesai_xt32", ""})), "there are packets of a Hesai PandarXT-32M2X"));
  const std::string byte_and_name = refusal_of(read(velodyne, {"hdl32e", ""}));
  EXPECT_TRUE(contains(byte_and_name, "HDL-32E (hdl32e)") && contains(byte_and_name, "VLP-16")) << byte_and_name;
}

TEST(Sensors, WhatIsKnownAndNotReadIsNamed) {
  const TempFolder folder;
  const std::string none = payload_of(hesai(16, 2));
  const std::string refused = refusal_of(read(folder.write("x.pcap", capture_of({none}))));
  EXPECT_TRUE(contains(refused, "data of a Hesai of 16 lasers in 2 blocks, which is not read")) << refused;
  EXPECT_TRUE(contains(refused, "of a sensor that is read (--help lists them)")) << refused;
  EXPECT_FALSE(contains(refused, "Ouster")) << "nothing tells of one";
  std::string ot128 = payload_of(hesai(128, 2));
  ot128.replace(2, 3, "\x01\x04\x80");
  EXPECT_TRUE(contains(refusal_of(read(folder.write("x.pcap", capture_of({ot128})))), "data of a Hesai OT128, which"));
  std::string vls128 = payload_of(test::VelodynePacket{});
  vls128[100] = '\xFF';
  vls128[101] = '\xDD';
  EXPECT_TRUE(contains(refusal_of(read(folder.write("x.pcap", capture_of({vls128})))), "64 or 128 lasers"));
}

std::string angles() {
  std::string text = "Laser id,Elevation,Azimuth\n";
  for (int i = 1; i <= 32; ++i) text += std::to_string(i) + "," + std::to_string(20 - i) + ",0\n";
  return text;
}

TEST(Sensors, MetadataHasToBeOfTheSensor) {
  const TempFolder folder;
  const std::string xt32 = folder.write("h.pcap", capture_of({payload_of(hesai(32, 8))}));
  const std::string qt64 = folder.write("q.pcap", capture_of({payload_of(hesai(64, 4))}));
  const std::string velodyne = folder.write("v.pcap", capture_of({payload_of(test::VelodynePacket{})}));
  const std::string csv = folder.write("angles.csv", angles()), braces = folder.write("o.json", "{}");
  const ReadCapture own = read(xt32, {"", csv});
  ASSERT_EQ(own.frames.size(), 1U);
  EXPECT_NE(own.frames.front().frame->bytes, read(xt32).frames.front().frame->bytes);
  EXPECT_EQ(own.frames.front().frame->bytes, read(xt32, {"hesai_xt32", csv}).frames.front().frame->bytes);

  EXPECT_TRUE(contains(refusal_of(read(qt64, {"", csv})), "has no laser 33; 64 are needed"));
  EXPECT_TRUE(contains(refusal_of(read(qt64, {"hesai_qt64", csv})), "angles.csv: the table of angles has no laser 33"));
  EXPECT_TRUE(contains(refusal_of(read(velodyne, {"", csv})), "the packets are of a sensor that has none"));
  EXPECT_TRUE(contains(refusal_of(read(velodyne, {"vlp16", csv})), "a Velodyne VLP-16 (vlp16) has none"));
  EXPECT_TRUE(contains(refusal_of(read(xt32, {"hesai_xt32", braces})), "the metadata is JSON, as of an Ouster"));
  EXPECT_TRUE(contains(refusal_of(read(xt32, {"ouster", ""})),
                       "no data packets of an Ouster (ouster); there are packets of a Hesai PandarXT-32"));
  const std::string like_an_ouster = folder.write("l.pcap", capture_of({std::string(12'608, 'x')}));
  for (const char* name : {"ouster", ""}) {
    const std::string told = refusal_of(read(like_an_ouster, {name, ""}));
    EXPECT_TRUE(contains(told, "l.json") && contains(told, "--metadata")) << told;
  }
  EXPECT_TRUE(contains(refusal_of(read(xt32, {"", braces})), "o.json: the metadata has no 'data_format'"));
  EXPECT_TRUE(contains(refusal_of(read(xt32, {"", folder.write("t.txt", "hello")})), "neither a JSON object"));
  EXPECT_TRUE(contains(refusal_of(read(xt32, {"", folder.write("e.csv", "")})), "the file is empty"));
  EXPECT_TRUE(contains(refusal_of(read(xt32, {"", folder.file("gone.csv")})), "cannot be opened"));
  EXPECT_TRUE(contains(refusal_of(read(xt32, {"", folder.write("big.csv", std::string(1'000'001, 'x'))})),
                       "more than 1000000 bytes"));
}

TEST(Sensors, NamesAreTheTables) {
  const TempFolder folder;
  const std::string file = folder.write("h.pcap", capture_of({payload_of(hesai(32, 8))}));
  EXPECT_TRUE(
      contains(refusal_of(read(file, {"hesai_xt23", ""})), "did you mean 'hesai_xt32'?; known are auto, vlp16"));
  ASSERT_EQ(known_sensors().size(), static_cast<std::size_t>(SensorKind::kHesaiPandar64) + 1);
  for (std::size_t i = 0; i < known_sensors().size(); ++i) {
    const KnownSensor& sensor = known_sensors()[i];
    EXPECT_EQ(static_cast<std::size_t>(sensor.kind), i);
    EXPECT_EQ(sensor_by_name(sensor.name), sensor.kind);
    EXPECT_EQ(sensor.port == 0, sensor.kind == SensorKind::kAutomatic);
  }
  EXPECT_FALSE(sensor_by_name(""));
}

TEST(Sensors, ANameIsOfNoUseWithoutPackets) {
  const TempFolder folder;
  InputOptions options;
  options.packets.sensor = "vlp16";
  const std::string frame = folder.write("a.bin", std::string(16, '\0'));
  EXPECT_THROW(FrameSequence({frame}, options), std::invalid_argument);
}

}  // namespace
}  // namespace pose_wall::tools

#endif
