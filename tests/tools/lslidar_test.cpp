// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: packets of LSLidar's spinning sensors give points where the maker's angles, units and lenses put them, at
// their times. Both are worked out by hand. What a packet alone does not tell is taken from device packets. Where none
// came, or what they say cannot be, the sensor is refused with the port that is missing.

#include <gtest/gtest.h>

#include <random>

#include "io/packets/one_sender.hpp"
#include "io/packets/sensors.hpp"
#include "lslidar_packets.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

std::unique_ptr<ScanAssembler> lslidar_named(const char* name = "auto") {
  SensorChoice choice;
  choice.kind = sensor_by_name(name).value();
  return make_assembler(choice);
}

// The first scan of what is handed over, a packet each 1.2 ms; or the reason of a refusal.
struct LslidarRead {
  std::vector<Scan> scans;
  std::string refusal, kind;
};

LslidarRead read_lslidar(const std::vector<std::string>& payloads, const char* name = "auto",
                         std::int64_t packet_ns = 1'200'000) {
  OneSender assembler([name] { return lslidar_named(name); });  // as all that reads packets
  LslidarRead read;
  try {
    std::int64_t captured_ns = 1'000'000'000'000;
    for (const std::string& payload : payloads) {
      add(assembler, payload, captured_ns);
      captured_ns += packet_ns;
    }
    assembler.finish();
  } catch (const FrameError& refused) {
    read.refusal = refused.what();
  }
  while (std::optional<Scan> scan = assembler.take()) read.scans.push_back(std::move(*scan));
  read.kind = assembler.kind();
  return read;
}

std::string refusal_of_lslidar(const std::vector<std::string>& payloads, const char* name = "auto") {
  const LslidarRead read = read_lslidar(payloads, name);
  EXPECT_TRUE(read.scans.empty() || read.refusal.empty());
  return read.refusal.empty() ? "read" : read.refusal;
}

// A fifth of a turn around azimuth 90, of which block 2 of the first packet is at 90 degrees, and a device packet.
std::vector<std::string> at_right(LslidarPacket packet, const std::string& device = "",
                                  std::uint32_t clock_step = 1200) {
  packet.first_deg = 90.0 - 2.0 * packet.step_deg;
  std::vector<std::string> payloads = lslidar_turns(packet, 8, clock_step);
  if (!device.empty()) payloads.insert(payloads.begin(), device);
  return payloads;
}

// The point of a laser, in the order of firing, in the first firing of the block at 90 degrees.
ScanPoint point_at_right(const LslidarRead& read, std::size_t laser, std::size_t lasers) {
  EXPECT_EQ(read.refusal, "");
  EXPECT_EQ(read.scans.size(), 1U);
  if (read.scans.empty()) return {};
  const Scan& scan = read.scans.front();
  EXPECT_EQ(scan.rings, lasers);
  // Its own time tells which of the firing it is.
  const std::size_t column = 2 * 32 / lasers;
  const std::uint32_t first_ns = point_at(scan, 0, column).t_ns;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_time;
  for (std::uint32_t ring = 0; ring < scan.rings; ++ring) {
    by_time.push_back({point_at(scan, ring, column).t_ns, ring});
  }
  EXPECT_GE(first_ns, by_time.front().first);
  std::sort(by_time.begin(), by_time.end());
  return point_at(scan, by_time.at(laser).second, column);
}

const std::string kDeviceOfC16 = LslidarDevice{}.set_words(245, test::c16_angles()).set(1202, 3).bytes;

TEST(Lslidar, PointsOfAC16OfFirmware3LieWhereItsDevicePacketPutsThem) {
  const LslidarRead read = read_lslidar(at_right({}, kDeviceOfC16));
  EXPECT_EQ(read.kind, "packets of an LSLidar C16, firmware 2 or 3");
  // 4000 times 2.5 mm; the lens stands 43.1 mm out, 14.68 degrees behind.
  expect_at(point_at_right(read, 0, 16), 0.010922, -9.700951, -2.588190);
  expect_at(point_at_right(read, 15, 16), -0.017649, -9.700941, 2.588190);
  EXPECT_EQ(point_at_right(read, 0, 16).intensity, 42.0F);
  EXPECT_EQ(point_at_right(read, 0, 16).ring, 0U);
  EXPECT_EQ(point_at_right(read, 15, 16).ring, 15U);
}

