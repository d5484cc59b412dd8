// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: packets of a VLP-16 and of Ouster sensors become frames cut where turns end, with points where the manuals
// put them (worked out by hand), also from fragments; a capture cut at any byte says so. The capture of a real Ouster
// is looked at in tests/real.

#include <gtest/gtest.h>

#if POSE_WALL_HAS_PCAP

#include <cmath>
#include <functional>

#include "io/packets/ouster_metadata.hpp"
#include "packet_files.hpp"
#include "support/said_by.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

// Twelve blocks 6 degrees apart; all lasers at 10 m but laser 3, which has no return.
std::string velodyne_packet(std::uint32_t first_azimuth_deg) {
  std::string payload;
  for (std::uint32_t block = 0; block < 12; ++block) {
    payload += "\xFF\xEE" + raw(static_cast<std::uint16_t>((first_azimuth_deg + 6 * block) % 360 * 100));
    for (int laser = 0; laser < 32; ++laser) payload += raw(std::uint16_t(laser % 16 == 3 ? 0 : 5000)) + "\x2A";
  }
  return payload + raw(0U) + "\x37\x22";
}

std::string velodyne_capture(std::uint32_t from_deg, std::uint32_t packets) {
  std::string file = capture_head();
  for (std::uint32_t i = 0; i < packets; ++i) {
    file += captured(datagram(velodyne_packet((from_deg + 72 * i) % 360)), 1000 * i);
  }
  return file;
}

TEST(Velodyne, TurnsBecomeFramesAndThosePartlySeenAreLeftOut) {
  const TempFolder folder;
  // 180 degrees, then two turns of five packets, then 144 degrees.
  const ReadCapture capture = read(folder.write("v.pcap", velodyne_capture(216, 14)));
  EXPECT_TRUE(capture.errors.empty());
  ASSERT_EQ(capture.frames.size(), 2U);
  EXPECT_EQ(capture.announced, 2U);
  const pose_wall_cloud& cloud = capture.frames[0].frame->cloud;
  EXPECT_EQ(cloud.height, 16U);
  EXPECT_EQ(cloud.width, 120U) << "60 blocks of two firings";
  EXPECT_EQ(*capture.frames[0].stamp_ns, 1700000000002000000) << "of the packet in which it begins";
  EXPECT_EQ(*capture.frames[1].stamp_ns, 1700000000007000000);
  EXPECT_EQ(read(folder.write("part.pcap", velodyne_capture(90, 2))).frames.size(), 1U) << "all there is";
}

// In dual mode two blocks share an azimuth: the last return, and the strongest or, where the last is the strongest, the
// second strongest. Here dust stands at 4 m before a wall at 10 m.
TEST(Velodyne, OfTwoReturnsTheLastIsTaken) {
  const TempFolder folder;
  std::string file = capture_head();
  for (std::uint32_t i = 0; i < 10; ++i) {
    std::string payload;
    for (std::uint32_t block = 0; block < 12; ++block) {
      payload += "\xFF\xEE" + raw(static_cast<std::uint16_t>((36 * i + 6 * (block / 2)) % 360 * 100));
      for (int laser = 0; laser < 32; ++laser) payload += raw(std::uint16_t(block % 2 == 0 ? 5000 : 2000)) + "\x2A";
    }
    file += captured(datagram(payload + raw(0U) + "\x39\x22"), 1000 * i);
  }
  const ReadCapture capture = read(folder.write("dual.pcap", file));
  ASSERT_EQ(capture.frames.size(), 1U);
  const Frame& frame = *capture.frames[0].frame;
  EXPECT_EQ(frame.cloud.width, 120U) << "60 pairs of blocks of two firings";
  for (std::uint32_t i = 0; i < 16 * 120; ++i) {
    const double x = number_at(frame, frame.cloud.x, i), y = number_at(frame, frame.cloud.y, i);
    EXPECT_GT(std::hypot(x, y), 9.0) << i;
  }
}

