// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: the capture of a real Ouster OS0-32 becomes one frame whose ranges are those of its packets, decoded here a
// second time at fixed places of the file, and whose beams leave at the angles of its metadata.

#include <gtest/gtest.h>

#if POSE_WALL_HAS_PCAP

#include <array>
#include <cstring>
#include <iterator>
#include <optional>
#include <vector>

#include "io/frames/point_position.hpp"
#include "io/frames/told_rings.hpp"
#include "io/inputs/frame_sequence.hpp"
#include "study/doctor/recording.hpp"
#include "study/info/sensor_look.hpp"
#include "support/real_frames.hpp"

namespace pose_wall::test {
namespace {

const std::filesystem::path kCapture = data_folder() / "packets" / "OS-0-32-U1_v2.2.0_1024x10.pcap";
constexpr std::size_t kRings = 32;
constexpr std::size_t kColumns = 1024;

// Of metadata: the two lists are short enough to stand here.
constexpr std::array<double, kRings> kAltitude_deg = {43.88,  40.9,   37.94,  34.98,  32.06,  29.16,  26.25,  23.37,
                                                      20.51,  17.66,  14.81,  11.99,  9.17,   6.35,   3.55,   0.72,
                                                      -2.09,  -4.9,   -7.72,  -10.55, -13.38, -16.22, -19.06, -21.92,
                                                      -24.79, -27.68, -30.58, -33.49, -36.43, -39.39, -42.38, -45.4};

std::vector<std::uint32_t> ranges_mm(const std::string& file) {
  std::vector<std::uint32_t> ranges(kRings * kColumns, 0);
  const auto number = [&](std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    std::memcpy(&value, file.data() + at, size);
    return value;
  };
  for (std::size_t at = 24; at + 16 <= file.size(); at += 16 + number(at + 8, 4)) {
    if (number(at + 8, 4) != 8490) continue;  // Ethernet, IP, UDP: 42 bytes; then 8448 of sixteen columns
    for (std::size_t i = 0; i < 16; ++i) {
      const std::size_t column = at + 16 + 42 + 32 + i * 524;
      for (std::size_t ring = 0; ring < kRings; ++ring) {
        ranges[ring * kColumns + number(column + 8, 2)] = number(column + 12 + 16 * ring, 4) & 0x7FFFFU;
      }
    }
  }
  return ranges;
}

TEST(OusterCapture, RangesAndAnglesAreThoseOfItsPackets) {
  if (!std::filesystem::exists(kCapture)) GTEST_SKIP() << "POSE_WALL_DATA names no folder with it";
  tools::FrameSequence frames({kCapture.string()});
  const std::optional<tools::SourcedFrame> sourced = frames.next();
  ASSERT_TRUE(sourced && sourced->frame);
  EXPECT_FALSE(frames.next());
  const pose_wall_cloud& cloud = sourced->frame->cloud;
  ASSERT_EQ(cloud.height, kRings);
  ASSERT_EQ(cloud.width, kColumns);
  std::ifstream stream(kCapture, std::ios::binary);
  const std::vector<std::uint32_t> ranges =
      ranges_mm({std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()});
  std::size_t returns = 0;
  for (std::uint32_t ring = 0; ring < kRings; ++ring) {
    for (std::uint32_t column = 0; column < kColumns; ++column) {
      const Eigen::Vector3d point = tools::point_position(cloud, ring, column);
      const double range_m = 1e-3 * ranges[ring * kColumns + column];
      if (range_m == 0.0) {
        ASSERT_EQ(point.norm(), 0.0);
        continue;
      }
      ++returns;
      // Back to where the beam left: 27.67 mm out in the direction of the encoder, which the sensor's frame sees half a
      // turn further, and 36.18 mm up.
      const double encoder_rad = M_PI * (1.0 - 2.0 * column / kColumns);
      const Eigen::Vector3d origin(0.02767 * std::cos(encoder_rad), 0.02767 * std::sin(encoder_rad), 0.03618);
      const Eigen::Vector3d beam = point - origin;
      ASSERT_NEAR(beam.norm(), range_m - 0.02767, 1e-5);
      ASSERT_NEAR(beam.z(), beam.norm() * std::sin(kAltitude_deg[ring] * kRadPerDeg), 1e-5);
    }
  }
  EXPECT_GT(returns, 20'000U);
}

// The beams of this sensor leave away from its origin: where the points lie, 43 rings could be counted.
TEST(OusterCapture, InfoAndDoctorSeeTheSameRings) {
  if (!std::filesystem::exists(kCapture)) GTEST_SKIP() << "POSE_WALL_DATA names no folder with it";
  tools::FrameSequence frames({kCapture.string()}), again({kCapture.string()});
  const std::optional<tools::SourcedFrame> first = frames.next();
  const tools::Frame& frame = *first->frame;
  tools::SensorLook look;
  look.add(tools::returns_of(frame.cloud), tools::told_rings(frame));
  EXPECT_EQ(look.facts().rings, kRings);
  const tools::doctor::Recording recording = tools::doctor::read_recording(again, 10.0, [](const std::string&) {});
  EXPECT_EQ(recording.sensor.facts().rings, kRings);
}

}  // namespace
}  // namespace pose_wall::test

#endif