TEST(Lslidar, AngleOfEachLaserIsTheDevicePackets) {
  std::vector<int> angles = test::c16_angles();
  angles[0] = -1425;
  expect_at(point_at_right(read_lslidar(at_right({}, LslidarDevice{}.set_words(245, angles).bytes)), 0, 16), 0.010922,
            -9.734002, -2.461533);
  const std::string of_firmware_2 = LslidarDevice{}.set_words(234, angles).set(1202, 2).bytes;
  expect_at(point_at_right(read_lslidar(at_right({}, of_firmware_2)), 0, 16), 0.010922, -9.734002, -2.461533);
}

TEST(Lslidar, TheC16OfTenDegreesIsToldByItsDevicePacketAlone) {
  const std::string device = LslidarDevice{}.set_words(245, test::narrow_c16_angles()).bytes;
  expect_at(point_at_right(read_lslidar(at_right({}, device)), 0, 16), 0.010922, -9.889771, -1.736482);
  expect_at(point_at_right(read_lslidar(at_right({}), "lslidar_c16_10deg"), 0, 16), 0.010922, -9.889771, -1.736482);
  expect_at(point_at_right(read_lslidar(at_right({}), "lslidar_c16_15deg"), 0, 16), 0.010922, -9.700951, -2.588190);
}

TEST(Lslidar, AC16OfFirmware3WithoutItsDevicePacketIsRefused) {
  for (const char* name : {"auto", "lslidar_c16"}) {
    const std::string refused = refusal_of_lslidar(at_right({}), name);
    EXPECT_TRUE(contains(refused, "2369") && contains(refused, "lslidar_c16_15deg")) << refused;
  }
  // Live, where nothing ends: after two seconds.
  const std::unique_ptr<ScanAssembler> assembler = lslidar_named();
  std::int64_t captured_ns = 0;
  const auto add_a_second = [&] {
    for (const std::string& payload : lslidar_turns({}, 833, 1200)) add(*assembler, payload, captured_ns += 1'200'000);
  };
  EXPECT_NO_THROW(add_a_second());
  EXPECT_FALSE(assembler->take());
  EXPECT_THROW(
      {
        add_a_second();
        add_a_second();
      },
      FrameError);
}

TEST(Lslidar, DataBeforeTheDevicePacketIsKept) {
  std::vector<std::string> before = lslidar_turns({}, 200, 1200), after = before;
  before.insert(before.begin(), kDeviceOfC16);
  after.insert(after.begin() + 150, kDeviceOfC16);
  const LslidarRead first = read_lslidar(before, "lslidar_c16"), last = read_lslidar(after, "lslidar_c16");
  ASSERT_EQ(first.scans.size(), last.scans.size());
  ASSERT_EQ(first.scans.size(), 3U);
  EXPECT_EQ(frame_of(first.scans[0]).bytes, frame_of(last.scans[0]).bytes);
}

TEST(Lslidar, ANameThatTheDevicePacketContradictsIsRefused) {
  const std::string narrow = LslidarDevice{}.set_words(245, test::narrow_c16_angles()).bytes;
  EXPECT_TRUE(contains(refusal_of_lslidar(at_right({}, narrow), "lslidar_c16_15deg"), "its device packet says 10"));
  EXPECT_TRUE(contains(refusal_of_lslidar(at_right({}, kDeviceOfC16), "lslidar_c16_10deg"), "device packet says 15"));
  // Where it was not written the name decides, and without a name nobody.
  EXPECT_EQ(refusal_of_lslidar(at_right({}, LslidarDevice{}.bytes), "lslidar_c16_15deg"), "read");
  EXPECT_TRUE(contains(refusal_of_lslidar(at_right({}, LslidarDevice{}.bytes)), "holds no angles"));
}