TEST(Velodyne, PointsLieWhereTheManualPutsThem) {
  const TempFolder folder;
  const ReadCapture capture = read(folder.write("v.pcap", velodyne_capture(0, 5)));
  ASSERT_EQ(capture.frames.size(), 1U);
  const Frame& frame = *capture.frames[0].frame;
  const pose_wall_cloud& cloud = frame.cloud;
  const auto at = [&](std::uint32_t ring, std::uint32_t firing) { return ring * cloud.width + firing; };
  // Block 15 is at 90 degrees: to the right, which is -y. Laser 0 fires first, at -15 degrees, 11.2 mm above the
  // origin.
  EXPECT_NEAR(number_at(frame, cloud.x, at(0, 30)), 0.0, 1e-5);
  EXPECT_NEAR(number_at(frame, cloud.y, at(0, 30)), -9.659258, 1e-5);
  EXPECT_NEAR(number_at(frame, cloud.z, at(0, 30)), -2.588190 + 0.0112, 1e-5);
  // Laser 15, at +15 degrees, fires 15 * 2.304 us later: 34.56 of the 110.592 us in which the head turns by 6 degrees.
  const double azimuth_rad = (90.0 + 6.0 * 34.56 / 110.592) * 0.017453292519943295;
  EXPECT_NEAR(number_at(frame, cloud.x, at(15, 30)), 9.659258 * std::cos(azimuth_rad), 1e-5);
  EXPECT_NEAR(number_at(frame, cloud.z, at(15, 30)), 2.588190 - 0.0112, 1e-5);
  // The second firing of a block is half a step further.
  EXPECT_NEAR(number_at(frame, cloud.x, at(0, 31)), -9.659258 * std::sin(3.0 * 0.017453292519943295), 1e-5);
  // Laser 3 is at 3 degrees: ring 9 from below.
  EXPECT_EQ(number_at(frame, cloud.x, at(9, 30)), 0.0);
  EXPECT_EQ(number_at(frame, cloud.z, at(9, 30)), 0.0);
  EXPECT_EQ(number_at(frame, cloud.intensity, at(0, 30)), 42.0);
}

TEST(PacketCapture, CutAnywhereItSaysSo) {
  const TempFolder folder;
  const std::string whole = velodyne_capture(0, 11);
  std::size_t most = 0;
  for (std::size_t length = 0; length < whole.size(); length += length < 100 ? 1 : 97) {
    const std::string cut = whole.substr(0, length);
    const bool between_packets = length > 24 && (length - 24) % ((whole.size() - 24) / 11) == 0;
    const ReadCapture capture = read(folder.write("cut.pcap", cut));
    most = std::max(most, capture.frames.size());
    if (between_packets) continue;
    EXPECT_EQ(capture.errors.size(), 1U) << length;
  }
  EXPECT_EQ(most, 2U);
}

std::string pcapng_block(std::uint32_t type, const std::string& body) {
  const auto size = static_cast<std::uint32_t>(12 + body.size());
  return raw(type) + raw(size) + body + raw(size);
}

// Of an Ethernet card (1) or of cooked packets (113).
std::string pcapng_interface(std::uint16_t link) {
  return pcapng_block(1, raw(link) + raw(std::uint16_t{0}) + raw(65535U));
}

// Of the first interface, as the classic capture has them.
std::string pcapng_packets(const std::string& capture) {
  constexpr std::size_t kCaptureHead = 24, kPacketHead = 16;  // bytes, of a classic capture
  const std::size_t size = (capture.size() - kCaptureHead) / 14;
  std::string blocks;
  for (std::uint32_t i = 0; i < 14; ++i) {
    std::string packet = capture.substr(kCaptureHead + size * i + kPacketHead, size - kPacketHead);
    const auto bytes = static_cast<std::uint32_t>(packet.size());
    packet.resize((packet.size() + 3) / 4 * 4);
    blocks += pcapng_block(6, raw(0U) + raw(0U) + raw(1000 * i) + raw(bytes) + raw(bytes) + packet);
  }
  return blocks;
}

