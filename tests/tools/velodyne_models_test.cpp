// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: packets of an HDL-32E, a VLP-32C and a Puck Hi-Res give points where the manuals put them (worked out by
// hand); the model is told by product byte and clock, and a contradiction between these, or with the sensor that was
// named, is refused with both.

#include <gtest/gtest.h>

#include <cmath>

#include "io/packets/velodyne.hpp"
#include "packet_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

std::vector<VelodynePacket> packets_of(std::uint8_t product, std::uint32_t packet_us, std::size_t count = 8,
                                       std::uint8_t mode = 0x37) {
  std::vector<VelodynePacket> packets(count);
  for (std::size_t i = 0; i < count; ++i) {
    packets[i].product = product;
    packets[i].mode = mode;
    packets[i].step_deg = 0.4;
    packets[i].first_deg = 5.0 * static_cast<double>(i);
    packets[i].clock_us = 3'599'998'000U + static_cast<std::uint32_t>(i) * packet_us;  // passes the hour
    if (packets[i].clock_us >= 3'600'000'000U) packets[i].clock_us -= 3'600'000'000U;
  }
  return packets;
}

// What the packets are taken for, or why they are refused.
std::string told(const std::vector<VelodynePacket>& packets, std::optional<VelodyneModel> stated = std::nullopt) {
  VelodyneAssembler assembler(stated);
  try {
    for (const VelodynePacket& packet : packets) EXPECT_TRUE(add(assembler, payload_of(packet)));
    assembler.finish();
  } catch (const FrameError& refused) {
    return refused.what();
  }
  return assembler.kind();
}

Scan one_turn(const VelodynePacket& packet) {
  VelodyneAssembler assembler;
  EXPECT_TRUE(add(assembler, payload_of(packet), 1'000'000));
  assembler.finish();
  return assembler.take().value();
}

TEST(VelodyneModels, PointsOfAnHdl32eLieWhereTheManualPutsThem) {
  VelodynePacket packet;
  packet.product = 0x21;
  const Scan scan = one_turn(packet);
  ASSERT_EQ(scan.rings, 32U);
  ASSERT_EQ(scan.points.size(), 32U * 12U);
  // Block 3 is at 90 degrees: to the right. Laser 0 is the lowest, at -30.67 degrees: 10 m cos, sin of it.
  expect_at(point_at(scan, 0, 3), 0.0, -8.601195, -5.100926);
  EXPECT_EQ(point_at(scan, 0, 3).t_ns, 3U * 46'080U);
  // Laser 31, the highest, at 10.67 degrees, fires 31 * 1.152 us later: the head has turned by 30 * 35.712 / 46.08.
  expect_at(point_at(scan, 31, 3), -3.879187, -9.029052, 1.851521);
  EXPECT_EQ(point_at(scan, 31, 3).t_ns, 3U * 46'080U + 35'712U);
  EXPECT_EQ(point_at(scan, 31, 3).ring, 31U);
  EXPECT_EQ(point_at(scan, 31, 3).intensity, 42.0F);
}

TEST(VelodyneModels, PointsOfAVlp32cLieWhereTheManualPutsThem) {
  VelodynePacket packet;
  packet.product = 0x28;
  packet.distance = [](std::size_t, std::size_t) { return std::uint16_t{2500}; };  // 4 mm each
  const Scan scan = one_turn(packet);
  ASSERT_EQ(scan.rings, 32U);
  // Laser 0: -25 degrees, beside the head by 1.4; laser 1 fires with it: -1 degree, -4.2.
  expect_at(point_at(scan, 0, 3), -0.221431, -9.060372, -4.226183);
  const std::uint32_t of_laser_1 = 17;  // lasers below -1 degree
  expect_at(point_at(scan, of_laser_1, 3), 0.732270, -9.971626, -0.174524);
  EXPECT_EQ(point_at(scan, of_laser_1, 3).t_ns, 3U * 55'296U);
  // Laser 31, -1.333 degrees and -1.4, is of the last pair, 15 * 2.304 us later: 30 * 34.56 / 55.296 = 18.75 degrees.
  expect_at(point_at(scan, 16, 3), -2.981272, -9.542426, -0.232631);
  EXPECT_EQ(point_at(scan, 16, 3).t_ns, 3U * 55'296U + 34'560U);
}

TEST(VelodyneModels, APuckHiResHasTwoThirdsOfThePucksAngles) {
  VelodynePacket packet;
  packet.product = 0x24;
  const Scan scan = one_turn(packet);
  ASSERT_EQ(scan.rings, 16U);
  // Laser 0 at -10 degrees; two firings a block.
  expect_at(point_at(scan, 0, 6), 0.0, -9.848078, -1.736482);
}

TEST(VelodyneModels, OfTwoReturnsOfAnHdl32eTheFirstBlockIsTaken) {
  VelodynePacket packet;
  packet.product = 0x21;
  packet.mode = 0x39;
  packet.distance = [](std::size_t block, std::size_t) { return std::uint16_t(block % 2 == 0 ? 5000 : 2000); };
  const Scan scan = one_turn(packet);
  ASSERT_EQ(scan.points.size(), 32U * 6U);
  for (const ScanPoint& point : scan.points) EXPECT_NEAR(std::hypot(point.x_m, point.y_m, point.z_m), 10.0, 1e-4);
}

TEST(VelodyneModels, ProductByteAndClockTellTheModel) {
  EXPECT_EQ(told(packets_of(0x22, 1327)), "packets of a Velodyne VLP-16");
  EXPECT_EQ(told(packets_of(0x22, 664, 8, 0x39)), "packets of a Velodyne VLP-16");
  EXPECT_EQ(told(packets_of(0x24, 1327)), "packets of a Velodyne Puck Hi-Res");
  EXPECT_EQ(told(packets_of(0x21, 553)), "packets of a Velodyne HDL-32E");
  EXPECT_EQ(told(packets_of(0x28, 663)), "packets of a Velodyne VLP-32C");
  EXPECT_EQ(told(packets_of(0x28, 332, 8, 0x39)), "packets of a Velodyne VLP-32C");
  // A clock that stands still says nothing; nor does a single packet's.
  EXPECT_EQ(told(packets_of(0x21, 0)), "packets of a Velodyne HDL-32E");
  EXPECT_EQ(told(packets_of(0x21, 1327, 1)), "packets of a Velodyne HDL-32E");
}

// One that runs as no Velodyne's: the unit may be another, too. Where so many are lost that no two follow each other it
// says nothing.
TEST(VelodyneModels, AClockThatRunsAsNoVelodynesIsAContradiction) {
  const std::string refused = told(packets_of(0x22, 1200));
  for (const char* word : {"0x22", "1200 us", "another unit", "vlp16"}) {
    EXPECT_NE(refused.find(word), std::string::npos) << word << ": " << refused;
  }
  EXPECT_EQ(told(packets_of(0x22, 1200), VelodyneModel::kVlp16), "packets of a Velodyne VLP-16") << "two of three";
  EXPECT_EQ(told(packets_of(0x22, 1327 * 100 + 300)), "packets of a Velodyne VLP-16") << "of a hundred one is there";
}

TEST(VelodyneModels, PacketsThatWereLostDoNotChangeWhatTheClockSays) {
  std::vector<VelodynePacket> packets = packets_of(0x28, 663, 9);
  packets.erase(packets.begin() + 1);  // twice 663 us is what a VLP-16 takes
  packets.erase(packets.begin() + 3);
  EXPECT_EQ(told(packets), "packets of a Velodyne VLP-32C");
}

TEST(VelodyneModels, WhereTheProductByteIsSilentTheClockDecides) {
  EXPECT_EQ(told(packets_of(0, 1327)), "packets of a Velodyne VLP-16");
  EXPECT_EQ(told(packets_of(0, 553)), "packets of a Velodyne HDL-32E");
  EXPECT_EQ(told(packets_of(0, 663, 8, 0)), "packets of a Velodyne VLP-32C");
  // Without a word on returns: pairs of blocks that share an azimuth are two returns.
  std::vector<VelodynePacket> pairs = packets_of(0, 663, 8, 0x39);
  VelodyneAssembler assembler;
  for (VelodynePacket& packet : pairs) {
    std::string payload = payload_of(packet);
    payload[1204] = '\0';
    EXPECT_TRUE(add(assembler, payload));
  }
  EXPECT_STREQ(assembler.kind(), "packets of a Velodyne VLP-16");
  EXPECT_TRUE(contains(told(packets_of(0, 0)), "neither their product byte (0x00) nor their clock tells which"));
}

TEST(VelodyneModels, AContradictionIsRefusedWithBothNamed) {
  const std::string within = told(packets_of(0x21, 1327));
  EXPECT_TRUE(contains(within, "product byte (0x21) says Velodyne HDL-32E")) << within;
  EXPECT_TRUE(contains(within, "clock (1327 us a packet) says Velodyne VLP-16")) << within;
  const std::string with_stated = told(packets_of(0x21, 553), VelodyneModel::kVlp16);
  EXPECT_TRUE(contains(with_stated, "said to be a Velodyne VLP-16 (vlp16)")) << with_stated;
  EXPECT_TRUE(contains(with_stated, "Velodyne HDL-32E")) << with_stated;
  EXPECT_TRUE(contains(told(packets_of(0x24, 1327), VelodyneModel::kVlp16), "Puck Hi-Res")) << "other angles";
  EXPECT_TRUE(contains(told(packets_of(0x21, 1327), VelodyneModel::kHdl32e), "their clock"));
  EXPECT_TRUE(contains(told(packets_of(0, 553), VelodyneModel::kVlp16), "their clock"));
  EXPECT_TRUE(contains(told(packets_of(0x21, 0), VelodyneModel::kVlp16), "0x21"));
}

// First VLP-16s said 0x21.
TEST(VelodyneModels, TheSensorThatWasNamedAndTheClockOutvoteTheProductByte) {
  EXPECT_EQ(told(packets_of(0x21, 1327), VelodyneModel::kVlp16), "packets of a Velodyne VLP-16");
}

// LSLidar's packets have this layout, and a Puck's order of lasers, in steps of 2.5 mm instead of 2.
TEST(VelodyneModels, AnLslidarIsNoVelodyneWhateverItIsSaidToBe) {
  for (const auto& [product, title] :
       {std::pair<std::uint8_t, const char*>{0x10, "LSLidar C16"}, {0x20, "LSLidar C32"}}) {
    EXPECT_TRUE(contains(told(packets_of(product, 1200)), title)) << title;
    for (const std::uint32_t packet_us : {1200U, 600U, 0U, 1327U}) {
      for (const VelodyneModel model : {VelodyneModel::kVlp16, VelodyneModel::kHdl32e, VelodyneModel::kVlp32c}) {
        EXPECT_TRUE(contains(told(packets_of(product, packet_us), model), title)) << title << ' ' << packet_us;
      }
    }
  }
}

TEST(VelodyneModels, ANameThatNeitherProductByteNorClockConfirmsIsRefused) {
  const std::string strange = told(packets_of(0, 1200), VelodyneModel::kVlp16);
  EXPECT_TRUE(contains(strange, "nothing in its packets confirms it")) << strange;
  EXPECT_TRUE(contains(strange, "their clock (1200 us a packet) is no Velodyne's")) << strange;
  EXPECT_TRUE(contains(strange, "LSLidar")) << strange;
  EXPECT_TRUE(contains(told(packets_of(0, 600, 8, 0x39), VelodyneModel::kVlp16), "confirms"));
  EXPECT_TRUE(contains(told(packets_of(0, 0), VelodyneModel::kVlp16), "their clock stands still"));
  EXPECT_TRUE(contains(told(packets_of(0, 1327, 1), VelodyneModel::kVlp16), "confirms")) << "one packet has no pace";
  for (std::size_t lost = 2; lost < 7; ++lost) {
    EXPECT_TRUE(
        contains(told(packets_of(0, static_cast<std::uint32_t>(1200 * lost)), VelodyneModel::kVlp16), "confirms"))
        << lost;
  }
  // Where naming cannot help nobody is asked for a name.
  EXPECT_FALSE(contains(told(packets_of(0, 1200)), "name the sensor"));
  EXPECT_FALSE(contains(told(packets_of(0, 0)), "name the sensor"));
  EXPECT_FALSE(contains(told(packets_of(0x10, 1200)), "name the sensor"));
}

TEST(VelodyneModels, PacketsLostBetweenAnyTwoDoNotRefuteTheName) {
  EXPECT_EQ(told(packets_of(0, 2654), VelodyneModel::kVlp16), "packets of a Velodyne VLP-16");
  EXPECT_EQ(told(packets_of(0, 1659), VelodyneModel::kHdl32e), "packets of a Velodyne HDL-32E");
  std::vector<VelodynePacket> packets = packets_of(0, 1327, 12);
  packets.erase(packets.begin() + 1);
  packets.erase(packets.begin() + 2, packets.begin() + 4);
  packets.erase(packets.begin() + 3);
  EXPECT_EQ(told(packets, VelodyneModel::kVlp16), "packets of a Velodyne VLP-16");
}

TEST(VelodyneModels, SensorsThatAreNotReadAreNamed) {
  EXPECT_TRUE(contains(told(packets_of(0x63, 0)), "VLS-128"));
  EXPECT_TRUE(contains(told(packets_of(0x23, 664)), "VLP-32A or B"));
  EXPECT_TRUE(contains(told(packets_of(0x23, 664), VelodyneModel::kVlp32c), "VLP-32A or B"));
}

TEST(VelodyneModels, WhatIsNoDataIsNotTaken) {
  const std::string good = payload_of(VelodynePacket{});
  VelodyneAssembler assembler;
  EXPECT_FALSE(add(assembler, ""));
  EXPECT_FALSE(add(assembler, good.substr(0, 1205)));
  EXPECT_FALSE(add(assembler, good + "x"));
  std::string flag = good, azimuth = good;
  flag[1100] = '\xDD';
  azimuth[1102] = '\xA0';  // 360.00 degrees
  azimuth[1103] = '\x8C';
  EXPECT_FALSE(add(assembler, flag));
  EXPECT_FALSE(add(assembler, azimuth));
  EXPECT_TRUE(add(assembler, good));
  VelodynePacket other;
  other.product = 0x21;
  EXPECT_FALSE(add(assembler, payload_of(other))) << "another sensor behind the same address";
}

}  // namespace
}  // namespace pose_wall::tools