// The maker's newer driver records packets of 1206 bytes in messages of 1212.
TEST(Lslidar, ZerosBehindAPacketAreNoOtherKind) {
  std::vector<std::string> payloads = at_right({}, kDeviceOfC16), longer = payloads;
  for (std::string& payload : longer) payload += std::string(6, '\0');
  const LslidarRead one = read_lslidar(payloads), other = read_lslidar(longer);
  ASSERT_EQ(one.scans.size(), 1U);
  ASSERT_EQ(other.scans.size(), 1U);
  EXPECT_EQ(frame_of(one.scans[0]).bytes, frame_of(other.scans[0]).bytes);
}

struct LaterKind {
  std::uint8_t byte;
  std::size_t laser, lasers;
  double x_m, y_m, z_m;
  const char* name;
};

TEST(Lslidar, PointsOfFirmware4And5LieWhereTheDesignPutsThem) {
  const LaterKind kinds[] = {{0x10, 0, 16, 0.012495, -9.646486, -2.756374, "lslidar_c16"},
                             {0x10, 1, 16, 0.010525, -10.033871, 0.0, "lslidar_c16"},
                             {0x12, 1, 16, 0.010544, -9.936552, -1.391731, "lslidar_c16"},
                             {0x65, 2, 16, 0.009096, -9.935182, -1.391731, "lslidar_c16"},
                             {0x20, 0, 32, 0.012495, -9.646486, -2.756374, "lslidar_c32"},
                             {0x64, 1, 32, 0.011028, -10.032499, 0.0, "lslidar_c32"},
                             {0x46, 6, 32, -0.675924, -9.941623, -1.159773, "lslidar_c32w"},
                             {0x5A, 3, 32, 0.007595, -3.631653, 9.324437, "lslidar_ch32r"},
                             {0x08, 1, 8, 0.010529, -10.009511, 0.697565, "lslidar_c8"}};
  for (const LaterKind& kind : kinds) {
    LslidarPacket packet;
    packet.is_first_kind = false;
    packet.model = kind.byte;
    packet.distance = [](std::size_t, std::size_t) { return std::uint16_t{2500}; };  // 4 mm each
    for (const char* name : {"auto", kind.name}) {
      SCOPED_TRACE(::testing::Message() << static_cast<int>(kind.byte) << ' ' << name);
      expect_at(point_at_right(read_lslidar(at_right(packet), name), kind.laser, kind.lasers), kind.x_m, kind.y_m,
                kind.z_m);
    }
    EXPECT_TRUE(contains(refusal_of_lslidar(at_right(packet), "lslidar_ch128x1"), "read"));
    EXPECT_TRUE(contains(refusal_of_lslidar(at_right(packet), "lslidar_c16_10deg"), "is said to be")) << kind.name;
  }
}

// A packet's time is that of its end. The clock's unit is told by the time mode, which packets do not hold: by how far
// the clock goes in one.
TEST(Lslidar, TimesAreThoseOfTheSensorsClockBackFromThePacketsEnd) {
  LslidarPacket packet;
  packet.is_first_kind = false;
  std::vector<std::vector<std::string>> inputs = {at_right(packet, "", 1160), at_right(packet, "", 1'160'000)};
  inputs.push_back(inputs[0]);
  inputs[2][3] = "one was lost";
  for (const std::vector<std::string>& input : inputs) {
    const LslidarRead read = read_lslidar(input, "auto", 1'160'000);
    ASSERT_EQ(read.scans.size(), 1U);
    const Scan& scan = read.scans.front();
    EXPECT_EQ(scan.stamp_ns, 1'000'000'000'000 - 1'160'000);
    for (std::size_t firing = 0; firing < 48; ++firing) {
      EXPECT_NEAR(point_at(scan, 0, firing).t_ns, 1'160'000.0 / 24.0 * static_cast<double>(firing), 3.0) << firing;
    }
    EXPECT_NEAR(point_at(scan, 15, 0).t_ns, 1'160'000.0 / 24.0 / 16.0 * 15.0, 3.0);
  }
  const LslidarRead still = read_lslidar(at_right(packet, "", 0));
  EXPECT_EQ(still.scans.at(0).stamp_ns, 1'000'000'000'000 - 1'200'000) << "by the design";
}

