// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: packets of RoboSense's spinning sensors and of the M1 give points and times where the maker's descriptions
// put them (worked out by hand): unit, sign, lens, holes of the field of view, two returns, direction of rotation. What
// they do not say is refused in words. Which sensor it is, is looked at in robosense_kinds_test.

#include <gtest/gtest.h>

#include <cmath>

#include "io/packets/robosense.hpp"
#include "io/packets/robosense_m1.hpp"
#include "io/packets/sensors.hpp"
#include "lab/sim/scenes.hpp"
#include "robosense_packets.hpp"
#include "support/sim_run.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr std::int64_t kCaptured_ns = 1'700'000'000'000'000'000;
constexpr double kRad = M_PI / 180.0;

struct Decoded {
  Scan scan;
  std::string kind, refusal;
};

// Packets that arrive when the sensor sends them.
Decoded decoded(const RoboSenseExample& example, const std::vector<std::string>& data, const std::string& device) {
  Decoded decoded;
  RoboSenseAssembler assembler(std::nullopt);
  try {
    if (!device.empty()) add(assembler, device, kCaptured_ns);
    for (std::size_t i = 0; i < data.size(); ++i) {
      const auto sent_ns = kCaptured_ns + std::llround(1e3 * example.packet_us * static_cast<double>(i));
      EXPECT_TRUE(add(assembler, data[i], sent_ns)) << example.word;
    }
    assembler.finish();
  } catch (const FrameError& refused) {
    decoded.refusal = refused.what();
    return decoded;
  }
  decoded.kind = assembler.kind();
  decoded.scan = assembler.take().value();
  return decoded;
}

Decoded decoded(const RoboSenseExample& example, double first_deg = 90.0) {
  return decoded(example, robosense_data(example, 6, first_deg), payload_of(example.device));
}

struct Expected {
  std::size_t lasers, laser;  // looked at
  double elevation_deg, beside_deg, after_us, firing_us;
  double range_m, out_m, up_m;
};

Expected expected_of(const std::string& word) {
  if (word == "robosense_rs16") return {16, 9, 13.0, 0.0, 25.2, 55.5, 10.0, 0.03825, 0.0};
  if (word == "robosense_rs32") return {32, 31, -25.0, -9.125, 46.08, 55.52, 10.0, 0.03997, 0.0};
  if (word == "robosense_helios32") return {32, 31, -55.0, -4.5, 53.63, 55.56, 5.0, 0.03498, 0.0};
  if (word == "robosense_helios16p") return {16, 15, -15.0, -4.5, 25.95, 55.56, 5.0, 0.03498, 0.0};
  if (word == "robosense_bpearl") return {32, 31, 2.3125, -0.1, 44.88, 55.52, 10.0, 0.01473, 0.09427};
  if (word == "robosense_bpearl4") return {32, 31, 2.3125, -0.1, 51.71, 55.56, 5.0, 0.01619, 0.09571};
  return {96, 1, 1.742, -1.63, 0.0, 111.08, 10.0, 0.010017, 0.04532};
}

const ScanPoint& point_of(const Scan& scan, double elevation_deg, double up_m, double range_m, std::size_t column) {
  const double z_m = up_m + range_m * std::sin(elevation_deg * kRad);
  const std::size_t columns = scan.points.size() / scan.rings;
  const ScanPoint* nearest = &scan.points[column];
  for (std::size_t ring = 0; ring < scan.rings; ++ring) {
    const ScanPoint& point = scan.points[ring * columns + column];
    if (std::abs(point.z_m - z_m) < std::abs(nearest->z_m - z_m)) nearest = &point;
  }
  return *nearest;
}