// A program that records all interfaces writes such a file. libpcap ends at the second description.
TEST(PacketCapture, TwoLinkLayersInOneFileAreReadToTheSecondWithWordsThatHelp) {
  const std::string head = pcapng_block(0x0A0D0D0A, raw(0x1A2B3C4DU) + raw(1U) + raw(~std::uint64_t{0}));
  const std::string packets = pcapng_packets(velodyne_capture(216, 14));
  const TempFolder folder;
  const auto read_as = [&](const std::string& blocks) { return read(folder.write("two.pcapng", head + blocks)); };
  const ReadCapture alike = read_as(pcapng_interface(1) + pcapng_interface(1) + packets);
  EXPECT_TRUE(alike.errors.empty());
  EXPECT_EQ(alike.frames.size(), 2U);
  const ReadCapture early = read_as(pcapng_interface(1) + pcapng_interface(113) + packets);
  EXPECT_EQ(early.frames.size(), 0U);
  const ReadCapture late = read_as(pcapng_interface(1) + packets + pcapng_interface(113) + packets);
  EXPECT_EQ(late.frames.size(), 2U);
  for (const ReadCapture& capture : {std::cref(early), std::cref(late)}) {
    ASSERT_EQ(capture.errors.size(), 1U);
    for (const char* const word : {"different link layers", "tcpdump -i NAME", "tcpdump -i any"}) {
      EXPECT_NE(capture.errors.front().find(word), std::string::npos) << capture.errors.front();
    }
  }
}

TEST(PacketCapture, OneWithoutKnownPacketsSaysWhatItHolds) {
  const TempFolder folder;
  const auto refused = [&](const std::string& file) { return refusal_of(read(folder.write("v.pcap", file))); };
  EXPECT_NE(refused(capture_head() + captured(datagram("hello"), 0)).find("; 1 packets of 5 bytes to port 2368"),
            std::string::npos);
  EXPECT_NE(refused(capture_head()).find("it holds no UDP packet"), std::string::npos);
  EXPECT_NE(refused("").find("the file is empty"), std::string::npos);
}