TEST(Lslidar, OfTwoReturnsTheFartherIsTaken) {
  for (const std::size_t farther : {0U, 1U}) {
    LslidarPacket packet;
    packet.is_first_kind = false;
    packet.mode = 0x39;
    packet.distance = [farther](std::size_t block, std::size_t) {
      return std::uint16_t(block % 2 == farther ? 2500 : 1000);
    };
    const LslidarRead read = read_lslidar(at_right(packet, "", 600), "auto", 600'000);
    ASSERT_EQ(read.scans.size(), 1U);
    EXPECT_EQ(read.scans[0].points.size(), 8U * 6U * 2U * 16U);
    expect_at(point_at_right(read, 0, 16), 0.012495, -9.646486, -2.756374);
    EXPECT_EQ(read.scans[0].stamp_ns, 1'000'000'000'000 - 600'000);
  }
}

LslidarDevice device_of_c32() {
  return LslidarDevice{}.set_words(245, test::c32_angles()).set(1202, 3).set(1203, 0x50);
}

std::vector<std::string> c32_at_right(const LslidarDevice& device, std::uint16_t distance) {
  LslidarPacket packet;
  packet.model = 0x20;
  packet.distance = [distance](std::size_t, std::size_t) { return distance; };
  return at_right(packet, device.bytes, 590);
}

TEST(Lslidar, UnitAndColumnsOfAC32OfFirmware3AreItsDevicePackets) {
  const auto expect_ten_metres = [](const LslidarRead& read) {
    expect_at(point_at_right(read, 0, 32), -0.410311, -9.652044, -2.756374);  // 2.5 degrees on
    expect_at(point_at_right(read, 2, 32), 0.261391, -9.703882, -2.588190);   // 1.5 degrees back
  };
  // Both of the maker's ways to write -1.5 degrees.
  for (const int back : {0xFF6A, 0x8096}) {
    LslidarDevice device = device_of_c32();
    device.set_words(186, {back}).set_words(190, {250});
    expect_ten_metres(read_lslidar(c32_at_right(device, 2500)));
    expect_ten_metres(read_lslidar(c32_at_right(device.set(1203, 0x4F), 4000), "lslidar_c32"));
  }
  // The newer driver has the lower half of the angles first.
  std::vector<int> in_halves;
  for (int i = -16; i < 16; ++i) in_halves.push_back(100 * i);
  LslidarDevice device = device_of_c32().set_words(245, in_halves);
  expect_ten_metres(read_lslidar(c32_at_right(device.set_words(186, {0xFF6A}).set_words(190, {250}), 2500)));
}

TEST(Lslidar, AC32OfFirmware3WhoseDevicePacketDoesNotTellIsRefused) {
  LslidarPacket packet;
  packet.model = 0x20;
  const std::string refused = refusal_of_lslidar(at_right(packet));
  EXPECT_TRUE(contains(refused, "2369") && contains(refused, "2.5 or 4 mm")) << refused;
  EXPECT_TRUE(contains(refusal_of_lslidar(c32_at_right(device_of_c32().set(1202, 2), 2500)), "of firmware 2"));
  EXPECT_TRUE(
      contains(refusal_of_lslidar(c32_at_right(device_of_c32().set_words(245, {0}), 2500)), "no angles within"));
  EXPECT_TRUE(contains(refusal_of_lslidar(c32_at_right(device_of_c32().set_words(186, {0x4000}), 2500)), "0x4000"));
  EXPECT_TRUE(
      contains(refusal_of_lslidar(c32_at_right(device_of_c32().set_words(190, {100}), 2500)), "1.00 degrees apart"));
}

TEST(Lslidar, AVelodynesNameIsRefusedAndItsOwnNamedForIt) {
  EXPECT_TRUE(contains(refusal_of_lslidar(at_right({}), "vlp16"), "LSLidar C16"));
  EXPECT_EQ(recognise_sensor(test::view_of(payload_of(LslidarPacket{}))), SensorKind::kLslidarC16);
}

TEST(Lslidar, KindsThatAreNotReadAreNamed) {
  const auto unread = [](std::uint8_t byte) {
    LslidarPacket packet;
    packet.is_first_kind = false;
    packet.model = byte;
    return unread_sensor(test::view_of(payload_of(packet)));
  };
  EXPECT_EQ(unread(0x01), "an LSLidar C1 of one line");
  EXPECT_EQ(unread(0x06), "an LSLidar N301 of one line");
  EXPECT_EQ(unread(0x11), "an LSLidar MS-C16");
  EXPECT_EQ(unread(0x99), "an LSLidar of a kind that is not known (0x99)");
  EXPECT_EQ(unread(0x10), "");
  EXPECT_EQ(unread_sensor(test::view_of(kDeviceOfC16)), "");
  OneSender alone([] { return lslidar_named(); });
  EXPECT_FALSE(add(alone, kDeviceOfC16));
  alone.finish();
  EXPECT_TRUE(contains(alone.hint(), "describes itself") && contains(alone.hint(), "none of its data")) << alone.hint();
}

TEST(Lslidar, WhatTheSensorItselfLeavesOutIsSaid) {
  LslidarPacket packet;
  packet.is_first_kind = false;
  EXPECT_EQ(read_lslidar(at_right(packet, LslidarDevice{}.set(110, 2).bytes)).kind,
            "packets of an LSLidar C16, firmware 4, which removes rain, fog and dust (level 2)");
  EXPECT_EQ(read_lslidar(at_right(packet, LslidarDevice{}.bytes)).kind, "packets of an LSLidar C16, firmware 4");
  packet.model = 0x65;
  EXPECT_TRUE(
      contains(read_lslidar(at_right(packet, LslidarDevice{}.set(51, 3).bytes)).kind, "removes tails (level 3)"));
}

// Bytes that changed on the way end in a refusal or in points of the sensor's range: never in another unit.
TEST(Lslidar, DamagedPacketsAreRefusedOrKeepTheirUnit) {
  std::mt19937 random(7);
  std::size_t read_packets = 0;
  for (int round = 0; round < 300; ++round) {
    LslidarPacket packet;
    packet.is_first_kind = round % 2 == 0;
    packet.model = round % 3 == 0 ? 0x20 : 0x10;
    const std::string device = round % 3 == 0 ? device_of_c32().bytes : kDeviceOfC16;
    std::vector<std::string> payloads = at_right(packet, device);
    for (int change = 0; change < 20; ++change) {
      std::string& payload = payloads[random() % payloads.size()];
      payload[random() % payload.size()] = static_cast<char>(random());
      if (random() % 8 == 0) payload.resize(random() % 1300);
    }
    for (const Scan& scan : read_lslidar(payloads).scans) {
      ASSERT_EQ(scan.points.size() % scan.rings, 0U);
      for (const ScanPoint& point : scan.points) {
        const double range_m = std::hypot(point.x_m, point.y_m, point.z_m);
        const bool is_as_sent = std::abs(range_m - (packet.is_first_kind && round % 3 != 0 ? 10.0 : 16.0)) < 0.06;
        read_packets += is_as_sent ? 1 : 0;
        ASSERT_LT(range_m, 263.0);
      }
    }
  }
  EXPECT_GT(read_packets, 100'000U);
}

}  // namespace
}  // namespace pose_wall::tools
