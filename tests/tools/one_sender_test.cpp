// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 the pose_wall authors

// Proves: of several sensors on one wire one is read and the others are named, whatever tells them apart. Packets that
// were captured twice or came late change no frame. Turns end in any field of view. What lies below IP is passed over.

#include "io/packets/one_sender.hpp"

#include <gtest/gtest.h>

#if POSE_WALL_HAS_PCAP

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

#include "io/packets/velodyne.hpp"
#include "packet_files.hpp"

namespace pose_wall::tools {
namespace {

using namespace test;

constexpr std::int64_t kPacket_us = 1327;  // of a VLP-16

struct SentPacket {
  std::string payload;
  std::int64_t at_us = 0;
  Sender from{0x0A010101, 2368, 2368, 0xAA0000000001, ""};
};

// Turns of a VLP-16 that sees walls at `units` of 2 mm, 12 degrees a packet.
std::vector<SentPacket> turns(std::size_t count, std::uint16_t units, std::size_t first_packet = 0) {
  std::vector<SentPacket> packets;
  for (std::size_t i = first_packet; i < 30 * count; ++i) {
    VelodynePacket packet;
    packet.first_deg = 12.0 * static_cast<double>(i % 30);
    packet.step_deg = 1.0;
    packet.clock_us = static_cast<std::uint32_t>(kPacket_us * static_cast<std::int64_t>(i));
    packet.distance = [units](std::size_t, std::size_t) { return units; };
    packets.push_back(
        {payload_of(packet), kPacket_us * static_cast<std::int64_t>(i), {0x0A010101, 2368, 2368, 0xAA0000000001, ""}});
  }
  return packets;
}

std::vector<SentPacket> sent_by(std::vector<SentPacket> packets, const Sender& from, std::int64_t later_us = 0) {
  for (SentPacket& packet : packets) {
    packet.from = from;
    packet.at_us += later_us;
  }
  return packets;
}

std::vector<SentPacket> mixed(std::vector<SentPacket> a, const std::vector<SentPacket>& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::stable_sort(a.begin(), a.end(), [](const SentPacket& x, const SentPacket& y) { return x.at_us < y.at_us; });
  return a;
}

std::string big32(std::uint32_t number) {
  return big(static_cast<std::uint16_t>(number >> 16U)) + big(static_cast<std::uint16_t>(number & 0xFFFFU));
}

std::string ip_packet(const SentPacket& packet) {
  const auto size = static_cast<std::uint16_t>(packet.payload.size());
  return "\x45" + std::string(1, '\0') + big(static_cast<std::uint16_t>(28 + size)) + big(77) + big(0) + "\x40\x11" +
         big(0) + big32(packet.from.address) + big32(0x0A010102) + big(packet.from.port) + big(packet.from.to_port) +
         big(static_cast<std::uint16_t>(8 + size)) + big(0) + packet.payload;
}

std::string card_of(const SentPacket& packet) {
  return big(static_cast<std::uint16_t>(packet.from.card >> 32U)) + big32(static_cast<std::uint32_t>(packet.from.card));
}

std::string record_of(const std::string& frame, std::int64_t at_us, std::size_t kept = 65535) {
  const auto size = static_cast<std::uint32_t>(frame.size());
  return raw(1700000000U + static_cast<std::uint32_t>(at_us / 1'000'000)) +
         raw(static_cast<std::uint32_t>(at_us % 1'000'000)) + raw(std::min(size, static_cast<std::uint32_t>(kept))) +
         raw(size) + frame.substr(0, kept);
}

// `tags`: what stands between the addresses and IP's number.
std::string packets_captured(const std::vector<SentPacket>& packets, const std::string& tags = "") {
  std::string file = test::capture_head();
  for (const SentPacket& packet : packets) {
    file += record_of(std::string(6, 'e') + card_of(packet) + tags + big(0x0800) + ip_packet(packet), packet.at_us);
  }
  return file;
}

std::string cooked_capture_of(const std::vector<SentPacket>& packets, const std::string& tags) {
  std::string file = test::capture_head();
  file.replace(20, 4, raw(113U));
  for (const SentPacket& packet : packets) {
    const std::string head = big(0) + big(1) + big(6) + card_of(packet) + big(0);
    file += record_of(head + tags + big(0x0800) + ip_packet(packet), packet.at_us);
  }
  return file;
}

// Of all points, in tenths of a metre: two are a mixture.
std::set<int> ranges_dm(const ReadCapture& capture) {
  std::set<int> found;
  for (const SourcedFrame& frame : capture.frames) {
    const pose_wall_cloud& cloud = frame.frame->cloud;
    for (std::size_t i = 0; i < std::size_t{cloud.width} * cloud.height; ++i) {
      float xyz[3];
      std::memcpy(xyz, static_cast<const char*>(cloud.data) + i * cloud.point_step, sizeof xyz);
      found.insert(static_cast<int>(std::lround(10.0 * std::hypot(xyz[0], std::hypot(xyz[1], xyz[2])))));
    }
  }
  return found;
}

const Sender kFirst{0x0A010101, 2368, 2368, 0xAA0000000001, ""};

TEST(TwoSensors, AreToldApartByAddressPortAndCard) {
  const TempFolder folder;
  for (const Sender& other :
       {Sender{0x0A010103, 2368, 2368, 0xAA0000000001, ""}, Sender{0x0A010101, 2368, 2369, 0xAA0000000001, ""},
        Sender{0x0A010101, 2369, 2368, 0xAA0000000001, ""}, Sender{0x0A010101, 2368, 2368, 0xAA0000000002, ""}}) {
    const ReadCapture capture =
        read(folder.write("two.pcap", packets_captured(mixed(turns(4, 2500), sent_by(turns(4, 1000), other, 300)))));
    EXPECT_TRUE(capture.errors.empty());
    EXPECT_EQ(capture.frames.size(), 4U);
    EXPECT_EQ(ranges_dm(capture), std::set<int>{50});
  }
}

TEST(TwoSensors, TheFirstWholeTurnDecides) {
  const TempFolder folder;
  // The first one heard begins in the middle of a turn.
  const std::vector<SentPacket> late =
      sent_by(turns(4, 1000, 20), {0x0A010103, 2368, 2368, 1, ""}, -20 * kPacket_us - 100);
  const ReadCapture capture =
      read(folder.write("two.pcap", packets_captured(mixed(turns(4, 2500), sent_by(late, late[0].from, 200)))));
  EXPECT_EQ(ranges_dm(capture), std::set<int>{50});
}

TEST(TwoSensors, TheOneThatIsNamedIsRead) {
  const TempFolder folder;
  const std::string file = folder.write(
      "two.pcap", packets_captured(mixed(turns(4, 2500),
                                         sent_by(turns(4, 1000), {0x0A010101, 2368, 2369, 0xAA0000000002, ""}, 300))));
  for (const char* name : {"10.1.1.1:2369", "aa:00:00:00:00:02"}) {
    SensorOptions options;
    options.source = name;
    const ReadCapture capture = read(file, options);
    EXPECT_EQ(capture.frames.size(), 4U) << name;
    EXPECT_EQ(ranges_dm(capture), std::set<int>{20}) << name;
  }
  SensorOptions options;
  options.source = "10.1.1.9";
  const std::string refusal = test::refusal_of(read(file, options));
  for (const char* word : {"--source 10.1.1.9", "10.1.1.1:2368", "10.1.1.1:2369"}) {
    EXPECT_NE(refusal.find(word), std::string::npos) << refusal;
  }
}

// Data begins with D, what the sensor says of itself with the bytes of RoboSense and LSLidar; a turn is three packets.
class FakeAssembler : public ScanAssembler {
 public:
  bool add(const Datagram& datagram) override {
    const std::string_view text = text_of(datagram.payload);
    if (text.substr(0, 2) == "\xA5\xFF") {
      told_ = true;
      return true;
    }
    if (text.empty() || text[0] != 'D') return false;
    if (++packets_ % 3 == 0) {
      Scan scan;
      scan.rings = told_ ? 2 : 1;
      scan.is_complete = true;
      push(std::move(scan));
    }
    return true;
  }
  void finish() override {}
  const char* kind() const override { return "fake packets"; }
  bool stamps_are_of_arrival() const override { return true; }

