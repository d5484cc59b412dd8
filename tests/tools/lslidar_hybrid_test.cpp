// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: packets of a CH128X1 give points where its mirror sends the light, at their times, in frames that begin at
// the mark. Points are worked out by hand, among them the first one of a real sensor's packet. What its device packet
// has to tell is demanded.

#include <gtest/gtest.h>

#include <random>

#include "io/packets/lslidar_hybrid.hpp"
#include "io/packets/sensors.hpp"
#include "lslidar_packets.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr std::uint32_t kTenMetres = 256'000;  // a CH128X1 counts 1/256 cm, as its driver divides

const std::string kFaces = LslidarDevice{}.set_words(242, {0, -17, -34, -51}).bytes;

std::string refusal_of_hybrid(const std::vector<std::string>& payloads) {
  LslidarHybridAssembler assembler;
  try {
    for (const std::string& payload : payloads) add(assembler, payload);
    assembler.finish();
  } catch (const FrameError& refused) {
    return refused.what();
  }
  return "read";
}

// The first frame of packets that come each 225 us.
Scan first_frame(const std::vector<std::string>& payloads) {
  SensorChoice choice;
  choice.kind = SensorKind::kLslidarCh128x1;
  const std::unique_ptr<ScanAssembler> assembler = make_assembler(choice);
  std::int64_t captured_ns = 1'000'000'000;
  for (const std::string& payload : payloads) EXPECT_TRUE(add(*assembler, payload, captured_ns += 225'000));
  assembler->finish();
  return assembler->take().value_or(Scan{});
}

TEST(LslidarHybrid, PointsLieWhereTheMirrorSendsTheLight) {
  // The first is of a real sensor: line 65, 92.08 degrees, 9.14 m.
  const std::vector<HybridPoint> points = {{65, 9208, 234'000}, {3, 6000, kTenMetres}, {0, 9000, 0}};
  const Scan scan = first_frame({kFaces, hybrid_payload(points, 1000)});
  ASSERT_EQ(scan.points.size(), 171U);
  expect_at(scan.points[0], 9.120037, 0.331229, -0.515975);
  EXPECT_EQ(scan.points[0].ring, 65U);
  EXPECT_EQ(scan.points[0].intensity, 9.0F);
  expect_at(scan.points[1], 8.241856, -4.758438, -3.070682);
  expect_at(scan.points[2], 0.0, 0.0, 0.0);
  // Every other group of lines stands higher by what the device packet says. Faces that were not written: the design's.
  const std::string raised = LslidarDevice{}.set_words(240, {30, 0, 0, 0, 0}).bytes;
  const Scan other =
      first_frame({raised, hybrid_payload({{3, 6000, kTenMetres}, {7, 6000, kTenMetres}, {65, 9000, 0}}, 1)});
  expect_at(other.points[0], 8.255666, -4.766411, -3.020812);
  expect_at(other.points[1], 8.287009, -4.784507, -2.904130);
}

TEST(LslidarHybrid, AFrameBeginsAtTheMarkAndTimesGoBackFromThePacketsEnd) {
  std::vector<HybridPoint> points(171, HybridPoint{65, 9000, kTenMetres}), marked = points;
  marked[62] = kHybridMark;
  std::vector<std::string> payloads = {kFaces};
  for (std::uint32_t i = 0; i < 12; ++i)
    payloads.push_back(hybrid_payload(i % 4 == 2 ? marked : points, 100 + 225 * i));
  LslidarHybridAssembler assembler;
  for (std::size_t i = 0; i < payloads.size(); ++i) {
    add(assembler, payloads[i], 1'000'000'000 + 225'000 * static_cast<std::int64_t>(i));
  }
  assembler.finish();
  std::vector<Scan> scans;
  while (std::optional<Scan> scan = assembler.take()) scans.push_back(std::move(*scan));
  ASSERT_EQ(scans.size(), 4U);
  EXPECT_FALSE(scans[0].is_complete);
  EXPECT_TRUE(scans[1].is_complete && scans[2].is_complete);
  EXPECT_FALSE(scans[3].is_complete);
  EXPECT_EQ(scans[1].points.size(), 4U * 171U - 1U);
  // Packet 3 ends at its arrival, 675 us after the first.
  EXPECT_NEAR(static_cast<double>(scans[1].stamp_ns - 1'000'000'000), 450e3 + 225e3 * 63.0 / 171.0, 2.0);
  EXPECT_NEAR(scans[1].points[300].t_ns, 225e3 / 171.0 * 300.0, 3.0);
}

TEST(LslidarHybrid, OfTwoReturnsTheFartherIsTaken) {
  const std::vector<HybridPoint> points = {{65, 9208, 234'000, 100'000}, {65, 9208, 100'000, 234'000}};
  const Scan scan = first_frame({kFaces, hybrid_payload(points, 1000, 2)});
  ASSERT_EQ(scan.points.size(), 109U);
  expect_at(scan.points[0], 9.120037, 0.331229, -0.515975);
  expect_at(scan.points[1], 9.120037, 0.331229, -0.515975);
  EXPECT_EQ(scan.points[0].intensity, 9.0F);
  EXPECT_EQ(scan.points[1].intensity, 10.0F);
}

TEST(LslidarHybrid, WhatTheDevicePacketHasToTellIsDemanded) {
  const std::string data = hybrid_payload({{65, 9208, 234'000}}, 1000);
  EXPECT_TRUE(contains(refusal_of_hybrid({data, data}), "2369"));
  EXPECT_EQ(refusal_of_hybrid({data, kFaces}), "read");
  const std::string rising = LslidarDevice{}.set_words(242, {0, 35, 70, 105}).bytes;
  EXPECT_TRUE(contains(refusal_of_hybrid({rising, data}), "CH64W"));
  const std::string far = LslidarDevice{}.set_words(242, {0, -17, -34, -5100}).bytes;
  EXPECT_TRUE(contains(refusal_of_hybrid({far, data}), "-51.00 degrees"));
  const std::string low = hybrid_payload({{5, 9208, 234'000}}, 1000);
  EXPECT_TRUE(contains(refusal_of_hybrid({kFaces, low}), "no line from 64 on"));
}

TEST(LslidarHybrid, ItIsReadWhereItIsNamedAndNamedWhereItIsNot) {
  const std::string data = hybrid_payload({{65, 9208, 234'000}}, 1000);
  EXPECT_TRUE(contains(unread_sensor(test::view_of(data)), "lslidar_ch128x1"));
  EXPECT_FALSE(recognise_sensor(test::view_of(data)));
  EXPECT_FALSE(is_lslidar_hybrid(test::view_of(payload_of(test::LslidarPacket{}))));
  EXPECT_FALSE(is_lslidar_hybrid(test::view_of(payload_of(test::VelodynePacket{}))));
  EXPECT_FALSE(is_lslidar_hybrid(test::view_of(kFaces)));
}

TEST(LslidarHybrid, DamagedPacketsAreRefusedOrStayInRange) {
  std::mt19937 random(3);
  const std::vector<HybridPoint> points(171, HybridPoint{65, 9000, kTenMetres});
  std::size_t read_points = 0;
  for (int round = 0; round < 300; ++round) {
    LslidarHybridAssembler assembler;
    try {
      for (std::uint32_t i = 0; i < 10; ++i) {
        std::string payload = i == 3 ? kFaces : hybrid_payload(points, 225 * i);
        for (int change = 0; change < 3; ++change) payload[random() % payload.size()] = static_cast<char>(random());
        add(assembler, payload, 225'000 * i);
      }
      assembler.finish();
    } catch (const FrameError& refused) {
      EXPECT_STRNE(refused.what(), "");
    }
    while (const std::optional<Scan> scan = assembler.take()) {
      for (const ScanPoint& point : scan->points) {
        ASSERT_LT(std::hypot(point.x_m, point.y_m, point.z_m), 656.0);
        ++read_points;
      }
    }
  }
  EXPECT_GT(read_points, 100'000U);
}

}  // namespace
}  // namespace pose_wall::tools
