// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: packets of each Hesai give points and times where its manual puts them, worked out by hand. The farther of
// two returns is taken, whatever their order. Where a table of angles is given, they are the table's. What does not fit
// is not taken, or refused with its reason. Real packets are looked at in tests/real.

#include <gtest/gtest.h>

#include <cmath>

#include "io/packets/hesai.hpp"
#include "packet_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr std::int64_t kCaptured_ns = 1'000'000'000;

Scan one_turn(const HesaiPacket& packet, const std::string& angles = "") {
  HesaiAssembler assembler(std::nullopt, angles);
  EXPECT_TRUE(add(assembler, payload_of(packet), kCaptured_ns));
  assembler.finish();
  return assembler.take().value();
}

TEST(Hesai, PointsOfAnXt32LieWhereTheManualPutsThem) {
  const Scan scan = one_turn(HesaiPacket{});
  ASSERT_EQ(scan.rings, 32U);
  ASSERT_EQ(scan.points.size(), 32U * 8U);
  // Block 2 at 90 degrees is to the right; channel 1 is the highest, at 15 degrees, channel 32 at -16; 10 m.
  expect_at(point_at(scan, 31, 2), 0.0, -9.659258, 2.588190);
  expect_at(point_at(scan, 0, 2), 0.0, -9.612617, -2.756374);
  EXPECT_EQ(point_at(scan, 0, 2).intensity, 42.0F);
  // Block 8 starts 5.632 us after the packet's time, each before it 50 us earlier; channel 1 fires 0.368 us later, and
  // each further one after 1.512 us.
  EXPECT_EQ(scan.stamp_ns, kCaptured_ns + 5'632 - 350'000 + 368);
  EXPECT_EQ(point_at(scan, 31, 2).t_ns, 100'000U);
  EXPECT_EQ(point_at(scan, 0, 2).t_ns, 100'000U + 31U * 1'512U);
}

TEST(Hesai, PointsOfAnXt16LieWhereTheManualPutsThem) {
  HesaiPacket packet;
  packet.lasers = 16;
  const Scan scan = one_turn(packet);
  ASSERT_EQ(scan.rings, 16U);
  ASSERT_EQ(scan.points.size(), 16U * 8U);
  // Block 2 at 90 degrees is to the right; channel 1 is the highest, at 15 degrees, channel 16 at -15; 10 m.
  expect_at(point_at(scan, 15, 2), 0.0, -9.659258, 2.588190);
  expect_at(point_at(scan, 0, 2), 0.0, -9.659258, -2.588190);
  // Channel 9 is the first below the horizon, at -1 degree.
  expect_at(point_at(scan, 7, 2), 0.0, -9.998477, -0.174524);
  // As of an XT32, but one laser each 3.024 us: the SDK counts 6 us to the first and 51.36 us to the last.
  EXPECT_EQ(scan.stamp_ns, kCaptured_ns + 6'000 - 350'000);
  EXPECT_EQ(point_at(scan, 15, 2).t_ns, 100'000U);
  EXPECT_EQ(point_at(scan, 0, 2).t_ns, 100'000U + 51'360U - 6'000U);
}

// Those of an XT32M2X count from HesaiLidar_SDK_2.0's firetimes, and ranges in 5 mm.
TEST(Hesai, PointsOfAnXt32mLieWhereItsDesignPutsThem) {
  HesaiPacket packet = test::xt32m_packet();
  packet.step_deg = 30.0;
  packet.distance = [](std::size_t, std::size_t) { return std::uint16_t{2000}; };
  const Scan scan = one_turn(packet);
  ASSERT_EQ(scan.rings, 32U);
  ASSERT_EQ(scan.points.size(), 32U * 6U);
  // Block 3 at 90 degrees is to the right; channel 1 is the highest, at 19.5 degrees, channel 32 at -20.8; 10 m.
  expect_at(point_at(scan, 31, 3), 0.0, -9.426415, 3.338069);
  expect_at(point_at(scan, 0, 3), 0.0, -9.348257, -3.551069);
  // The last block 5.632 us after the packet's time; the first laser at 6 us, the sixteenth at 49.32, and the
  // seventeenth with the first.
  EXPECT_EQ(scan.stamp_ns, kCaptured_ns + 6'000 - 5 * 50'000);
  EXPECT_EQ(point_at(scan, 31, 3).t_ns, 150'000U);
  EXPECT_EQ(point_at(scan, 16, 3).t_ns, 150'000U + 49'320U - 6'000U);
  EXPECT_EQ(point_at(scan, 15, 3).t_ns, 150'000U);
}

TEST(Hesai, PointsOfAQt128LieWhereItsMakerPutsThem) {
  HesaiPacket packet = test::qt128_packet();
  packet.first_deg = 89.6;
  packet.step_deg = 0.4;  // of two firings a wide step would be a hole of the field of view
  const Scan scan = one_turn(packet);
  ASSERT_EQ(scan.rings, 128U);
  // Block 1 at 90 degrees. Channel 1: -52.6268 and 10.1083 degrees; channel 128 is its mirror image.
  expect_at(point_at(scan, 0, 1), -1.065349, -5.975821, -7.946986);
  expect_at(point_at(scan, 127, 1), 1.065349, -5.975821, 7.946986);
  // Block 0 at 9 us, the next 111.11 us later. Channel 65 fires first, after 0.6 or 1.456 us, channel 1 after 2.312,
  // channel 128 after 48.12 or 48.976.
  EXPECT_EQ(scan.stamp_ns, kCaptured_ns + 9'000 + 1'028);
  EXPECT_EQ(point_at(scan, 0, 1).t_ns, 111'110U + 2'312U - 1'028U);
  EXPECT_EQ(point_at(scan, 127, 1).t_ns, 111'110U + 48'548U - 1'028U);
  packet.mode = 0x3B;
  EXPECT_EQ(one_turn(packet).points.size(), 128U) << "one firing of two returns";
}

// With channels of its own, or without the state of its safety, what lies where is another matter.
TEST(Hesai, AQt128ThatHoldsSomethingElseIsRefusedByName) {
  for (const char flags : {'\x5D', '\x19', '\x0D'}) {
    std::string payload = payload_of(test::qt128_packet());
    payload[11] = flags;
    EXPECT_FALSE(hesai_model_of(test::view_of(payload)));
    EXPECT_EQ(unread_hesai(test::view_of(payload)).find("a Hesai QT128C2X whose packets hold something else"), 0U);
  }
}

TEST(Hesai, PointsOfAPandar64LieWhereItsMakerPutsThem) {
  HesaiPacket packet = test::pandar64_packet();
  packet.step_deg = 30.0;
  const Scan scan = one_turn(packet);
  ASSERT_EQ(scan.rings, 64U);
  // Block 3 at 90 degrees. Channels 9, 10 and 64: elevations 1.54, 1.369, -24.879; azimuths 5.208, -5.208, -1.042.
  expect_at(point_at(scan, 55, 3), -0.907388, -9.955120, 0.268748);
  expect_at(point_at(scan, 54, 3), 0.907457, -9.955875, 0.238913);
  expect_at(point_at(scan, 0, 3), 0.164977, -9.070483, -4.207033);
  // The last block at -42.58 us, each before it 55.56 us earlier. Channel 12 fires first, 54.668 us before its block's
  // time, channel 51 last, 3.62 us before it.
  EXPECT_EQ(scan.stamp_ns, kCaptured_ns - 42'580 - 5 * 55'560 - 54'668);
  EXPECT_EQ(point_at(scan, 52, 3).t_ns, 3U * 55'560U);
  EXPECT_EQ(point_at(scan, 13, 3).t_ns, 3U * 55'560U + 54'668U - 3'620U);
  packet.unit_mm = 2;
  const std::string other = payload_of(packet);
  EXPECT_EQ(unread_hesai(test::view_of(other)), "a Hesai Pandar64 that counts ranges in 2 mm, and not in 4 mm");
}

TEST(Hesai, OfThreeReturnsTheFarthestIsTaken) {
  for (const std::size_t farthest : {0U, 1U, 2U}) {
    HesaiPacket packet = test::xt32m_packet();
    packet.mode = 0x3D;
    packet.step_deg = 0.18;
    packet.distance = [farthest](std::size_t block, std::size_t) {
      return std::uint16_t(block % 3 == farthest ? 2000 : 400 * (block % 3));
    };
    const Scan scan = one_turn(packet);
    ASSERT_EQ(scan.points.size(), 32U * 2U);
    for (const ScanPoint& point : scan.points) {
      EXPECT_NEAR(std::hypot(point.x_m, point.y_m, point.z_m), 10.0, 1e-4);
    }
    EXPECT_EQ(scan.stamp_ns, kCaptured_ns + 6'000 - 50'000);
  }
  HesaiPacket xt32;
  xt32.mode = 0x3D;
  EXPECT_FALSE(hesai_model_of(test::view_of(payload_of(xt32)))) << "eight blocks are no threes";
}

// What counts in another unit would scale all that is measured.
TEST(Hesai, AnotherUnitIsRefusedByName) {
  HesaiPacket xt32, xt32m = test::xt32m_packet();
  xt32.unit_mm = 5;
  xt32m.unit_mm = 4;
  const std::string five = payload_of(xt32), four = payload_of(xt32m);
  EXPECT_FALSE(hesai_model_of(test::view_of(five)));
  EXPECT_FALSE(hesai_model_of(test::view_of(four)));
  EXPECT_EQ(unread_hesai(test::view_of(five)), "a Hesai PandarXT-32 that counts ranges in 5 mm, and not in 4 mm");
  EXPECT_EQ(unread_hesai(test::view_of(four)), "a Hesai PandarXT-32M2X that counts ranges in 4 mm, and not in 5 mm");
}

// Sixteen lasers in eight blocks are an XT16's only by its protocol.
TEST(Hesai, AnotherProtocolIsNoXt) {
  for (const std::size_t lasers : {16U, 32U}) {
    HesaiPacket packet;
    packet.lasers = lasers;
    std::string other = payload_of(packet);
    other[3] = '\x02';
    EXPECT_FALSE(hesai_model_of(test::view_of(other))) << lasers;
    EXPECT_EQ(unread_hesai(test::view_of(other)), "a Hesai of " + std::to_string(lasers) + " lasers in 8 blocks");
  }
}

TEST(Hesai, PointsOfA40pLieWhereTheManualPutsThem) {
  HesaiPacket packet;
  packet.lasers = 40;
  packet.blocks = 10;
  packet.step_deg = 30.0;
  packet.first_deg = 0.0;
  HesaiAssembler assembler(HesaiModel::kPandar40p, "");
  EXPECT_TRUE(add(assembler, payload_of(packet), kCaptured_ns));
  assembler.finish();
  const Scan scan = assembler.take().value();
  ASSERT_EQ(scan.rings, 40U);
  // Block 3 at 90 degrees. Channels 7, 8 and 40: elevations 1.67, 1.33, -25; azimuths 3.125, -5.208, -1.042.
  expect_at(point_at(scan, 33, 3), -0.544913, -9.980889, 0.291429);
  expect_at(point_at(scan, 32, 3), 0.907472, -9.956034, 0.232108);
  expect_at(point_at(scan, 0, 3), 0.164815, -9.061579, -4.226183);
  // Block 10 at -28.58 us, each before it 55.56 us earlier. Channel 8 fires first, 54.67 us before its block's time,
  // channel 4 last, 3.62 us before it.
  EXPECT_EQ(scan.stamp_ns, kCaptured_ns - 28'580 - 9 * 55'560 - 54'670);
  EXPECT_EQ(point_at(scan, 32, 3).t_ns, 3U * 55'560U);
  EXPECT_EQ(point_at(scan, 36, 3).t_ns, 3U * 55'560U + 54'670U - 3'620U);
}

TEST(Hesai, PointsOfAQt64LieWhereTheManualPutsThem) {
  HesaiPacket packet;
  packet.lasers = 64;
  packet.blocks = 4;
  packet.step_deg = 90.0;
  const Scan scan = one_turn(packet);
  ASSERT_EQ(scan.rings, 64U);
  // Block 1 at 90 degrees. Channel 1: -52.121 and 8.736 degrees; channel 64: 52.133 and -7.892.
  expect_at(point_at(scan, 0, 1), -0.932549, -6.068728, -7.893092);
  expect_at(point_at(scan, 63, 1), 0.842828, -6.080168, 7.894378);
  // Block 1 at 25.71 us, the next 166.667 us later; channel 1 after 12.31 us, channel 64 after 146.45 us.
  EXPECT_EQ(scan.stamp_ns, kCaptured_ns + 25'710 + 12'310);
  EXPECT_EQ(point_at(scan, 63, 1).t_ns, 166'667U + 146'450U - 12'310U);
}

// The manual puts the last return first; the packets of a real XT32 have it second.
TEST(Hesai, OfTwoReturnsTheFartherIsTakenInAnyOrder) {
  for (const std::size_t farther : {0U, 1U}) {
    for (const int mode : {0x39, 0x3A, 0x3B, 0x3C, 0x3E}) {
      HesaiPacket packet;
      packet.mode = static_cast<std::uint8_t>(mode);
      packet.step_deg = 90.0;
      packet.distance = [farther](std::size_t block, std::size_t laser) {
        if (laser == 5) return std::uint16_t(block % 2 == farther ? 0 : 2500);  // the other is no return
        return std::uint16_t(block % 2 == farther ? 2500 : 1000);
      };
      const Scan scan = one_turn(packet);
      ASSERT_EQ(scan.points.size(), 32U * 4U);
      for (const ScanPoint& point : scan.points) {
        EXPECT_NEAR(std::hypot(point.x_m, point.y_m, point.z_m), 10.0, 1e-4);
      }
      // Four firings: the last is still the one whose time is known.
      EXPECT_EQ(scan.stamp_ns, kCaptured_ns + 5'632 - 150'000 + 368);
    }
  }
}

TEST(Hesai, NoReturnIsNoPoint) {
  HesaiPacket packet;
  packet.distance = [](std::size_t, std::size_t laser) { return std::uint16_t(laser == 3 ? 0 : 2500); };
  const Scan scan = one_turn(packet);
  EXPECT_EQ(std::hypot(point_at(scan, 28, 1).x_m, point_at(scan, 28, 1).z_m), 0.0);
  EXPECT_EQ(point_at(scan, 28, 1).intensity, 0.0F);
  EXPECT_EQ(point_at(scan, 28, 1).ring, 28U);
}

std::string table(std::size_t lasers, double elevation_deg, const std::string& extra = "") {
  std::string text = "Laser id,Elevation,Azimuth\r\n";
  for (std::size_t i = 1; i <= lasers; ++i) {
    text += std::to_string(i) + "," + std::to_string(elevation_deg - static_cast<double>(i)) + ",1.5\r\n";
  }
  return text + extra;
}

TEST(Hesai, ATableOfAnglesTakesThePlaceOfTheDesign) {
  const Scan scan = one_turn(HesaiPacket{}, table(32, 31.0));
  // Channel 1 at 30 degrees, beside the head by 1.5: at 91.5 in block 2.
  expect_at(point_at(scan, 31, 2), 10.0 * std::cos(M_PI / 6) * std::cos(91.5 * M_PI / 180),
            -10.0 * std::cos(M_PI / 6) * std::sin(91.5 * M_PI / 180), 5.0);
}

TEST(Hesai, FaultsOfATableOfAnglesAreNamed) {
  const auto refusal = [](const std::string& text) {
    try {
      parse_hesai_angles(text, 32);
      return std::string("read");
    } catch (const FrameError& refused) {
      return std::string(refused.what());
    }
  };
  EXPECT_EQ(refusal(table(32, 0.0)), "read");
  EXPECT_TRUE(contains(refusal(table(31, 0.0)), "has no laser 32; 32 are needed"));
  EXPECT_TRUE(contains(refusal(table(33, 0.0)), "has a laser '33'; 1 to 32 are allowed"));
  EXPECT_TRUE(contains(refusal(table(32, 0.0, "7,1,1\n")), "has laser 7 twice"));
  EXPECT_TRUE(contains(refusal(table(31, 0.0, "1.5,1,1\n")), "has a laser '1.5'"));
  EXPECT_TRUE(contains(refusal(table(31, 0.0, "32,91,1\n")), "-90 to 90"));
  EXPECT_TRUE(contains(refusal(table(31, 0.0, "32,1,\n")), "-180 to 180"));
  EXPECT_TRUE(contains(refusal(table(31, 0.0, "32,up,1\n")), "up"));
  EXPECT_TRUE(contains(refusal("a,b\n1,2\n"), "no columns of laser, elevation and azimuth"));
  EXPECT_NE(refusal(""), "read");
}

TEST(Hesai, WhatDoesNotFitIsNotTaken) {
  HesaiPacket of_40p, of_qt, of_xt16;
  of_xt16.lasers = 16;
  of_40p.lasers = 40;
  of_40p.blocks = 10;
  of_qt.lasers = 64;
  of_qt.blocks = 4;
  for (const HesaiPacket& packet :
       {HesaiPacket{}, of_40p, of_qt, of_xt16, test::xt32m_packet(), test::pandar64_packet()}) {
    const std::string good = payload_of(packet);
    ASSERT_TRUE(hesai_model_of(test::view_of(good)));
    for (std::size_t size = 0; size < good.size(); ++size) {
      EXPECT_FALSE(hesai_model_of(test::view_of(good.substr(0, size)))) << size << " of " << good.size();
    }
    HesaiPacket unknown = packet;
    unknown.mode = 0x55;
    EXPECT_FALSE(hesai_model_of(test::view_of(payload_of(unknown)))) << "return mode";
    std::string azimuth = good;
    azimuth.replace(packet.lasers == 40 ? 2 : packet.lasers == 64 && packet.blocks == 6 ? 8 : 12, 2, "\xA0\x8C");
    EXPECT_FALSE(hesai_model_of(test::view_of(azimuth))) << "360.00 degrees";
  }
  std::string lasers = payload_of(HesaiPacket{}), blocks = lasers, unit = lasers;
  lasers[6] = '\xFF';
  blocks[7] = '\xFF';
  unit[9] = '\0';
  for (const std::string& wrong : {lasers, blocks, unit}) EXPECT_FALSE(hesai_model_of(test::view_of(wrong)));
  EXPECT_EQ(unread_hesai(test::view_of(lasers)), "a Hesai of 255 lasers in 8 blocks");
}

TEST(Hesai, TheFirstModelThatIsHeardStays) {
  HesaiPacket qt;
  qt.lasers = 64;
  qt.blocks = 4;
  HesaiAssembler any(std::nullopt, ""), stated(HesaiModel::kQt64, "");
  EXPECT_TRUE(add(any, payload_of(HesaiPacket{})));
  EXPECT_FALSE(add(any, payload_of(qt)));
  EXPECT_STREQ(any.kind(), "packets of a Hesai PandarXT-32");
  EXPECT_FALSE(add(stated, payload_of(HesaiPacket{})));
  EXPECT_TRUE(add(stated, payload_of(qt)));
}

}  // namespace
}  // namespace pose_wall::tools