 private:
  std::size_t packets_ = 0;
  bool told_ = false;
};

std::string device_packet(std::uint16_t port) {
  return std::string("\xA5\xFF\x00\x5A", 4) + std::string(20, '\0') + big(port) + std::string(40, '\0');
}

Datagram datagram_of(const std::string& payload, const Sender& from) {
  return {0, from, view_of(payload)};
}

TEST(OneSender, WhatASensorSaysOfItselfReachesItsDataOnly) {
  const Sender left{1, 6699, 6699, 0, ""}, right{1, 6699, 6698, 0, ""}, device{1, 7788, 7788, 0, ""};
  const std::string of_right = device_packet(6698), a = "Da", b = "Db", c = "Dc";
  for (const Sender& read_one : {left, right}) {
    OneSender sorted([] { return std::make_unique<FakeAssembler>(); });
    for (const std::string& payload : {a, b}) {
      EXPECT_TRUE(sorted.add(datagram_of(payload, left)));
      EXPECT_TRUE(sorted.add(datagram_of(payload, right)));
    }
    EXPECT_TRUE(sorted.add(datagram_of(of_right, device)));
    EXPECT_TRUE(sorted.add(datagram_of(c, read_one)));
    const std::optional<Scan> scan = sorted.take();
    ASSERT_TRUE(scan.has_value());
    EXPECT_EQ(scan->rings, read_one.to_port == 6698 ? 2U : 1U);
  }
}

TEST(OneSender, WhatASensorSaidOfItselfBeforeItsDataIsKept) {
  OneSender sorted([] { return std::make_unique<FakeAssembler>(); });
  const std::string told = device_packet(1);
  sorted.add(datagram_of(told, {1, 7788, 7788, 0, ""}));
  EXPECT_NE(sorted.hint().find("0.0.0.1"), std::string::npos) << sorted.hint();
  for (const std::string payload : {"Da", "Db", "Dc"}) sorted.add(datagram_of(payload, {1, 6699, 6699, 0, ""}));
  const std::optional<Scan> scan = sorted.take();
  ASSERT_TRUE(scan.has_value());
  EXPECT_EQ(scan->rings, 2U);
}

TEST(OneSender, ManySendersOfOtherThingsDoNotKeepTheSensorOut) {
  OneSender sorted([] { return std::make_unique<FakeAssembler>(); });
  for (std::uint32_t i = 0; i < 1000; ++i) EXPECT_FALSE(sorted.add(datagram_of("noise", {100 + i, 1, 1, 0, ""})));
  for (const std::string payload : {"Da", "Db", "Dc"}) EXPECT_TRUE(sorted.add(datagram_of(payload, {1, 1, 1, 0, ""})));
  EXPECT_TRUE(sorted.take().has_value());
}

std::vector<std::int64_t> stamps(const ReadCapture& capture) {
  std::vector<std::int64_t> stamps;
  for (const SourcedFrame& frame : capture.frames) stamps.push_back(*frame.stamp_ns);
  return stamps;
}

void expect_same(const ReadCapture& capture, const ReadCapture& plain) {
  ASSERT_EQ(capture.frames.size(), plain.frames.size());
  EXPECT_EQ(stamps(capture), stamps(plain));
  for (std::size_t i = 0; i < plain.frames.size(); ++i) {
    const pose_wall_cloud &a = capture.frames[i].frame->cloud, &b = plain.frames[i].frame->cloud;
    ASSERT_EQ(a.width, b.width) << i;
    ASSERT_EQ(a.height, b.height) << i;
    for (std::size_t k = 0; k < std::size_t{a.width} * a.height; ++k) {
      const auto* const p = static_cast<const char*>(a.data) + k * a.point_step;
      const auto* const q = static_cast<const char*>(b.data) + k * b.point_step;
      ASSERT_EQ(std::memcmp(p, q, 16), 0) << "frame " << i << ", point " << k;
    }
  }
}

TEST(Packets, ThatWereCapturedTwiceAreOne) {
  const TempFolder folder;
  const std::vector<SentPacket> packets = turns(3, 2500);
  const ReadCapture plain = read(folder.write("plain.pcap", packets_captured(packets)));
  expect_same(read(folder.write("all.pcap", packets_captured(mixed(packets, sent_by(packets, kFirst, 3))))), plain);
  const std::vector<SentPacket> border(packets.begin() + 25, packets.begin() + 40);
  expect_same(read(folder.write("border.pcap", packets_captured(mixed(packets, sent_by(border, kFirst, 3))))), plain);
}

TEST(Packets, OnesThatCameLateJoinTheTurnThatTheyAreOf) {
  const TempFolder folder;
  const std::vector<SentPacket> packets = turns(3, 2500);
  const ReadCapture plain = read(folder.write("plain.pcap", packets_captured(packets)));
  for (const std::size_t at : {10U, 28U, 29U, 30U, 59U}) {
    std::vector<SentPacket> swapped = packets;
    std::swap(swapped[at].payload, swapped[at + 1].payload);
    const ReadCapture capture = read(folder.write("late.pcap", packets_captured(swapped)));
    ASSERT_EQ(capture.frames.size(), 3U) << at;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(capture.frames[i].frame->cloud.width, plain.frames[i].frame->cloud.width) << at << ", frame " << i;
      EXPECT_NEAR(static_cast<double>(stamps(capture)[i] - stamps(plain)[i]), 0.0, 1.5e6) << at;
    }
    const std::vector<std::int64_t> at_ns = stamps(capture);
    EXPECT_TRUE(std::is_sorted(at_ns.begin(), at_ns.end()));
  }
}

// The longest time within each frame.
std::vector<double> spans_ms(const ReadCapture& capture) {
  std::vector<double> spans;
  for (const SourcedFrame& frame : capture.frames) {
    const pose_wall_cloud& cloud = frame.frame->cloud;
    std::uint32_t longest_ns = 0;
    for (std::size_t i = 0; i < std::size_t{cloud.width} * cloud.height; ++i) {
      std::uint32_t t_ns = 0;
      std::memcpy(&t_ns, static_cast<const char*>(cloud.data) + i * cloud.point_step + cloud.time.offset, sizeof t_ns);
      longest_ns = std::max(longest_ns, t_ns);
    }
    spans.push_back(1e-6 * longest_ns);
  }
  return spans;
}

// 30 packets a turn, 40 ms. Lost is what a cable or a pause of the recording takes.
TEST(Packets, ALossOfAnyLengthJoinsNoTwoTurns) {
  const TempFolder folder;
  for (const std::size_t lost : {1U, 5U, 15U, 25U, 28U, 29U, 30U, 31U, 45U, 60U, 90U}) {
    for (const std::size_t from : {40U, 45U, 58U}) {
      std::vector<SentPacket> packets = turns(8, 2500);
      packets.erase(packets.begin() + static_cast<std::ptrdiff_t>(from),
                    packets.begin() + static_cast<std::ptrdiff_t>(from + lost));
      const ReadCapture capture = read(folder.write("lost.pcap", packets_captured(packets)));
      EXPECT_GE(capture.frames.size(), 4U);
      for (const double span_ms : spans_ms(capture)) EXPECT_LE(span_ms, 41.5) << lost << " lost from " << from;
    }
  }
  std::vector<SentPacket> paused = turns(6, 2500);
  for (std::size_t i = 45; i < paused.size(); ++i) paused[i].at_us += 600'000'000;
  for (const double span_ms : spans_ms(read(folder.write("paused.pcap", packets_captured(paused)))))
    EXPECT_LE(span_ms, 41.5);
}

TEST(Packets, OfAHeadThatTurnsTheOtherWayAreRefusedInWords) {
  const TempFolder folder;
  std::vector<SentPacket> packets;
  for (std::int64_t i = 0; i < 90; ++i) {
    VelodynePacket packet;
    packet.first_deg = static_cast<double>(359 - (12 * i) % 360);
    packet.step_deg = -1.0;
    packet.clock_us = static_cast<std::uint32_t>(kPacket_us * i);
    packets.push_back({payload_of(packet), kPacket_us * i, kFirst});
  }
  const std::string refusal = test::refusal_of(read(folder.write("back.pcap", packets_captured(packets))));
  EXPECT_NE(refusal.find("turns the other way"), std::string::npos) << refusal;
}

// Fragments of two datagrams of one number: senders count to 65,535 and begin anew.
TEST(LinkLayer, FragmentsOfAMinuteAgoArePutIntoNoPacket) {
  const TempFolder folder;
  const std::string whole = test::datagram(turns(1, 1000)[0].payload);
  std::string file = test::capture_head();
  const std::string old = test::captured(whole.substr(640), 0, 80);  // its first part was lost
  file += old;
  for (const SentPacket& packet : turns(3, 2500)) {
    const std::string content = test::datagram(packet.payload);
    std::string first = test::captured(content.substr(0, 640), 0, 0x2000),
                rest = test::captured(content.substr(640), 0, 80);
    const std::int64_t at_us = 60'000'000 + packet.at_us;
    for (std::string* part : {&first, &rest}) {
      part->replace(0, 8,
                    raw(1700000000U + static_cast<std::uint32_t>(at_us / 1'000'000)) +
                        raw(static_cast<std::uint32_t>(at_us % 1'000'000)));
      file += *part;
    }
  }
  const ReadCapture capture = read(folder.write("old.pcap", file));
  EXPECT_EQ(capture.frames.size(), 3U);
  EXPECT_EQ(ranges_dm(capture), std::set<int>{50});
}

// A VLP-16 that sends packets within its field of view only. Packets go on over its hole.
std::vector<SentPacket> seen(double from_deg, double to_deg, std::size_t turns) {
  std::vector<SentPacket> packets;
  std::vector<std::pair<double, std::int64_t>> blocks;
  for (std::size_t i = 0; i < 900 * turns; ++i) {
    const double azimuth_deg = 0.4 * static_cast<double>(i % 900);
    const bool is_in = from_deg < to_deg ? azimuth_deg >= from_deg && azimuth_deg <= to_deg
                                         : azimuth_deg >= from_deg || azimuth_deg <= to_deg;
    if (!is_in) continue;
    blocks.emplace_back(azimuth_deg, static_cast<std::int64_t>(110.592 * static_cast<double>(i)));
    if (blocks.size() < 12) continue;
    std::string payload;
    for (const auto& block : blocks) {
      payload += "\xFF\xEE" + raw(static_cast<std::uint16_t>(std::lround(100.0 * block.first)));
      for (int laser = 0; laser < 32; ++laser) payload += raw(std::uint16_t{2500}) + "\x2A";
    }
    payload += raw(static_cast<std::uint32_t>(blocks.front().second)) + "\x37\x22";
    // Sent when it is full; our captures count from a packet's first block.
    packets.push_back({payload, blocks.back().second - 1217, kFirst});
    blocks.clear();
  }
  return packets;
}

TEST(FieldOfView, EachTurnIsAFrameWhereverItLies) {
  const TempFolder folder;
  for (const auto& [from_deg, to_deg] : std::vector<std::pair<double, double>>{
           {100, 260}, {0, 180}, {180, 359}, {10, 350}, {30, 90}, {300, 60}, {200, 190}}) {
    const ReadCapture capture = read(folder.write("fov.pcap", packets_captured(seen(from_deg, to_deg, 10))));
    EXPECT_GE(capture.frames.size(), 9U) << from_deg << " to " << to_deg;
    EXPECT_LE(capture.frames.size(), 10U) << from_deg << " to " << to_deg;
    const std::vector<std::int64_t> at_ns = stamps(capture);
    for (std::size_t i = 1; i < at_ns.size(); ++i) {
      EXPECT_NEAR(static_cast<double>(at_ns[i] - at_ns[i - 1]), 99.5e6, 2e6)
          << from_deg << " to " << to_deg << ", " << i;
    }
  }
}

// Times of points within a scan are those of the head's turning, also of a packet that spans the hole.
TEST(FieldOfView, APacketAcrossTheHoleHasTheTimesOfBothSides) {
  const TempFolder folder;
  const ReadCapture capture = read(folder.write("fov.pcap", packets_captured(seen(100, 261, 6))));
  ASSERT_GE(capture.frames.size(), 4U);
  for (std::size_t i = 1; i < 4; ++i) {
    const pose_wall_cloud& cloud = capture.frames[i].frame->cloud;
    for (std::uint32_t k = 0; k < cloud.width; ++k) {
      float xyz[3];
      std::uint32_t t_ns = 0;
      const auto* const at = static_cast<const char*>(cloud.data) + k * cloud.point_step;
      std::memcpy(xyz, at, sizeof xyz);
      std::memcpy(&t_ns, at + cloud.time.offset, sizeof t_ns);
      double azimuth_deg = -std::atan2(xyz[1], xyz[0]) * 180.0 / 3.14159265358979;
      if (azimuth_deg < 0.0) azimuth_deg += 360.0;
      EXPECT_NEAR(t_ns * 1e-6, (azimuth_deg - 100.0) / 360.0 * 99.53, 0.15) << i << ", " << azimuth_deg << " degrees";
    }
  }
}

TEST(LinkLayer, TagsOfNetworksArePassedOver) {
  const TempFolder folder;
  const std::string one = big(0x8100) + big(5), two = big(0x88A8) + big(100) + one, old = big(0x9100) + big(7) + one;
  for (const std::string& tags : {std::string{}, one, two, old}) {
    EXPECT_EQ(read(folder.write("tags.pcap", packets_captured(turns(2, 2500), tags))).frames.size(), 2U) << tags.size();
    EXPECT_EQ(read(folder.write("cooked.pcap", cooked_capture_of(turns(2, 2500), tags))).frames.size(), 2U)
        << tags.size();
  }
}

TEST(LinkLayer, PacketsThatTheRecordingProgramCutAreSaid) {
  const TempFolder folder;
  std::string file = test::capture_head();
  for (const SentPacket& packet : turns(1, 2500)) {
    file += record_of(std::string(6, 'e') + card_of(packet) + big(0x0800) + ip_packet(packet), packet.at_us, 96);
  }
  const ReadCapture capture = read(folder.write("cut.pcap", file));
  EXPECT_TRUE(capture.frames.empty());
  ASSERT_EQ(capture.errors.size(), 1U);
  for (const char* word : {"30 were kept to 96 bytes of 1248", "snap length"}) {
    EXPECT_NE(capture.errors[0].find(word), std::string::npos) << capture.errors[0];
  }
}

}  // namespace
}  // namespace pose_wall::tools

#endif