// Two rings, sixteen columns of a turn, four of a packet; beams leave level and 0.1 m out.
std::string ouster_metadata(const std::string& profile) {
  return R"({"prod_line": "OS-test", "beam_altitude_angles": [0, -90], "beam_azimuth_angles": [0, 0],
 "lidar_origin_to_beam_origin_mm": 100,
 "lidar_to_sensor_transform": [-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 36, 0, 0, 0, 1],
 "data_format": {"columns_per_frame": 16, "columns_per_packet": 4, "pixels_per_column": 2,
 "udp_profile_lidar": ")" +
         profile + "\"}}";
}

// Ranges: 5 m where it is not zero for the low profile, which counts 8 mm.
std::string ouster_pixel(const std::string& profile) {
  if (profile == "RNG15_RFL8_NIR8") return raw(std::uint16_t{625}) + "\x07\x01";
  if (profile == "LEGACY") return raw(0xF0000000U | 5000U) + raw(std::uint16_t{7}) + raw(0U) + std::string(2, '\0');
  if (profile == "RNG19_RFL8_SIG16_NIR16") return raw(0xFFF80000U | 5000U) + "\x07" + std::string(7, '\0');
  return raw(0x07000000U | 5000U) + raw(9999U) + std::string(8, '\0');
}

std::string ouster_packet(const std::string& profile, std::uint16_t frame, std::uint16_t first_column) {
  const bool is_legacy = profile == "LEGACY";
  std::string payload = is_legacy ? "" : raw(std::uint16_t{1}) + raw(frame) + std::string(28, '\0');
  for (std::uint16_t i = 0; i < 4; ++i) {
    const auto column = static_cast<std::uint16_t>(first_column + i);
    payload += raw(std::uint64_t{1000} * (frame * 16U + column)) + raw(column);
    payload += is_legacy ? raw(frame) + raw(0U) : raw(std::uint16_t{1});
    payload += ouster_pixel(profile) + ouster_pixel(profile);
    if (is_legacy) payload += raw(0xFFFFFFFFU);
  }
  return is_legacy ? payload : payload + std::string(32, '\0');
}

void expect_ouster_points(const Frame& frame, const std::string& profile) {
  const pose_wall_cloud& cloud = frame.cloud;
  EXPECT_EQ(cloud.height, 2U);
  EXPECT_EQ(cloud.width, 16U);
  // Level beams: 5 m in all. Column 0 looks along +x of the lidar, which is -x of the sensor; column 4 a quarter turn
  // on.
  EXPECT_NEAR(number_at(frame, cloud.x, 0), -5.0, 1e-6) << profile;
  EXPECT_NEAR(number_at(frame, cloud.y, 4), 5.0, 1e-6) << profile;
  EXPECT_NEAR(number_at(frame, cloud.z, 4), 0.036, 1e-6) << profile;
  // Straight down: 4.9 m below, 0.1 m out.
  EXPECT_NEAR(number_at(frame, cloud.x, 16), -0.1, 1e-6) << profile;
  EXPECT_NEAR(number_at(frame, cloud.z, 16), -4.9 + 0.036, 1e-6) << profile;
  EXPECT_EQ(number_at(frame, cloud.intensity, 16), 7.0) << profile;
}

TEST(Ouster, EveryProfileGivesFramesByTheirNumber) {
  const TempFolder folder;
  for (const char* profile : {"LEGACY", "RNG15_RFL8_NIR8", "RNG19_RFL8_SIG16_NIR16", "RNG19_RFL8_SIG16_NIR16_DUAL"}) {
    folder.write("o.json", ouster_metadata(profile));
    // The second half of frame 5, all of 6 and of 7.
    std::string file = capture_head();
    for (std::uint32_t packet = 22; packet < 32; ++packet) {
      const auto frame = static_cast<std::uint16_t>(packet / 4);
      file += captured(datagram(ouster_packet(profile, frame, static_cast<std::uint16_t>(packet % 4 * 4))), packet);
    }
    const ReadCapture capture = read(folder.write("o.pcap", file));
    EXPECT_TRUE(capture.errors.empty()) << profile;
    ASSERT_EQ(capture.frames.size(), 2U) << profile;
    EXPECT_EQ(*capture.frames[0].stamp_ns, 96000);
    expect_ouster_points(*capture.frames[0].frame, profile);
    expect_ouster_points(*capture.frames[1].frame, profile);
  }
}

TEST(Ouster, FragmentsArePutTogetherInAnyOrderAndAColumnThatDidNotComeIsEmpty) {
  const TempFolder folder;
  const std::string profile = "LEGACY";
  folder.write("o.json", ouster_metadata(profile));
  std::string file = capture_head();
  for (const unsigned column : {0U, 8U, 12U}) {
    const std::string content = datagram(ouster_packet(profile, 1, static_cast<std::uint16_t>(column)));
    file += captured(content.substr(96), 2, 96 / 8) + captured(content.substr(0, 96), 1, 0x2000);
  }
  const ReadCapture capture = read(folder.write("o.pcap", file));
  ASSERT_EQ(capture.frames.size(), 1U);
  const Frame& frame = *capture.frames[0].frame;
  EXPECT_NEAR(number_at(frame, frame.cloud.x, 8), 5.0, 1e-6);
  EXPECT_EQ(number_at(frame, frame.cloud.y, 4), 0.0);
}

TEST(OusterMetadata, FaultsAreNamed) {
  const auto refusal = [](std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    if (at != std::string::npos) text.replace(at, from.size(), to);
    return test::said_by<FrameError>([&] { parse_ouster_metadata(text); });
  };
  const std::string good = ouster_metadata("LEGACY");
  EXPECT_EQ(refusal(good, "", ""), "");
  EXPECT_NE(refusal(good, "{", "[").find("no JSON"), std::string::npos);
  EXPECT_NE(refusal(good, "LEGACY", "FUSA").find("'FUSA' is not read"), std::string::npos);
  EXPECT_NE(refusal(good, "[0, -90]", "[0]").find("no list of 2 numbers"), std::string::npos);
  EXPECT_NE(refusal(good, "\"columns_per_frame\": 16", "\"columns_per_frame\": -1").find("1 to 4096"),
            std::string::npos);
  EXPECT_NE(refusal(good, "lidar_to_sensor", "x").find("no 'lidar_to_sensor_transform'"), std::string::npos);
}

}  // namespace
}  // namespace pose_wall::tools

#endif
