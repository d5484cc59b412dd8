// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: packets of a Mid-360, made by hand from Livox's description, give points of all three data types with their
// times, in frames cut by the sensor's clock, whatever that does; counts beyond a packet are not believed.

#include <gtest/gtest.h>

#include <cmath>

#include "io/packets/livox.hpp"
#include "packet_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr std::uint64_t kStart_ns = 1'700'000'000'000'000'000;
constexpr std::uint64_t kMs = 1'000'000;

std::string in_mm(std::int32_t x, std::int32_t y, std::int32_t z) {
  return raw(x) + raw(y) + raw(z) + "\x2A\x01";
}
std::string in_cm(std::int16_t x, std::int16_t y, std::int16_t z) {
  return raw(x) + raw(y) + raw(z) + "\x2A\x01";
}
std::string in_degrees(std::uint32_t depth_mm, std::uint16_t zenith, std::uint16_t azimuth) {
  return raw(depth_mm) + raw(zenith) + raw(azimuth) + "\x2A\x01";
}

Scan scan_of(const std::string& payload) {
  LivoxAssembler assembler(LivoxModel::kMid360);
  EXPECT_TRUE(add(assembler, payload));
  assembler.finish();
  return assembler.take().value();
}

TEST(Livox, PointsOfEveryDataType) {
  const Scan mm = scan_of(mid360_payload(1, kStart_ns, {in_mm(1000, -2000, 3005), in_mm(0, 0, 0)}));
  ASSERT_EQ(mm.points.size(), 2U);
  EXPECT_EQ(mm.rings, 1U);
  expect_at(mm.points[0], 1.0, -2.0, 3.005);
  EXPECT_EQ(mm.points[0].intensity, 42.0F);
  expect_at(mm.points[1], 0.0, 0.0, 0.0);
  expect_at(scan_of(mid360_payload(2, kStart_ns, {in_cm(100, -200, -301)})).points[0], 1.0, -2.0, -3.01);
  const Scan spherical = scan_of(
      mid360_payload(3, kStart_ns, {in_degrees(2000, 9000, 9000), in_degrees(2000, 6000, 0), in_degrees(0, 1, 1)}));
  expect_at(spherical.points[0], 0.0, 2.0, 0.0);
  expect_at(spherical.points[1], std::sqrt(3.0), 0.0, 1.0);
  expect_at(spherical.points[2], 0.0, 0.0, 0.0);
}

TEST(Livox, PointsHaveTimesWithinTheirFrame) {
  LivoxAssembler assembler(LivoxModel::kMid360);
  const std::vector<std::string> points(4, in_mm(1000, 0, 0));
  EXPECT_TRUE(add(assembler, mid360_payload(1, kStart_ns, points, 4800)));
  EXPECT_TRUE(add(assembler, mid360_payload(1, kStart_ns + 10 * kMs, points, 4800)));
  assembler.finish();
  const Scan scan = assembler.take().value();
  EXPECT_EQ(scan.stamp_ns, static_cast<std::int64_t>(kStart_ns));
  ASSERT_EQ(scan.points.size(), 8U);
  // 4800 tenths of a microsecond for four points: 0.12 ms from one to the next.
  EXPECT_EQ(scan.points[0].t_ns, 0U);
  EXPECT_EQ(scan.points[3].t_ns, 360'000U);
  EXPECT_EQ(scan.points[5].t_ns, 10'120'000U);
  EXPECT_EQ(scan.points[5].ring, 1U);
}

std::vector<std::size_t> frames_of(const std::vector<std::uint64_t>& times_ns, std::int64_t frame_ns,
                                   std::vector<bool>* complete = nullptr) {
  LivoxAssembler assembler(std::nullopt, frame_ns);
  for (const std::uint64_t time_ns : times_ns) {
    EXPECT_TRUE(add(assembler, mid360_payload(1, time_ns, {in_mm(1000, 0, 0)})));
  }
  assembler.finish();
  std::vector<std::size_t> sizes;
  while (const std::optional<Scan> scan = assembler.take()) {
    sizes.push_back(scan->points.size());
    if (complete != nullptr) complete->push_back(scan->is_complete);
  }
  return sizes;
}

TEST(Livox, FramesAreCutByTheSensorsTime) {
  std::vector<std::uint64_t> times_ns;
  for (std::uint64_t i = 0; i < 25; ++i) times_ns.push_back(kStart_ns + i * 10 * kMs);
  std::vector<bool> complete;
  EXPECT_EQ(frames_of(times_ns, kLivoxFrame_ns, &complete), (std::vector<std::size_t>{10, 10, 5}));
  EXPECT_EQ(complete, (std::vector<bool>{true, true, false}));
  EXPECT_EQ(frames_of(times_ns, 50'000'000), (std::vector<std::size_t>{5, 5, 5, 5, 5}));
}

TEST(Livox, AClockThatJumpsBeginsAnotherFrame) {
  const std::uint64_t far = ~std::uint64_t{0};
  std::vector<bool> complete;
  EXPECT_EQ(frames_of({kStart_ns, kStart_ns + kMs, kStart_ns - 5 * kMs, far, 0}, kLivoxFrame_ns, &complete),
            (std::vector<std::size_t>{2, 1, 1, 1}));
  EXPECT_FALSE(complete[0]) << "the clock went back before it was full";
}

TEST(Livox, APacketThatComesLateBeginsNoFrame) {
  std::vector<std::uint64_t> times_ns;
  for (std::uint64_t i = 0; i < 20; ++i) times_ns.push_back(kStart_ns + i * 10 * kMs);
  times_ns.insert(times_ns.begin() + 11,
                  kStart_ns + 100 * kMs - kMs / 2);  // of the first frame, behind the second's first
  EXPECT_EQ(frames_of(times_ns, kLivoxFrame_ns), (std::vector<std::size_t>{10, 10}));
}

TEST(Livox, FramesOfNoLengthAreRefused) {
  for (const std::int64_t frame_ns : {std::int64_t{0}, std::int64_t{-1}, std::int64_t{10'000'000'001}}) {
    EXPECT_THROW(LivoxAssembler(std::nullopt, frame_ns), FrameError) << frame_ns;
  }
}

TEST(Livox, WhatIsNoDataIsNotTaken) {
  const std::string good = mid360_payload(1, kStart_ns, {in_mm(1, 2, 3), in_mm(1, 2, 3)});
  LivoxAssembler assembler(LivoxModel::kMid360);
  for (std::size_t size = 0; size < good.size(); ++size) EXPECT_FALSE(add(assembler, good.substr(0, size))) << size;
  EXPECT_FALSE(add(assembler, good + "x"));
  std::string beyond = good, none = good, imu = good, type = good, version = good;
  beyond.replace(5, 2, "\xFF\xFF");
  none.replace(5, 2, std::string(2, '\0'));
  imu[10] = '\0';
  type[10] = '\x04';
  version[0] = '\x05';
  for (const std::string& wrong : {beyond, none, imu, type, version}) EXPECT_FALSE(add(assembler, wrong));
  assembler.finish();
  EXPECT_FALSE(assembler.take());
  EXPECT_TRUE(add(assembler, good));
}

}  // namespace
}  // namespace pose_wall::tools