// The unit that halves, signs, offsets beside the head, the lens, the turn between two lasers.
TEST(RoboSense, PointsOfEachLieWhereItsDescriptionPutsThem) {
  for (const RoboSenseExample& example : test::robosense_examples()) {
    const Expected want = expected_of(example.word);
    const Decoded read = decoded(example);
    ASSERT_EQ(read.refusal, "") << example.word;
    EXPECT_EQ(read.kind, std::string("packets of a ") + known_sensor(*sensor_by_name(example.word)).title);
    ASSERT_EQ(read.scan.rings, want.lasers) << example.word;
    const std::size_t column = 1;
    const ScanPoint& point = point_of(read.scan, want.elevation_deg, want.up_m, want.range_m, column);
    const bool has_two_firings = want.lasers == 16;
    const double step_deg = has_two_firings ? example.packet.step_deg / 2.0 : example.packet.step_deg;
    const double head_deg = 90.0 + step_deg * (1.0 + want.after_us / want.firing_us);
    const double beam_deg = head_deg + want.beside_deg, flat_m = want.range_m * std::cos(want.elevation_deg * kRad);
    // Angles of device packets come in hundredths of a degree: 1 mm in 10 m.
    const double tolerance_m = 0.0011;
    EXPECT_NEAR(point.x_m, flat_m * std::cos(beam_deg * kRad) + want.out_m * std::cos(head_deg * kRad), tolerance_m)
        << example.word;
    EXPECT_NEAR(point.y_m, -flat_m * std::sin(beam_deg * kRad) - want.out_m * std::sin(head_deg * kRad), tolerance_m)
        << example.word;
    EXPECT_NEAR(point.z_m, want.range_m * std::sin(want.elevation_deg * kRad) + want.up_m, tolerance_m) << example.word;
    EXPECT_NEAR(1e-3 * point.t_ns, want.firing_us + want.after_us, 0.1) << example.word;
    EXPECT_EQ(point.intensity, 42.0F);
  }
}

// Left out, walls on both sides come 30 to 80 mm too near each other.
TEST(RoboSense, OppositeWallsAreApartByTwiceTheLens) {
  for (const RoboSenseExample& example : test::robosense_examples()) {
    const Expected want = expected_of(example.word);
    RoboSenseExample level = example;
    for (test::RoboSenseAngle& angle : level.device.angles) angle.azimuth_deg = 0.0;
    const Scan left = decoded(level, 270.0).scan, right = decoded(level, 90.0).scan;
    const double far_m = 2.0 * (want.range_m * std::cos(want.elevation_deg * kRad) + want.out_m);
    const double apart_m = point_of(left, want.elevation_deg, want.up_m, want.range_m, 0).y_m -
                           point_of(right, want.elevation_deg, want.up_m, want.range_m, 0).y_m;
    EXPECT_NEAR(apart_m, far_m, 0.001) << example.word;
  }
}

TEST(RoboSense, TimesOfAPacketFollowItsFirings) {
  for (const RoboSenseExample& example : test::robosense_examples()) {
    for (const RoboSenseExample& one : {example, test::with_two_returns(example)}) {
      const Decoded read = decoded(one);
      ASSERT_EQ(read.refusal, "") << example.word;
      const Expected want = expected_of(example.word);
      EXPECT_NEAR(static_cast<double>(read.scan.stamp_ns - kCaptured_ns), 0.0, 1'000.0) << "a clock of microseconds";
      const std::size_t columns = read.scan.points.size() / read.scan.rings;
      const ScanPoint& last = read.scan.points[columns - 1];
      const ScanPoint& first = read.scan.points[0];
      EXPECT_NEAR(1e-3 * (last.t_ns - first.t_ns), want.firing_us * static_cast<double>(columns - 1), 1.0)
          << example.word;
    }
  }
}

// A hole of the field of view is no step that a laser turns on by; the head takes its time to pass it.
TEST(RoboSense, AHoleIsNotInterpolatedAndTakesItsTime) {
  const RoboSenseExample example = test::rs32_example();
  std::vector<std::string> data = robosense_data(example, 6, 10.0);
  // In the last packet blocks 6 to 11 come 100 degrees later: 3.6 degrees in a millisecond.
  for (std::size_t block = 6; block < 12; ++block) {
    const double azimuth_deg = 10.0 + (60.0 + static_cast<double>(block)) * 0.2 + 100.0;
    test::put_at(&data[5], 42 + 100 * block + 2,
                 test::big_number(static_cast<std::uint64_t>(std::lround(100.0 * azimuth_deg)), 2));
  }
  const Decoded read = decoded(example, data, payload_of(example.device));
  ASSERT_EQ(read.refusal, "");
  const std::size_t columns = read.scan.points.size() / read.scan.rings, before = 65, behind = 66;
  ASSERT_EQ(columns, 72U);
  const ScanPoint& at = read.scan.points[before];  // of the lowest ring: the last laser
  const double head_deg = 10.0 + 65 * 0.2 + 0.2 * 46.08 / 55.52, flat_m = 10.0 * std::cos(25.0 * kRad);
  EXPECT_NEAR(at.x_m, flat_m * std::cos((head_deg - 9.125) * kRad) + 0.03997 * std::cos(head_deg * kRad), 0.001);
  const double wait_us = 1e-3 * (read.scan.points[behind].t_ns - at.t_ns);
  EXPECT_NEAR(wait_us, 100.2 / 0.2 * 55.52, 10.0);
}

TEST(RoboSense, OfTwoReturnsTheFartherIsTaken) {
  for (const RoboSenseExample& single : test::robosense_examples()) {
    for (const std::size_t farther : {0U, 1U}) {
      RoboSenseExample example = test::with_two_returns(single);
      const bool is_16 = expected_of(example.word).lasers == 16;
      const std::size_t blocks_of_return = example.packet.group / 2;
      example.packet.distance = [=](std::size_t block, std::size_t channel) {
        const std::size_t which = is_16 ? channel / 16 : block / blocks_of_return % 2;
        return std::uint16_t(which == farther ? 2000 : 600);
      };
      const Decoded read = decoded(example);
      ASSERT_EQ(read.refusal, "") << example.word;
      const Expected want = expected_of(example.word);
      for (const ScanPoint& point : read.scan.points) {
        EXPECT_NEAR(std::hypot(point.x_m, point.y_m, point.z_m - want.up_m), want.range_m, 0.05) << example.word;
      }
      EXPECT_EQ(read.scan.points.size() / read.scan.rings, 6 * example.steps) << example.word;
    }
  }
}

TEST(RoboSense, ABpearlMayTurnTheOtherWay) {
  for (RoboSenseExample example : {test::bpearl_example(), test::bpearl4_example()}) {
    const Scan forward = decoded(example, 30.0).scan;
    example.device.bytes = {{337, 1}};
    const Scan back = decoded(example, 30.0).scan;
    ASSERT_EQ(forward.points.size(), back.points.size());
    for (std::size_t i = 0; i < forward.points.size(); ++i) {
      EXPECT_FLOAT_EQ(back.points[i].x_m, forward.points[i].x_m);
      EXPECT_FLOAT_EQ(back.points[i].y_m, -forward.points[i].y_m);
    }
    example.device.bytes = {{337, 2}};
    EXPECT_TRUE(contains(decoded(example).refusal, "names 2 as its direction of rotation (byte 337)"));
  }
}

TEST(RoboSense, TheUpperTwoBitsOfAnAirysDistanceAreNone) {
  RoboSenseExample example = test::airy_example();
  example.packet.distance = [](std::size_t, std::size_t) { return std::uint16_t(0xC000 + 2000); };
  for (const ScanPoint& point : decoded(example).scan.points) {
    EXPECT_NEAR(std::hypot(point.x_m, point.y_m, point.z_m - 0.04532), 10.0, 0.02);
  }
}

TEST(RoboSense, AnAirysLasersFireByItsInstallation) {
  for (const auto& [mode, last_us] : {std::pair(0, 93.296), std::pair(1, 99.008), std::pair(2, 97.104)}) {
    RoboSenseExample example = test::airy_example();
    example.device.bytes = {{289, mode}};
    const Scan scan = decoded(example).scan;
    const std::size_t columns = scan.points.size() / scan.rings;
    EXPECT_NEAR(1e-3 * scan.points[95 * columns].t_ns, last_us, 0.01);
  }
  RoboSenseExample unknown = test::airy_example();
  unknown.device.bytes = {{289, 0xFF}};
  EXPECT_TRUE(contains(decoded(unknown).refusal, "names 255 as its way of installation"));
}

TEST(RoboSense, AnAiryOf48LinesIsReadAndOneOf192IsRefused) {
  RoboSenseExample example = test::airy_example();
  example.device.angles = test::evenly(0.8, 88.0, 48, 1.0);
  example.packet.head = {{17, 1}, {32, 1}};
  example.packet.group = 1;
  example.steps = 8;
  example.packet_us = 888.64;
  const Decoded read = decoded(example);
  EXPECT_EQ(read.refusal, "");
  EXPECT_EQ(read.scan.rings, 48U);
  example.packet.head = {{17, 1}, {32, 3}};
  EXPECT_TRUE(contains(decoded(example).refusal, "192 lines"));
  example.packet.head = {{17, 1}, {32, 7}};
  EXPECT_TRUE(contains(decoded(example).refusal, "name 7 as their kind"));
}

// A Fairy has an Airy's layout, another lens and another rhythm.
TEST(RoboSense, WhatTakesAnotherTimeThanAnAiryIsNone) {
  RoboSenseExample example = test::airy_example();
  example.packet_us = 4 * 69.462;
  EXPECT_TRUE(contains(decoded(example).refusal, "the time that its packets take says no sensor that is known"));
}

TEST(RoboSense, PacketsOfAnAiryWithoutPointsArePassedOver) {
  RoboSenseExample example = test::airy_example();
  std::vector<std::string> data = robosense_data(example, 6, 90.0);
  data[3][16] = '\x01';
  EXPECT_EQ(decoded(example, data, payload_of(example.device)).scan.points.size(), 5U * 4U * 96U);
}

// The first firmware counts in 10 mm; where none is named the maker's two drivers contradict each other.
TEST(RoboSense, TheUnitOfAnRsLidar16FollowsItsFirmware) {
  const auto first_range_m = [](const std::string& version) {
    RoboSenseExample example = test::rs16_example();
    example.device.top_version = version;
    const Decoded read = decoded(example);
    if (!read.refusal.empty()) return read.refusal;
    const ScanPoint& point = read.scan.points.front();
    return std::to_string(std::lround(std::hypot(point.x_m, point.y_m, point.z_m)));
  };
  EXPECT_EQ(first_range_m(std::string("\x00\x06\x23\x09\x00", 5)), "10");
  EXPECT_EQ(first_range_m(std::string("\x00\xE9\x01\x00\x00", 5)), "20");
  EXPECT_EQ(first_range_m(std::string("\x00\x55\xAA\x5A\x00", 5)), "20");
  EXPECT_TRUE(contains(first_range_m(std::string(5, '\0')), "5 or in 10 mm"));
  EXPECT_TRUE(contains(first_range_m(std::string(5, '\xFF')), "FFFFFF"));
  RoboSenseExample rs32 = test::rs32_example();
  rs32.device.top_version = std::string("\x00\xE9\x01\x00\x00", 5);
  EXPECT_TRUE(contains(decoded(rs32).refusal, "first firmware"));
}

TEST(RoboSense, AHeliosThatDoesNotNameItsUnitIsRefused) {
  for (RoboSenseExample example : {test::helios32_example(), test::helios16p_example()}) {
    example.packet.head.front().second = 0;
    EXPECT_TRUE(contains(decoded(example).refusal, "0 as the step of their distances (byte 17)")) << example.word;
  }
}

TEST(RoboSense, AnglesThatWereNeverWrittenAreRefused) {
  for (const RoboSenseExample& example : test::robosense_examples()) {
    if (example.word == "robosense_rs16") continue;
    for (const char filler : {'\0', '\xFF'}) {
      std::string device = payload_of(example.device);
      test::put_at(&device, 468, std::string(576, filler));
      EXPECT_NE(decoded(example, robosense_data(example, 6, 90.0), device).refusal, "") << example.word;
    }
    std::string device = payload_of(example.device);
    device[468 + 3 * 5] = '\xFF';  // of one laser
    EXPECT_NE(decoded(example, robosense_data(example, 6, 90.0), device).refusal, "") << example.word;
  }
}

// The maker's first driver takes the design's.
TEST(RoboSense, AnRsLidar16WithoutAnglesHasThoseOfItsDesign) {
  RoboSenseExample example = test::rs16_example();
  const Scan own = decoded(example).scan;
  example.device.rs16_deg.clear();
  const Decoded design = decoded(example);
  ASSERT_EQ(design.refusal, "");
  for (std::size_t i = 0; i < own.points.size(); ++i) EXPECT_FLOAT_EQ(own.points[i].z_m, design.scan.points[i].z_m);
}

TEST(RoboSense, AnOlderRhythmIsHeardFromThePackets) {
  RoboSenseExample example = test::rs16_example();
  example.packet_us = 1200.0;
  example.packet.step_deg = 0.36;
  const Decoded read = decoded(example);
  ASSERT_EQ(read.refusal, "");
  const std::size_t columns = read.scan.points.size() / read.scan.rings;
  EXPECT_NEAR(1e-3 * (read.scan.points[23].t_ns - read.scan.points[0].t_ns), 23 * 50.0, 0.1);
  EXPECT_EQ(columns, 144U);
}

TEST(RoboSense, TheCalendarOfTheSensorDoesNotMoveAStamp) {
  const RoboSenseExample example = test::rs32_example();
  std::vector<std::string> data = robosense_data(example, 6, 90.0);
  const Scan before = decoded(example, data, payload_of(example.device)).scan;
  for (std::string& payload : data) payload[23] = static_cast<char>(payload[23] + 8);  // eight hours on
  const Scan behind = decoded(example, data, payload_of(example.device)).scan;
  EXPECT_EQ(before.stamp_ns, behind.stamp_ns);
  EXPECT_NEAR(static_cast<double>(before.stamp_ns - kCaptured_ns), 0.0, 1'000.0) << "a clock of microseconds";
  EXPECT_TRUE(RoboSenseAssembler(std::nullopt).stamps_are_of_arrival());
}

TEST(RoboSense, BlocksWithoutAnAzimuthAreLeftOut) {
  const RoboSenseExample example = test::rs32_example();
  std::vector<std::string> data = robosense_data(example, 6, 90.0);
  test::put_at(&data[2], 42 + 4 * 100 + 2, "\xFF\xFF");
  const Decoded read = decoded(example, data, payload_of(example.device));
  EXPECT_EQ(read.refusal, "");
  EXPECT_EQ(read.scan.points.size(), 71U * 32U);
}

TEST(RoboSense, DataWaitsForTheDevicePacket) {
  const RoboSenseExample example = test::rs32_example();
  const std::vector<std::string> data = robosense_data(example, 600, 350.0);
  RoboSenseAssembler assembler(std::nullopt);
  for (std::size_t i = 0; i < data.size(); ++i)
    EXPECT_TRUE(add(assembler, data[i], kCaptured_ns + 666'240 * static_cast<std::int64_t>(i)));
  EXPECT_FALSE(assembler.take());
  EXPECT_TRUE(contains(assembler.hint(), "port 7788"));
  EXPECT_TRUE(add(assembler, payload_of(example.device), kCaptured_ns));
  EXPECT_EQ(assembler.hint(), "");
  assembler.take();
  const Scan whole = assembler.take().value();
  EXPECT_TRUE(whole.is_complete);
  EXPECT_EQ(whole.points.size(), 1800U * 32U);
}

TEST(RoboSense, WithoutADevicePacketNothingIsReadAndThatIsSaid) {
  const RoboSenseExample example = test::rs32_example();
  const std::string refused = decoded(example, robosense_data(example, 100), "").refusal;
  EXPECT_TRUE(contains(refused, "no device packet of it (DIFOP, port 7788)"));
  EXPECT_TRUE(contains(refused, "as metadata"));
  // What waits is bounded by its time: then the hint is of use.
  RoboSenseAssembler assembler(std::nullopt);
  const std::vector<std::string> data = robosense_data(example, 2);
  EXPECT_TRUE(add(assembler, data[0], kCaptured_ns));
  EXPECT_FALSE(add(assembler, data[1], kCaptured_ns + 2'100'000'000));
}

TEST(RoboSense, ASettingThatChangesOnTheWayIsFollowed) {
  const RoboSenseExample one = test::rs32_example(), two = test::with_two_returns(one);
  RoboSenseAssembler assembler(std::nullopt);
  EXPECT_TRUE(add(assembler, payload_of(one.device), kCaptured_ns));
  for (const std::string& payload : robosense_data(one, 10, 90.0)) EXPECT_TRUE(add(assembler, payload, kCaptured_ns));
  // Its data changes first: until the device packet says so, these are of no use.
  for (const std::string& payload : robosense_data(two, 5, 114.0)) EXPECT_TRUE(add(assembler, payload, kCaptured_ns));
  EXPECT_TRUE(add(assembler, payload_of(two.device), kCaptured_ns));
  for (const std::string& payload : robosense_data(two, 10, 120.0)) EXPECT_TRUE(add(assembler, payload, kCaptured_ns));
  assembler.finish();
  EXPECT_EQ(assembler.take().value().points.size(), (10U * 12U + 10U * 6U) * 32U);
}

// An Airy's data names its returns, a Helios' its unit.
TEST(RoboSense, AHeadThatChangesOnTheWayIsFollowed) {
  const RoboSenseExample one = test::airy_example(), two = test::with_two_returns(one);
  RoboSenseAssembler assembler(std::nullopt);
  EXPECT_TRUE(add(assembler, payload_of(one.device), kCaptured_ns));
  for (const std::string& payload : robosense_data(one, 10, 90.0)) EXPECT_TRUE(add(assembler, payload, kCaptured_ns));
  for (const std::string& payload : robosense_data(two, 10, 106.0)) EXPECT_TRUE(add(assembler, payload, kCaptured_ns));
  assembler.finish();
  EXPECT_EQ(assembler.take().value().points.size(), (10U * 4U + 10U * 2U) * 96U);

  RoboSenseExample helios = test::helios32_example();
  std::vector<std::string> data = robosense_data(helios, 12, 90.0);
  for (std::size_t i = 6; i < data.size(); ++i) data[i][17] = 0;
  EXPECT_TRUE(contains(decoded(helios, data, payload_of(helios.device)).refusal, "(byte 17)"));
}

TEST(RoboSense, ADevicePacketOfOtherSettingsIsRefused) {
  for (const RoboSenseExample& single : test::robosense_examples()) {
    if (single.word == "robosense_airy") continue;  // its data names its returns
    RoboSenseExample wrong = single;
    wrong.device.returns = 0;
    EXPECT_NE(decoded(wrong).refusal, "") << single.word;
    wrong = test::with_two_returns(single);
    wrong.device.returns = 1;
    EXPECT_NE(decoded(wrong).refusal, "") << single.word;
    wrong.device.returns = 9;
    EXPECT_TRUE(contains(decoded(wrong).refusal, "names 9 as its kind of returns")) << single.word;
  }
}

std::string m1_payload(std::uint16_t number, std::uint8_t returns = 1) {
  std::string payload(1210, '\0');
  test::put_at(&payload, 0, "\x55\xAA\x5A\xA5" + test::big_number(number, 2));
  for (std::size_t block = 0; block < 25; ++block) {
    const std::size_t at = 32 + 47 * block;
    payload[at] = static_cast<char>(6 * block);
    payload[at + 1] = static_cast<char>(block % returns + 1);
    for (std::size_t channel = 0; channel < 5; ++channel) {
      test::put_at(&payload, at + 2 + 9 * channel,
                   test::big_number(2000, 2) + test::big_number(32768 - 1000, 2) +
                       test::big_number(32768 + 3000 - 1000 * channel, 2) + "\x2A");
    }
  }
  return payload;
}

TEST(RoboSenseM1, PointsLieWhereTheirAnglesPutThem) {
  RoboSenseM1Assembler assembler;
  for (std::uint16_t number = 0; number < 630; ++number)
    EXPECT_TRUE(add(assembler, m1_payload(number), 158'730 * number));
  assembler.finish();
  const Scan scan = assembler.take().value();
  EXPECT_TRUE(scan.is_complete);
  ASSERT_EQ(scan.points.size(), 630U * 125U);
  // 10 m, 10 degrees down, 30 to the left, then 20.
  test::expect_at(scan.points[0], 10 * std::cos(10 * kRad) * std::cos(30 * kRad),
                  10 * std::cos(10 * kRad) * std::sin(30 * kRad), -10 * std::sin(10 * kRad));
  EXPECT_NEAR(std::atan2(scan.points[1].y_m, scan.points[1].x_m), 20 * kRad, 1e-6);
  EXPECT_EQ(scan.points[1].ring, 1U);
  EXPECT_EQ(scan.points[1].intensity, 42.0F);
  EXPECT_EQ(scan.points[125 + 5].t_ns, 158'730U + 6'000U);
}

TEST(RoboSenseM1, FramesAreCutByTheNumbersOfPackets) {
  RoboSenseM1Assembler assembler;
  const auto add_number = [&](std::uint16_t number) { EXPECT_TRUE(add(assembler, m1_payload(number), number)); };
  for (std::uint16_t number = 300; number < 630; ++number) add_number(number);
  for (std::uint16_t number = 0; number < 630; ++number) {
    add_number(number);
    if (number == 1) add_number(629);  // of the frame before
    if (number == 50) add_number(50);  // captured twice
    if (number == 60) add_number(58);  // again, and late
  }
  add_number(0);
  EXPECT_FALSE(assembler.take().value().is_complete);
  const Scan whole = assembler.take().value();
  EXPECT_TRUE(whole.is_complete);
  EXPECT_EQ(whole.points.size(), 630U * 125U);
  EXPECT_FALSE(assembler.take());
}

// A road as an M1 sees it: 120 by 25 degrees ahead of it.
sim::SceneSetup road_before_an_m1() {
  sim::SceneSetup setup = sim::make_setup("clean", "mid360", false, 1);
  setup.sensor.pattern_points = 200'000.0;  // a third of them within the view
  setup.sensor.elevation_min_deg = -12.5;
  setup.sensor.elevation_max_deg = 12.5;
  setup.sensor.window_from_deg = -60.0;
  setup.sensor.window_to_deg = 60.0;
  setup.mount.mount_roll_deg = 0.0;
  setup.machine.turned_left_deg = 4.0;
  setup.machine.lateral_m = 0.3;
  return setup;
}

// rs_driver 4eeadace: 25 blocks of 5, and 630 packets in 0.1 s.
constexpr std::size_t kM1PacketPoints = 125, kM1Packets = 630;
constexpr std::int64_t kM1Packet_us = 158;

// Returns one after another, five of a moment; behind them nothing comes back. The clock is in each packet.
std::vector<std::string> m1_packets(const sim::Frame& frame) {
  std::vector<std::string> packets;
  for (std::size_t number = 0; number < kM1Packets; ++number) {
    std::string payload = m1_payload(static_cast<std::uint16_t>(number));
    test::put_at(&payload, 10, test::robosense_time(900'000 + kM1Packet_us * static_cast<std::int64_t>(number), false));
    for (std::size_t k = 0; k < kM1PacketPoints; ++k) {
      const std::size_t i = number * kM1PacketPoints + k, at = 32 + 47 * (k / 5) + 2 + 9 * (k % 5);
      if (i >= frame.count()) {
        test::put_at(&payload, at, test::big_number(0, 2));
        continue;
      }
      const float* const p = &frame.xyz_intensity[4 * i];
      const double range_m = std::hypot(p[0], p[1], p[2]);
      const auto of_zero = [](double rad) {
        return static_cast<std::uint64_t>(std::lround(32'768.0 + 100.0 * rad / kRad));
      };
      test::put_at(&payload, at,
                   test::big_number(static_cast<std::uint64_t>(std::lround(range_m / 0.005)), 2) +
                       test::big_number(of_zero(std::asin(p[2] / range_m)), 2) +
                       test::big_number(of_zero(std::atan2(p[1], p[0])), 2));
    }
    packets.push_back(payload);
  }
  return packets;
}

TEST(RoboSenseM1, ARoadComesBackWithItsTimesAndItsValues) {
  const sim::SceneSetup setup = road_before_an_m1();
  const sim::Simulator simulator(setup, 1);
  const sim::Frame frame = simulator.render(0);
  ASSERT_GT(frame.count(), 50'000U);
  ASSERT_LT(frame.count(), kM1Packets * kM1PacketPoints);
  RoboSenseM1Assembler assembler;
  std::int64_t arrives_ns = kCaptured_ns;
  for (const std::string& packet : m1_packets(frame)) {
    EXPECT_TRUE(add(assembler, packet, arrives_ns));
    if (packet[5] % 16 == 0) arrives_ns += 16 * 1000 * kM1Packet_us;  // in bursts
  }
  assembler.finish();
  const Scan scan = assembler.take().value();
  ASSERT_EQ(scan.points.size(), kM1Packets * kM1PacketPoints);
  for (std::size_t i = 0; i < frame.count(); ++i) {
    const float* const p = &frame.xyz_intensity[4 * i];
    const ScanPoint& point = scan.points[i];
    // Half of 5 mm, and half of a hundredth of a degree both ways.
    ASSERT_LE(std::hypot(point.x_m - p[0], point.y_m - p[1], point.z_m - p[2]),
              0.0026 + 1.3e-4 * std::hypot(p[0], p[1], p[2]))
        << i;
    const auto moment = static_cast<std::int64_t>(i / 5 % 25) * 6;
    EXPECT_NEAR(point.t_ns,
                1000.0 * static_cast<double>(kM1Packet_us * static_cast<std::int64_t>(i / kM1PacketPoints) + moment),
                1'000.0)
        << i;
  }
  pose_wall_config config = pose_wall::test::config_with();
  for (const EngineSetting& setting : sim::find_sensor("mid360")->engine) {
    pose_wall::test::set(&config, setting.key.c_str(), setting.value.c_str());
  }
  pose_wall::test::EngineUnderTest engine(pose_wall::test::config_for(setup, config));
  const Frame decoded_frame = frame_of(scan);
  const pose_wall::test::JudgedFrame judged{engine.process(decoded_frame.cloud), simulator.truth(0),
                                            simulator.surveyed_truth(0)};
  // It looks ahead: floor nearby and walls behind are what it does not see.
  for (const std::uint32_t q : {POSE_WALL_YAW, POSE_WALL_D_LF, POSE_WALL_D_RF}) {
    EXPECT_TRUE(judged.is(q, POSE_WALL_VALID)) << pose_wall_quantity_name(q);
  }
  for (std::uint32_t q = 0; q < POSE_WALL_QUANTITIES; ++q) {
    if (judged.is(q, POSE_WALL_INVALID)) continue;
    EXPECT_LE(std::fabs(judged.error(q)), judged.result.quantity[q].protection_level) << pose_wall_quantity_name(q);
  }
}

// Behind an outage numbers may go on as if nothing had been: what comes is of another frame.
TEST(RoboSenseM1, AnOutageWithinAFrameEndsIt) {
  RoboSenseM1Assembler assembler;
  std::int64_t at_ns = kCaptured_ns;
  for (std::uint16_t number = 0; number < 630; ++number) {
    at_ns += number == 300 ? 500'000'000 : 158'730;
    EXPECT_TRUE(add(assembler, m1_payload(number), at_ns));
  }
  assembler.finish();
  for (const std::size_t packets : {300U, 330U}) {
    const Scan part = assembler.take().value();
    EXPECT_FALSE(part.is_complete);
    EXPECT_EQ(part.points.size(), packets * 125U);
    EXPECT_LT(part.points.back().t_ns, 100'000'000U);
  }
  EXPECT_FALSE(assembler.take());
}

TEST(RoboSenseM1, TwoReturnsAreRefused) {
  RoboSenseM1Assembler assembler;
  EXPECT_THROW(add(assembler, m1_payload(0, 2)), FrameError);
  EXPECT_FALSE(add(assembler, std::string(1210, 'x')));
}

}  // namespace
}  // namespace pose_wall::tools
